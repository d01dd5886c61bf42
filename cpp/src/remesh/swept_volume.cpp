#include "remesh/swept_volume.h"

#include <algorithm>

#include "base/ids.h"
#include "base/sort.h"
#include "boundary/ray_crossing.h"
#include "boundary/surface_access.h"
#include "geom/coordinates.h"
#include "geom/measure.h"
#include "search/disjoint_sets.h"

namespace tetrafront {
namespace {

/// Distance from a triangle / largest coordinate below which the side of a rounded centroid is unknown.
constexpr double kNear = 1e-12;

/// An edge of a triangle before or after a change.
struct SweptEdge {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle;

  [[nodiscard]] bool isSame(const SweptEdge& other) const {
    return low == other.low && high == other.high;
  }
};

}  // namespace

void SweptVolume::begin(std::span<const NumberedTriangle> triangles, std::size_t removedCount) {
  triangles_ = triangles;
  removedCount_ = removedCount;
  isPrepared_ = false;
}

/// Divides the triangles into sheets that are connected without the edges at which several move. The edges of the common boundary
/// connect a sheet before the change with the one after it.
void SweptVolume::collectSheets() {
  isPrepared_ = true;
  nodes_.clear();
  std::vector<SweptEdge> edges;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const std::array<std::uint32_t, 3>& nodes = triangles_[t].nodes;
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(nodes[k], nodes[(k + 1) % 3]);
      edges.push_back({low, high, t});
    }
  }
  stableSort(nodes_, [](std::uint32_t a, std::uint32_t b) { return a < b; });
  stableSort(edges, [](const SweptEdge& a, const SweptEdge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
  DisjointSets sets(triangles_.size());
  std::vector<std::uint32_t> ends;  // one triangle per edge at which a sheet ends
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j].isSame(edges[i])) ++j;
    const bool isInside =
        edges[i].triangle >= removedCount_ || edges[j - 1].triangle < removedCount_;
    if (isInside && j - i != 2) {
      for (std::size_t k = i; k < j; ++k) ends.push_back(edges[k].triangle);
    } else {
      for (std::size_t k = i + 1; k < j; ++k) sets.join(edges[i].triangle, edges[k].triangle);
    }
  }
  sheetOf_ = sets.numbers();
  isOpen_.assign(triangles_.size(), 0);
  for (const std::uint32_t t : ends) isOpen_[sheetOf_[t]] = 1;
}

/// Returns whether the position is on another side of a sheet than before. A ray from it crosses a closed sheet an odd number of
/// times then; of open ones, it crosses some an odd number of times and others not.
bool SweptVolume::isBetween(const Vec3& position) {
  isCrossedOdd_.assign(sheetOf_.size(), 0);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (isAheadOf(triangles_[t].corners, position)) isCrossedOdd_[sheetOf_[t]] ^= 1;
  }
  std::array<bool, 2> areAnyOpen{};
  for (const std::uint32_t sheet : sheetOf_) {
    const std::uint8_t isOdd = isCrossedOdd_[sheet];
    if (isOpen_[sheet] != 0) {
      areAnyOpen[isOdd] = true;
    } else if (isOdd != 0) {
      return true;
    }
  }
  return areAnyOpen[0] && areAnyOpen[1];
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
