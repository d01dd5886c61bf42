#pragma once

/// @file Puts elements that are close in space close in memory: the optimizer's sweeps spend most
/// of their time waiting for elements next to the current one.

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

  /// Visits about `budget` elements, each thirteen times in all; returns true when finished.
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

/// Returns the same mesh with its elements along a Morton curve and its nodes in the order in which
/// the elements use them. The first `boundaryNodes` nodes keep their indices. O(n).
[[nodiscard]] VolumeMesh alongMortonCurve(const VolumeMesh& mesh, std::size_t boundaryNodes);

}  // namespace tetrafront
