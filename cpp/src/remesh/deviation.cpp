#include "remesh/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/mesh_access.h"
#include "geom/measure.h"

namespace tetrafront {
namespace {

/// Division of a triangle ends after this many halvings, or at this ratio of the bound to the
/// distance.
constexpr int kMaxDepth = 24;
constexpr double kSharpness = 1.02;

double squaredDistance(const Vec3& position, const std::array<Vec3, 3>& corners) {
  return squaredDistanceToTriangle(position, corners[0], corners[1], corners[2]);
}

}  // namespace

DeviationBound::DeviationBound(const GuardedSurface& surface, double least)
    : Resumable(countTriangles(surface.reference().mesh())),
      complex_(surface.complex()),
      reference_(surface.reference()),
      bound_(least),
      above_(countTriangles(surface.reference().mesh())) {
  std::vector<Box> boxes;
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
    if (!complex_.isAlive(t) || reference_.patch(complex_.patchOf(t)).isPlanar) continue;
    const auto [a, b, c] = complex_.cornersOf(t);
    boxes.push_back(Box::of(a, b, c));
    items_.push_back(t);
    if (!surface.beneath(t).isNone()) above_[surface.beneath(t).index()] = t;
  }
  if (!boxes.empty()) tree_ = BoxTree(std::span<const Box>(boxes));
}

bool DeviationBound::advance(std::size_t budget) {
  const auto [first, last] = take(budget);
  for (std::size_t i = first; i < last; ++i) {
    const TriangleId t(i);
    const SmoothPatchId patch = reference_.patchOf(t);
    if (!reference_.patch(patch).isPlanar) {
      measure(cornersOf(reference_.mesh(), t), patch, above_[t.index()], 0);
    }
  }
  return isPassDone();
}

/// Returns the triangle of the patch nearest to the position. `guess`: a triangle that may be near,
/// or none.
TriangleId DeviationBound::nearest(const Vec3& position, SmoothPatchId patch, TriangleId guess,
                                   double& square) const {
  square = std::numeric_limits<double>::infinity();
  if (!guess.isNone()) square = squaredDistance(position, complex_.cornersOf(guess));
  TriangleId found = guess;
  tree_.visitNear(position, square, [&](std::uint32_t item) {
    const TriangleId t = items_[item];
    if (complex_.patchOf(t) != patch) return;
    const double other = squaredDistance(position, complex_.cornersOf(t));
    if (other >= square) return;
    square = other;
    found = t;
  });
  return found;
}

double DeviationBound::boundBy(const Corners& corners, TriangleId triangle) const {
  const Corners other = complex_.cornersOf(triangle);
  double largest = 0.0;
  for (const Vec3& corner : corners) {
    largest = std::max(largest, squaredDistance(corner, other));
  }
  return std::sqrt(largest);
}

void DeviationBound::measure(const Corners& corners, SmoothPatchId patch, TriangleId guess,
                             int depth) {
  if (!guess.isNone() && boundBy(corners, guess) <= bound_) return;
  double square = 0.0;
  const TriangleId t = nearest((corners[0] + corners[1] + corners[2]) / 3.0, patch, guess, square);
  const double bound = boundBy(corners, t);
  if (bound <= bound_) return;
  // The distance of the centroid is at most the largest one.
  const bool isSharp = bound <= kSharpness * std::sqrt(square);
  if (isSharp || depth == kMaxDepth) {
    bound_ = bound;
    return;
  }
  std::size_t k = 0;
  const auto squaredLength = [&](std::size_t i) {
    const Vec3 edge = corners[(i + 1) % 3] - corners[i];
    return glm::dot(edge, edge);
  };
  for (std::size_t i = 1; i < 3; ++i) {
    if (squaredLength(i) > squaredLength(k)) k = i;
  }
  const Vec3 middle = 0.5 * (corners[k] + corners[(k + 1) % 3]);
  measure({corners[k], middle, corners[(k + 2) % 3]}, patch, t, depth + 1);
  measure({middle, corners[(k + 1) % 3], corners[(k + 2) % 3]}, patch, t, depth + 1);
}

float sampledDeviation(const GuardedSurface& surface, TriangleId triangle) {
  const auto [a, b, c] = surface.complex().cornersOf(triangle);
  const SmoothPatchId patch = surface.complex().patchOf(triangle);
  const double tolerance = surface.tolerance();
  double largest = 0.0;
  for (const Vec3& sample : {(a + b + c) / 3.0, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) {
    const NearestPoint nearest = surface.reference().nearest(sample, patch, tolerance, {});
    largest = std::max(largest,
                       nearest.triangle.isNone() ? tolerance * tolerance : nearest.squaredDistance);
  }
  return static_cast<float>(std::sqrt(largest));
}

}  // namespace tetrafront
