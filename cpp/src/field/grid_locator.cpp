#include "field/grid_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "field/grid_access.h"
#include "field/grid_locator_builder.h"
#include "metric/metric.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

/// A weight above the negative of this counts as zero.
constexpr double kWeightRounding = 1e-13;

/// Returns the weights of a, b, c at the point of the triangle that is nearest to `p`. Tests the
/// Voronoi regions of its corners and edges in turn.
std::array<double, 3> nearestInTriangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                        const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = glm::dot(ab, p - a);
  const double d2 = glm::dot(ac, p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = glm::dot(ab, p - b);
  const double d4 = glm::dot(ac, p - b);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {1.0 - d1 / (d1 - d3), d1 / (d1 - d3), 0.0};
  const double d5 = glm::dot(ab, p - c);
  const double d6 = glm::dot(ac, p - c);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {1.0 - d2 / (d2 - d6), 0.0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  const double onBc = d4 - d3;
  const double onCb = d5 - d6;
  if (va <= 0.0 && onBc >= 0.0 && onCb >= 0.0) {
    const double t = onBc / (onBc + onCb);
    return {0.0, 1.0 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

/// Sets negative weights to zero and scales the others to the sum 1.
std::array<double, 4> clampedWeights(std::array<double, 4> weights) {
  double sum = 0.0;
  for (double& w : weights) {
    w = std::max(w, 0.0);
    sum += w;
  }
  for (double& w : weights) w /= sum;
  return weights;
}

}  // namespace

GridLocator::GridLocator(const BackgroundGrid& grid, double growth) {
  Job job([&](Work& work) { return buildGridLocator(work, grid, growth); });
  *this = job.finish();
}

std::array<double, 4> GridLocator::weightsAt(GridTetId tet, const Vec3& position) const {
  const Frame& frame = frames_[tet.index()];
  const Vec3 d = position - frame.origin;
  const double w1 = glm::dot(frame.gradients[0], d);
  const double w2 = glm::dot(frame.gradients[1], d);
  const double w3 = glm::dot(frame.gradients[2], d);
  return {1.0 - w1 - w2 - w3, w1, w2, w3};
}

GridLocator::Location GridLocator::locate(const Vec3& position, GridTetId start) const {
  GridTetId at = start.index() < frames_.size() ? start : GridTetId(0U);
  for (std::uint32_t step = 0; step < maxSteps_; ++step) {
    const std::array<double, 4> weights = weightsAt(at, position);
    std::size_t exit = 0;
    for (std::size_t i = 1; i < 4; ++i) {
      if (weights[i] < weights[exit]) exit = i;
    }
    if (weights[exit] >= -kWeightRounding) {
      Location found = weights[exit] > kWeightRounding
                           ? Location{at, clampedWeights(weights), true, 0}
                           : lowestAround(at, position, weights);
      found.steps = step;
      return found;
    }
    const GridTetId next = frames_[at.index()].neighbours[exit];
    if (next.isNone()) {
      Location found = nearest(position, at);
      found.steps = step;
      return found;
    }
    at = next;
  }
  Location found = nearest(position, at);
  found.steps = maxSteps_;
  return found;
}

/// Returns the lowest of the tetrahedra that contain the position on a face, an edge or a node of `tet`. They are connected over
/// faces that contain it.
GridLocator::Location GridLocator::lowestAround(GridTetId tet, const Vec3& position,
                                                const std::array<double, 4>& weights) const {
  Location lowest{tet, clampedWeights(weights), true, 0};
  std::vector<GridTetId> around{tet};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const std::array<double, 4> own = weightsAt(around[i], position);
    if (around[i] < lowest.tetrahedron) lowest = {around[i], clampedWeights(own), true, 0};
    for (std::size_t k = 0; k < 4; ++k) {
      const GridTetId next = frames_[around[i].index()].neighbours[k];
      if (own[k] > kWeightRounding || next.isNone()) continue;
      const std::array<double, 4> beyond = weightsAt(next, position);
      if (*std::ranges::min_element(beyond) < -kWeightRounding) continue;
      if (std::ranges::find(around, next) == around.end()) around.push_back(next);
    }
  }
  return lowest;
}

/// Returns the largest distance outside the grid that still counts as covered, if this tetrahedron
/// is the nearest.
double GridLocator::allowanceAt(GridTetId tet) const {
  if (!(grid_.coverageMargin > 0.0)) return slack_;
  const std::array<Vec3, 4> corners = cornersOf(grid_, tet);
  double squared = 0.0;
  for (const TetEdge& ends : kTetEdges) {
    const Vec3 edge = corners[ends.from] - corners[ends.to];
    squared = std::max(squared, glm::dot(edge, edge));
  }
  return slack_ + grid_.coverageMargin * std::sqrt(squared);
}

/// Finds the nearest tetrahedron by branch and bound, beginning with the distance to `guess`.
GridLocator::Location GridLocator::nearest(const Vec3& position, GridTetId guess) const {
  Location best;
  double leastSquared = std::numeric_limits<double>::max();
  const auto consider = [&](GridTetId tet) {
    const std::array<double, 4> weights = weightsAt(tet, position);
    if (*std::min_element(weights.begin(), weights.end()) >= -kWeightRounding) {
      leastSquared = 0.0;
      best = {tet, clampedWeights(weights), true, 0};
      return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if (weights[i] >= 0.0) continue;  // `position` is on the inner side: another face is nearer
      // The corners of the face opposite corner i, ascending.
      const auto onFace = [i](std::size_t k) { return k < i ? k : k + 1; };
      std::array<Vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = positionOf(grid_, nodesOf(grid_, tet)[onFace(k)]);
      }
      const std::array<double, 3> w =
          nearestInTriangle(position, corners[0], corners[1], corners[2]);
      const Vec3 d = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2] - position;
      const double squared = glm::dot(d, d);
      if (squared >= leastSquared) continue;
      leastSquared = squared;
      best = {tet, {}, false, 0};
      for (std::size_t k = 0; k < 3; ++k) best.weights[onFace(k)] = w[k];
    }
  };
  consider(guess);
  tree_.visitNear(position, leastSquared, [&](std::uint32_t item) { consider(GridTetId(item)); });
  const double allowance = allowanceAt(best.tetrahedron);
  best.inside = leastSquared <= allowance * allowance;
  best.weights = clampedWeights(best.weights);
  return best;
}

SymmetricTensor GridLocator::tensorAt(const Location& location) const {
  if (tensors_.empty()) return SymmetricTensor::isotropic(sizeAt(location));
  const GridNodeQuad nodes = nodesOf(grid_, location.tetrahedron);
  SymmetricTensor tensor = SymmetricTensor::isotropic(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    tensor.accumulate(tensors_[nodes[i].index()], location.weights[i]);
  }
  return isLogarithmic_ ? exponentialOf(tensor) : tensor;
}

double GridLocator::sizeAt(const Location& location) const {
  const GridNodeQuad nodes = nodesOf(grid_, location.tetrahedron);
  double size = 0.0;
  for (std::size_t i = 0; i < 4; ++i) size += location.weights[i] * sizes_[nodes[i].index()];
  return size;
}

}  // namespace tetrafront
