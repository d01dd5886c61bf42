#include "preview/sampled_triangles.h"

#include <cmath>

#include "geom/measure.h"

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

std::optional<double> SampledTriangle::distanceAlong(const Vec3& origin, const Vec3& ray) const {
  const Vec3 u = corners[1] - corners[0];
  const Vec3 v = corners[2] - corners[0];
  const Vec3 cross = glm::cross(ray, v);
  const double determinant = glm::dot(u, cross);
  if (determinant == 0.0) return std::nullopt;
  const Vec3 from = origin - corners[0];
  const double a = glm::dot(from, cross) / determinant;
  const Vec3 other = glm::cross(from, u);
  const double b = glm::dot(ray, other) / determinant;
  if (!(a >= 0.0 && b >= 0.0 && a + b <= 1.0)) return std::nullopt;
  const double t = glm::dot(v, other) / determinant;
  return t > 0.0 ? std::optional<double>(t) : std::nullopt;
}

void SampledTriangles::buildTree() {
  std::vector<Box> boxes;
  boxes.reserve(triangles_.size());
  for (const auto& [corners, centroid, normal] : triangles_)
    boxes.push_back(Box::of(corners[0], corners[1], corners[2]));
  tree_ = BoxTree(boxes);
}

std::optional<double> SampledTriangles::gapAlong(const SampledTriangle& triangle, const Vec3& ray,
                                                 double reach, double modelDiagonal) const {
  const Vec3 start = triangle.centroid + ray * (kRayStart * reach);
  const Vec3 end = triangle.centroid + ray * reach;
  std::optional<double> nearest;
  double cosine = 0.0;
  tree_.visitOverlaps(Box::of(start, end, end), [&](std::uint32_t item) {
    const std::optional<double> t = triangles_[item].distanceAlong(start, ray);
    if (!t || *t > reach || (nearest && *t >= *nearest)) return;
    nearest = t;
    cosine = glm::dot(triangles_[item].normal, ray);
  });
  if (!nearest || std::fabs(cosine) < kMinAngleCosine) return std::nullopt;
  const Vec3 middle = triangle.centroid + ray * (0.5 * *nearest);
  return isInside(middle, modelDiagonal) ? nearest : std::nullopt;
}

/// Counts the triangles on a ray out of the model. The ray is slightly oblique so as to miss edges.
bool SampledTriangles::isInside(const Vec3& position, double modelDiagonal) const {
  const Vec3 ray = unitOf(Vec3(1.0, 1.234567e-3, 2.345678e-3));
  const Vec3 end = position + ray * (2.0 * modelDiagonal);
  std::uint32_t crossings = 0;
  tree_.visitOverlaps(Box::of(position, end, end), [&](std::uint32_t item) {
    if (triangles_[item].distanceAlong(position, ray)) ++crossings;
  });
  return crossings % 2 == 1;
}

}  // namespace tetrafront
