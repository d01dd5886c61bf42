#include "field/grid_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "field/grid_locator_builder.h"

namespace tetrafront {
namespace {

/// A weight above the negative of this counts as zero.
constexpr double kWeightRounding = 1e-13;

/// Nodes of the face opposite to node i.
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
    {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};

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

GridLocator::GridLocator(BackgroundGrid grid, double growth) {
  GridLocatorBuilder builder(std::move(grid), growth);
  while (!builder.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  *this = builder.take();
}

std::array<double, 4> GridLocator::weightsAt(std::uint32_t tetrahedron, const Vec3& place) const {
  const Frame& frame = frames_[tetrahedron];
  const Vec3 d = place - frame.origin;
  const double w1 = glm::dot(frame.gradients[0], d);
  const double w2 = glm::dot(frame.gradients[1], d);
  const double w3 = glm::dot(frame.gradients[2], d);
  return {1.0 - w1 - w2 - w3, w1, w2, w3};
}

GridLocator::Location GridLocator::locate(const Vec3& place, std::uint32_t startTetrahedron) const {
  std::uint32_t at = startTetrahedron < frames_.size() ? startTetrahedron : 0;
  for (std::uint32_t step = 0; step < maxSteps_; ++step) {
    const std::array<double, 4> weights = weightsAt(at, place);
    std::size_t exit = 0;
    for (std::size_t i = 1; i < 4; ++i) {
      if (weights[i] < weights[exit]) exit = i;
    }
    if (weights[exit] >= -kWeightRounding) return {at, clampedWeights(weights), true, step};
    const std::uint32_t next = frames_[at].neighbours[exit];
    if (next == kNoIndex) {
      Location found = nearest(place, at);
      found.steps = step;
      return found;
    }
    at = next;
  }
  Location found = nearest(place, at);
  found.steps = maxSteps_;
  return found;
}

/// Returns the largest distance outside the grid that still counts as covered, if this tetrahedron
/// is the nearest.
double GridLocator::allowanceAt(std::uint32_t tetrahedron) const {
  if (!(grid_.coverageMargin > 0.0)) return slack_;
  double squared = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const Vec3 edge = grid_.nodes[grid_.tetrahedra[tetrahedron][i]].position -
                        grid_.nodes[grid_.tetrahedra[tetrahedron][j]].position;
      squared = std::max(squared, glm::dot(edge, edge));
    }
  }
  return slack_ + grid_.coverageMargin * std::sqrt(squared);
}

/// Finds the nearest tetrahedron by branch and bound, beginning with the distance to `guess`.
GridLocator::Location GridLocator::nearest(const Vec3& place, std::uint32_t guess) const {
  Location best;
  double leastSquared = std::numeric_limits<double>::max();
  const auto consider = [&](std::uint32_t t) {
    const std::array<double, 4> weights = weightsAt(t, place);
    if (*std::min_element(weights.begin(), weights.end()) >= -kWeightRounding) {
      leastSquared = 0.0;
      best = {t, clampedWeights(weights), true, 0};
      return;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if (weights[i] >= 0.0) continue;  // `place` is on the inner side: another face is nearer
      std::array<Vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = grid_.nodes[grid_.tetrahedra[t][kFaces[i][k]]].position;
      }
      const std::array<double, 3> w = nearestInTriangle(place, corners[0], corners[1], corners[2]);
      const Vec3 d = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2] - place;
      const double squared = glm::dot(d, d);
      if (squared >= leastSquared) continue;
      leastSquared = squared;
      best = {t, {}, false, 0};
      for (std::size_t k = 0; k < 3; ++k) best.weights[kFaces[i][k]] = w[k];
    }
  };
  consider(guess);
  tree_.visitNear(place, leastSquared, consider);
  const double allowance = allowanceAt(best.tetrahedron);
  best.inside = leastSquared <= allowance * allowance;
  best.weights = clampedWeights(best.weights);
  return best;
}

SymmetricTensor GridLocator::tensorAt(const Location& location) const {
  if (tensors_.empty()) return SymmetricTensor::isotropic(sizeAt(location));
  const auto& tet = grid_.tetrahedra[location.tetrahedron];
  SymmetricTensor tensor = SymmetricTensor::isotropic(0.0);
  for (std::size_t i = 0; i < 4; ++i) tensor.accumulate(tensors_[tet[i]], location.weights[i]);
  return tensor;
}

double GridLocator::sizeAt(const Location& location) const {
  const auto& tet = grid_.tetrahedra[location.tetrahedron];
  double size = 0.0;
  for (std::size_t i = 0; i < 4; ++i) size += location.weights[i] * sizes_[tet[i]];
  return size;
}

}  // namespace tetrafront
