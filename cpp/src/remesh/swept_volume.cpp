#include "remesh/swept_volume.h"

#include <algorithm>
#include <bit>

#include "base/ids.h"
#include "base/sort.h"
#include "boundary/ray_crossing.h"
#include "geom/coordinates.h"
#include "geom/measure.h"
#include "topology/disjoint_sets.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Distance from a triangle / largest coordinate below which it is unknown on which side a centroid is. Its rounding is about 1e-16;
/// the limit is far above it, because it costs no more than a few changes.
constexpr double kNear = 1e-12;

}  // namespace

void SweptVolume::begin(std::span<const NumberedTriangle> triangles, std::size_t removedCount) {
  triangles_ = triangles;
  removedCount_ = removedCount;
  isPrepared_ = false;
}

/// Divides the triangles into sheets that are connected across edges of two triangles. The edges of the common boundary connect a
/// sheet before the change with the one after it.
void SweptVolume::collectSheets() {
  isPrepared_ = true;
  nodes_.clear();
  edges_.clear();
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const std::array<std::uint32_t, 3>& nodes = triangles_[t].nodes;
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(nodes[k], nodes[(k + 1) % 3]);
      edges_.push_back({low, high, t});
    }
  }
  stableSort(nodes_, [](std::uint32_t a, std::uint32_t b) { return a < b; });
  stableSort(edges_, [](const Edge& a, const Edge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  DisjointSets sets(triangles_.size());
  ends_.clear();
  std::uint32_t ended = 0;
  for (std::size_t i = 0, j = 0; i < edges_.size(); i = j) {
    while (j < edges_.size() && edges_[j].isSame(edges_[i])) ++j;
    if (j - i == 2) {
      sets.join(edges_[i].triangle, edges_[i + 1].triangle);
    } else {
      for (std::size_t k = i; k < j; ++k) ends_.push_back({edges_[k].triangle, ended});
      ++ended;
    }
  }
  hasTooManyEnds_ = ended > kMaxEnds;
  sheetOf_ = sets.numbers();
  outlines_.assign(triangles_.size(), {});
  if (hasTooManyEnds_) return;
  for (const auto& [triangle, edge] : ends_) {
    outlines_[sheetOf_[triangle]].ends ^= std::uint64_t{1} << edge;
  }
}

/// Returns whether the position is on another side of the sheets than before. Of sheets that together are closed, a ray from it
/// then crosses some an odd number of times: eliminates the edges at which sheets end from their sums (modulo 2).
bool SweptVolume::isBetween(const Vec3& position) {
  if (hasTooManyEnds_) return true;
  for (Outline& outline : outlines_) outline.isCrossedOdd = false;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (!isAheadOf(triangles_[t].corners, position)) continue;
    bool& isOdd = outlines_[sheetOf_[t]].isCrossedOdd;
    isOdd = !isOdd;
  }
  std::array<Outline, kMaxEnds> withHighest{};  // per edge: a sum whose highest end it is
  for (Outline sum : outlines_) {
    while (sum.ends != 0) {
      Outline& other = withHighest[static_cast<std::size_t>(std::bit_width(sum.ends)) - 1];
      if (other.ends == 0) {
        other = sum;
        break;
      }
      sum.ends ^= other.ends;
      sum.isCrossedOdd = sum.isCrossedOdd != other.isCrossedOdd;
    }
    if (sum.ends == 0 && sum.isCrossedOdd) return true;
  }
  return false;
}

bool SweptVolume::isNear(const Vec3& position) const {
  const double distance = kNear * magnitudeOf(position);
  return std::ranges::any_of(triangles_, [&](const NumberedTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    return squaredDistanceToTriangle(position, a, b, c) <= distance * distance;
  });
}

bool SweptVolume::contains(const NumberedTriangle& other) {
  if (!isPrepared_) collectSheets();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!std::ranges::binary_search(nodes_, other.nodes[k])) return isBetween(other.corners[k]);
  }
  const Vec3 centroid = centroidOf(other.corners);
  return isNear(centroid) || isBetween(centroid);
}

}  // namespace tetrafront
