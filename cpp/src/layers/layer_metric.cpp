#include "layers/layer_metric.h"

#include <algorithm>
#include <cmath>

#include "geom/exponential.h"
#include "geom/measure.h"
#include "metric/metric.h"
#include "metric/principal_axes.h"

namespace tetrafront {
namespace {

/// Height of a regular tetrahedron / length of its edges: an element is as high as a layer if its edges across it are longer.
constexpr double kHeightPerEdge = 0.81649658092772603;

/// Largest distance of an edge along a bent wall from a surface of equal distance / size across the layers.
constexpr double kSagitta = 0.25;

/// A mesh is approached in steps in which sizes fall by this factor.
constexpr double kFinerPerCycle = 8.0;

/// Beyond the edge of a wall, surfaces of equal distance bend around the edge. That counts from an angle with the first square of its
/// sine, and in full from one with the second.
constexpr double kFanBegins = 0.03;
constexpr double kFanFull = 0.25;

/// Growth per unit of distance below which layers count as even: the mean of the reciprocal differs from 1 by half of it.
constexpr double kEven = 1e-6;

/// Distance from a wall / size across it, below which the position is on the wall.
constexpr double kOnWall = 1e-6;

/// Returns the part of a tensor in the plane normal to a unit vector.
SymmetricTensor alongSurface(const SymmetricTensor& tensor, const Vec3& normal) {
  const Vec3 image = tensor * normal;
  const Vec3 rest = image - 0.5 * glm::dot(normal, image) * normal;
  SymmetricTensor part = tensor;
  part.accumulate({2.0 * rest.x * normal.x, 2.0 * rest.y * normal.y, 2.0 * rest.z * normal.z,
                   rest.x * normal.y + rest.y * normal.x, rest.x * normal.z + rest.z * normal.x,
                   rest.y * normal.z + rest.z * normal.y},
                  -1.0);
  return part;
}

/// The direction across the layers beside a point of a wall, and how far it leans over the edge of the wall.
struct LayerDirection {
  Vec3 across;
  double fan = 0.0;  ///< 0 to 1
};

LayerDirection directionAt(const WallPoint& wall, const Vec3& position, double size) {
  if (!wall.isOnEdge || wall.distance < kOnWall * size) return {wall.normal};
  const Vec3 offset = unitOf(position - wall.position);
  const double straight = glm::dot(offset, wall.normal);
  const double outward = std::max(0.0, glm::dot(offset, wall.outward));
  const double square = wall.isOnCorner ? 1.0 - straight * straight : outward * outward;
  const double fan = std::clamp((square - kFanBegins) / (kFanFull - kFanBegins), 0.0, 1.0);
  if (wall.isOnCorner) return {offset, fan};
  const double rest = std::sqrt(std::max(0.0, 1.0 - square));
  return {unitOf(outward * wall.outward - rest * wall.normal), fan};
}

/// Returns how much a surface at a distance from a wall bends, along a direction in which the wall has this curvature.
double bendAt(double curvature, double distance) {
  constexpr double kNearFocus = 0.1;
  return std::fabs(curvature) / std::max(kNearFocus, 1.0 + curvature * distance);
}

std::vector<std::uint8_t> wallFlags(const std::vector<std::uint32_t>& sizesOf) {
  std::vector<std::uint8_t> isWall(sizesOf.size());
  for (std::size_t i = 0; i < isWall.size(); ++i) isWall[i] = sizesOf[i] == kNoIndex ? 0 : 1;
  return isWall;
}

std::vector<std::uint32_t> wallsOf(const SurfaceMesh& boundary,
                                   std::span<const PatchLayers> walls) {
  std::vector<std::uint32_t> wallOf(boundary.trianglePatch.size(), kNoIndex);
  for (std::size_t t = 0; t < wallOf.size(); ++t) {
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (walls[w].patch == boundary.trianglePatch[t]) wallOf[t] = static_cast<std::uint32_t>(w);
  }
  return wallOf;
}

}  // namespace

LayerSizes::LayerSizes(const PatchLayers& layers, double growthBeyond)
    : first_(layers.firstHeight),
      growth_(layers.growth - 1.0),
      growthBeyond_(growthBeyond),
      last_(layers.firstHeight) {
  for (std::uint32_t k = 0; k < layers.count; ++k) {
    thickness_ += last_;
    last_ *= layers.growth;
  }
  // Between d and d + h, the size grows from h to h growth: the mean of its reciprocal must be 1 / h.
  const double mean = growth_ > kEven ? logarithm(layers.growth) / growth_ : 1.0;
  edgePerHeight_ = mean / kHeightPerEdge;
}

double LayerSizes::at(double distance) const {
  const double height = distance < thickness_ ? first_ + growth_ * distance
                                              : last_ + growthBeyond_ * (distance - thickness_);
  return edgePerHeight_ * height;
}

double LayerSizes::reach(double size) const {
  return thickness_ + std::max(0.0, size / edgePerHeight_ - last_) / growthBeyond_;
}

LayerMetric::LayerMetric(const SurfaceMesh& boundary, std::span<const PatchLayers> walls,
                         const LayerOptions& options, double maxSize)
    : maxAspect_(options.maxAspect),
      sizesOf_(wallsOf(boundary, walls)),
      walls_(boundary, wallFlags(sizesOf_)) {
  for (const PatchLayers& wall : walls) {
    sizes_.emplace_back(wall, options.growth);
    reach_ = std::max(reach_, sizes_.back().reach(maxSize));
  }
}

SymmetricTensor LayerMetric::at(const Vec3& position, const SymmetricTensor& base,
                                const SymmetricTensor& current, bool& isLimited) const {
  SymmetricTensor metric = base;
  for (std::size_t group = 0; group < walls_.groupCount(); ++group) {
    WallPoint wall;
    if (!walls_.nearest(group, position, reach_, wall)) continue;
    if (!walls_.isNearestAround(wall, position)) continue;
    metric = intersectionOf(metric, ofWall(wall, position, current, isLimited));
  }
  return bounded(metric, {.minSize = 0.0, .maxAspect = maxAspect_});
}

SymmetricTensor LayerMetric::ofWall(const WallPoint& wall, const Vec3& position,
                                    const SymmetricTensor& current, bool& isLimited) const {
  double size = sizes_[sizesOf_[wall.triangle.index()]].at(wall.distance);
  const auto [across, fan] = directionAt(wall, position, size);
  const double least = 1.0 / (kFinerPerCycle * metricLength(current, across));
  if (size < least) {
    size = least;
    isLimited = true;
  }
  // A chord of length t on a surface of curvature k leaves it by k t^2 / 8.
  const double perBend = 1.0 / (8.0 * kSagitta * size);
  const double most = 1.0 / (size * size);
  const double fewest = most / (maxAspect_ * maxAspect_);
  PrincipalAxes along = principalAxes(wall.curvature);
  for (double& value : along.values) value = perBend * bendAt(value, wall.distance);
  SymmetricTensor metric = composed(along);
  if (fan > 0.0) {
    const double bend = fan * perBend / wall.distance;
    metric.accumulate(SymmetricTensor::isotropic(1.0), bend);
    if (!wall.isOnCorner) metric.accumulate(squareOf(wall.edge), -bend);
  }
  metric = alongSurface(metric, across);
  PrincipalAxes limited = principalAxes(metric);
  for (double& value : limited.values) value = std::clamp(value, fewest, most);
  metric = composed(limited);
  metric.accumulate(squareOf(across), most - glm::dot(across, metric * across));
  return metric;
}

}  // namespace tetrafront
