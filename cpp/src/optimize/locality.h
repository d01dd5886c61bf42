#pragma once

/// @file Elements that are near each other in space, near each other in memory: the sweeps of the
/// optimizer spend most of their time waiting for elements next to the one at hand.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "search/morton.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// alongMortonCurve() in slices.
class MortonReordering {
 public:
  /// The mesh must outlive this.
  MortonReordering(const VolumeMesh& mesh, std::size_t boundaryNodes);
  MortonReordering(const MortonReordering&) = delete;
  MortonReordering& operator=(const MortonReordering&) = delete;

  /// Goes on for `budget` elements, each of which is come to thirteen times; true when finished.
  bool advance(std::size_t budget);

  /// Once, when finished.
  [[nodiscard]] VolumeMesh take() { return std::move(ordered_); }

 private:
  enum class Stage : std::uint8_t { kCentroids, kSort, kCopy };

  void addCentroid(std::size_t element);
  void copyElement(std::size_t element);

  const VolumeMesh& mesh_;
  Stage stage_ = Stage::kCentroids;
  std::size_t next_ = 0;
  std::vector<Vec3> centroids_;
  MortonSort sort_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> newId_;
  VolumeMesh ordered_;
};

/// The same mesh with its elements along a Morton curve and its nodes in the order in which the
/// elements name them; the first `boundaryNodes` nodes stay. O(n).
[[nodiscard]] VolumeMesh alongMortonCurve(const VolumeMesh& mesh, std::size_t boundaryNodes);

}  // namespace tetrafront
