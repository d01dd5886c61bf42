#include "preview/sampled_triangles.h"

#include <cmath>

#include "boundary/ray_crossing.h"
#include "geom/measure.h"
#include "geom/ray.h"

namespace tetrafront {
namespace {

/// Opposite patches are roughly parallel: the cosine of the angle between a normal and the ray is at least this.
constexpr double kMinAngleCosine = 0.5;
/// Distance of a ray's start from its own triangle / length of the ray.
constexpr double kRayStart = 1e-6;

}  // namespace

SampledTriangle::SampledTriangle(const std::array<Vec3, 3>& c)
    : corners(c),
      centroid((c[0] + c[1] + c[2]) * (1.0 / 3.0)),
      normal(unitOf(glm::cross(c[1] - c[0], c[2] - c[0]))) {}

void SampledTriangles::buildTree() {
  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  for (const auto& [corners, centroid, normal] : triangles_)
    boxes.push_back(Box::of(corners[0], corners[1], corners[2]));
  tree_ = BoxTree(boxes);
}

std::optional<double> SampledTriangles::gapAlong(const SampledTriangle& triangle,
                                                 const Vec3& direction, double reach) const {
  const Ray ray(triangle.centroid, direction, kRayStart * reach);
  double nearest = reach;
  double cosine = 0.0;
  tree_.visitAlong(ray, nearest, [&](std::uint32_t item) {
    const std::optional<double> distance = ray.distanceTo(triangles_[item].corners);
    if (!distance || !(*distance < nearest)) return;
    nearest = *distance;
    cosine = glm::dot(triangles_[item].normal, direction);
  });
  if (std::fabs(cosine) < kMinAngleCosine) return std::nullopt;
  if (!isInside(triangle.centroid + direction * (0.5 * nearest))) return std::nullopt;
  return nearest;
}

bool SampledTriangles::isInside(const Vec3& position) const {
  std::uint32_t crossings = 0;
  tree_.visitOverlaps(boxOfRay(position), [&](std::uint32_t item) {
    if (isAheadOf(triangles_[item].corners, position)) ++crossings;
  });
  return crossings % 2 == 1;
}

}  // namespace tetrafront
