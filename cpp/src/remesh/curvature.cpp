#include "remesh/curvature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geom/angles.h"
#include "geom/measure.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Angle in radians below which all angles at the edges of a triangle count as rounding. chordOfCosine() takes the root of the
/// rounding of a cosine, about 1e-16, so its own error is about 1e-8. The limit is a hundred times that.
constexpr double kMinAngle = 1e-6;
/// Angle at an edge / largest angle at an edge of the triangle below which the surface does not bend there.
constexpr double kFlatPerLargest = 0.1;
/// Cosine of the largest angle between parallel bends, 2.5 degrees.
constexpr double kParallelCosine = 0.999;

}  // namespace

BendTensor::BendTensor(const ReferenceSurface& reference, TriangleId triangle, double flatAngle) {
  const std::array<Vec3, 3> corners = cornersOf(reference.mesh(), triangle);
  const Vec3& normal = reference.normalOf(triangle);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TriangleId neighbour = reference.smoothNeighbour(halfEdgeOf(triangle, k));
    if (neighbour.isNone()) continue;
    const Vec3& across = reference.normalOf(neighbour);
    const double angle = chordOfCosine(glm::dot(normal, across));
    if (angle <= flatAngle) continue;
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    // Each of the two triangles at the edge has half of it.
    const double half = 0.5 * angle * glm::length(edge);
    const bool isHollow = glm::dot(glm::cross(normal, across), edge) < 0.0;
    const Vec3 scaled = edge * ((isHollow ? -half : half) / glm::dot(edge, edge));
    diagonal_ += scaled * edge;
    offDiagonal_ += Vec3(scaled.y * edge.z, scaled.z * edge.x, scaled.x * edge.y);
    absolute_ += half;
  }
}

void BendTensor::add(const BendTensor& other, double share) {
  diagonal_ += other.diagonal_ * share;
  offDiagonal_ += other.offDiagonal_ * share;
  absolute_ += other.absolute_ * share;
}

/// Takes the eigenvalue across the surface as 0: all edges lie in the surface, or nearly.
Curvature BendTensor::over(double area) const {
  const double mean = 0.5 * (diagonal_.x + diagonal_.y + diagonal_.z);
  const double squares =
      glm::dot(diagonal_, diagonal_) + 2.0 * glm::dot(offDiagonal_, offDiagonal_);
  const double difference = std::sqrt(std::max(0.0, 0.5 * squares - mean * mean));
  return {(std::fabs(mean) + difference) / area, (std::fabs(mean) - difference) / area};
}

Vec3 bendAxisOf(const ReferenceSurface& reference, TriangleId triangle) {
  const std::array<Vec3, 3> corners = cornersOf(reference.mesh(), triangle);
  std::array<double, 3> angles{};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TriangleId neighbour = reference.smoothNeighbour(halfEdgeOf(triangle, k));
    if (neighbour.isNone()) continue;
    angles[k] =
        chordOfCosine(glm::dot(reference.normalOf(triangle), reference.normalOf(neighbour)));
  }
  const double largest = *std::ranges::max_element(angles);
  if (largest < kMinAngle) return Vec3(0.0);
  const double flat = std::min(kFlatBend, kFlatPerLargest * largest);
  Vec3 axis(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    if (angles[k] <= flat) continue;
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    const Vec3 direction = edge / glm::length(edge);
    if (axis == Vec3(0.0)) axis = direction;
    if (std::fabs(glm::dot(axis, direction)) < kParallelCosine) return Vec3(0.0);
  }
  return axis;
}

LineTurns::LineTurns(const FeatureLine& line) {
  const std::vector<Vec3>& points = line.points();
  const std::size_t last = points.size() - 1;
  const std::size_t end = line.isClosed() ? last + 1 : last;
  before_.resize(end + 1);
  for (std::size_t i = 1; i < end; ++i) {
    const Vec3 in = points[i] - points[i - 1];
    const Vec3 out = i < last ? points[i + 1] - points[i] : points[1] - points[0];
    const double angle = chordOfCosine(cosineBetween(in, out));
    const Vec3 normal = glm::cross(in, out);
    LineTurn& sum = before_[i + 1];
    sum = before_[i];
    if (normal != Vec3(0.0)) sum.angles += normal * (angle / glm::length(normal));
    sum.absolute += angle;
    sum.length += 0.5 * (glm::length(in) + glm::length(out));
  }
}

LineTurn LineTurns::over(std::size_t first, std::size_t last) const {
  const LineTurn& from = before_[first];
  const LineTurn& to = before_[last];
  return {to.angles - from.angles, to.absolute - from.absolute, to.length - from.length};
}

}  // namespace tetrafront
