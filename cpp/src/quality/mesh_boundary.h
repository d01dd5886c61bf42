#pragma once

/// @file The surface of a mesh that was given without one.

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "geom/tetrahedron.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Finds the faces that only one tetrahedron has, and those between two regions, in slices. O(n log
/// m) if at most m faces share their lowest node.
class BoundaryFinder {
 public:
  /// Indices must be in range. `mesh` must outlive this and must not change.
  explicit BoundaryFinder(const VolumeMesh& mesh);

  /// Visits about `budget` tetrahedra; returns true when finished.
  bool advance(std::uint32_t budget);

  /// Returns the boundary, once, when finished: counter-clockwise as seen from outside if the
  /// elements are positively oriented, in the order of the elements; trianglePatch holds their
  /// regions. `points` is empty.
  [[nodiscard]] SurfaceMesh take() { return std::move(boundary_); }

  /// Returns three nodes per face between two regions, oriented as in the first of its elements.
  /// Once, when finished.
  [[nodiscard]] std::vector<std::uint32_t> takeInterfaces() { return std::move(interfaces_); }

 private:
  enum class Stage : std::uint8_t { kCount, kInsert, kMatch, kCollect, kDone };
  enum class Part : std::uint8_t { kNone, kBoundary, kInterface };

  /// The two other nodes of a face; its bucket gives the lowest.
  struct Face {
    NodeId middle;
    NodeId highest;
    ElementFace owner;
  };

  [[nodiscard]] std::uint32_t regionOf(ElementFace face) const;
  void count(std::size_t first, std::size_t last);
  void insert(std::size_t first, std::size_t last);
  void match(std::size_t firstNode, std::size_t lastNode);
  void collect(std::size_t first, std::size_t last);
  void begin(Stage stage);

  const VolumeMesh* mesh_;
  Stage stage_ = Stage::kCount;
  std::size_t next_ = 0;
  /// Faces whose lowest node is i begin at begins_[i]. While faces are inserted, it is the next
  /// free slot.
  std::vector<std::uint32_t> begins_;
  std::vector<Face> faces_;
  std::vector<Part> partOf_;  ///< by face (ElementFace::index())
  SurfaceMesh boundary_;
  std::vector<std::uint32_t> interfaces_;
};

}  // namespace tetrafront
