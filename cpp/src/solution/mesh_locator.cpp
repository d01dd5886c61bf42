#include "solution/mesh_locator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "geom/box.h"
#include "geom/measure.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Weights down to this count as inside: rounding at the faces between elements.
constexpr double kLocatedSlack = -1e-10;

constexpr std::size_t kBoxesPerUnit = 8;

Box boxAround(const std::array<Vec3, 4>& corners) {
  Box box = Box::of(corners[0], corners[1], corners[2]);
  box.include(corners[3]);
  return box;
}

Vec3 nearestPointOf(const std::array<Vec3, 4>& corners, const Vec3& position) {
  Vec3 nearest = corners[0];
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : kFaceCorners) {
    const Vec3 point = nearestPointOfTriangle(position, corners[a], corners[b], corners[c]);
    const double square = glm::dot(point - position, point - position);
    if (square >= least) continue;
    least = square;
    nearest = point;
  }
  return nearest;
}

/// Returns weights >= 0 with the sum 1.
std::array<double, 4> clampedWeights(std::array<double, 4> weights) {
  double sum = 0.0;
  for (double& weight : weights) {
    weight = std::max(weight, 0.0);
    sum += weight;
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

BarycentricFrame::BarycentricFrame(const std::array<Vec3, 4>& p) : origin_(p[0]) {
  const Vec3 a = p[1] - p[0];
  const Vec3 b = p[2] - p[0];
  const Vec3 c = p[3] - p[0];
  const double determinant = glm::dot(glm::cross(a, b), c);
  gradients_ = {glm::cross(b, c) / determinant, glm::cross(c, a) / determinant,
                glm::cross(a, b) / determinant};
}

std::array<double, 4> BarycentricFrame::at(const Vec3& position) const {
  const Vec3 d = position - origin_;
  const double b = glm::dot(gradients_[0], d);
  const double c = glm::dot(gradients_[1], d);
  const double e = glm::dot(gradients_[2], d);
  return {1.0 - b - c - e, b, c, e};
}

Task<MeshLocator> MeshLocator::build(Work& work, const VolumeMesh& mesh) {
  std::vector<Box> boxes(countTetrahedra(mesh));
  for (std::size_t t = 0; t < boxes.size(); ++t) boxes[t] = boxAround(cornersOf(mesh, TetId(t)));
  BoxTree tree = co_await BoxTree::build(work, std::move(boxes), kBoxesPerUnit);
  co_return MeshLocator(mesh, std::move(tree));
}

MeshLocator::Location MeshLocator::locate(const Vec3& position) const {
  Location best;
  double deepest = -std::numeric_limits<double>::infinity();
  tree_.visitOverlaps(Box::of(position, position, position), [&](std::uint32_t item) {
    const auto weights = BarycentricFrame(cornersOf(*mesh_, TetId(item))).at(position);
    const double depth = std::ranges::min(weights);
    const bool isBetter = depth > deepest || (depth == deepest && TetId(item) < best.element);
    if (depth < kLocatedSlack || !isBetter) return;
    deepest = depth;
    best.element = TetId(item);
    best.weights = weights;
  });
  if (deepest < kLocatedSlack) return nearest(position);
  best.weights = clampedWeights(best.weights);
  return best;
}

MeshLocator::Location MeshLocator::nearest(const Vec3& position) const {
  double limit = std::numeric_limits<double>::infinity();
  TetId element(0U);
  Vec3 point(0.0);
  tree_.visitNear(position, limit, [&](std::uint32_t item) {
    const Vec3 candidate = nearestPointOf(cornersOf(*mesh_, TetId(item)), position);
    const double square = glm::dot(candidate - position, candidate - position);
    if (square >= limit) return;
    limit = square;
    element = TetId(item);
    point = candidate;
  });
  const BarycentricFrame frame(cornersOf(*mesh_, element));
  const bool isRounding = std::ranges::min(frame.at(position)) >= kLocatedSlack;
  return {element, clampedWeights(frame.at(point)), isRounding ? 0.0 : std::sqrt(limit)};
}

}  // namespace tetrafront
