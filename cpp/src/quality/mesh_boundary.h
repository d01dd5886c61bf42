#pragma once

/// @file The surface of a mesh that did not come with one.

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tetrafront/mesh.h"

namespace tetrafront {

/// Finds the faces that only one tetrahedron has, and those between two regions, in slices.
/// O(n log m) for faces of which at most m have their lowest node in common.
class BoundaryFinder {
 public:
  /// Indices must be in range. `mesh` must outlive this, and not change meanwhile.
  explicit BoundaryFinder(const VolumeMesh& mesh);

  /// Works on for about `budget` tetrahedra; true when finished.
  bool advance(std::uint32_t budget);

  /// Counter-clockwise seen from outside where elements are positively turned, in the order of their
  /// elements; trianglePatch holds their regions. `points` stays empty. Once, after the end.
  [[nodiscard]] SurfaceMesh take() { return std::move(boundary_); }

  /// Three nodes for each face between two regions, as the first of its elements has it. Once, after
  /// the end.
  [[nodiscard]] std::vector<std::uint32_t> takeWalls() { return std::move(walls_); }

 private:
  enum class Stage : std::uint8_t { kCount, kPlace, kMatch, kCollect, kDone };
  enum class Part : std::uint8_t { kNone, kBoundary, kWall };

  /// A face by its nodes, the lowest being known from its bucket.
  struct Face {
    std::uint32_t middle;
    std::uint32_t highest;
    std::uint32_t owner;  ///< 4 x element + face
  };

  [[nodiscard]] std::uint32_t regionOf(std::size_t owner) const;
  void count(std::size_t first, std::size_t last);
  void place(std::size_t first, std::size_t last);
  void match(std::size_t firstNode, std::size_t lastNode);
  void collect(std::size_t first, std::size_t last);
  void goOn(Stage stage);

  const VolumeMesh* mesh_;
  Stage stage_ = Stage::kCount;
  std::size_t next_ = 0;
  /// The faces whose lowest node is i begin at begins_[i]; while they are placed, the next one goes there.
  std::vector<std::uint32_t> begins_;
  std::vector<Face> faces_;
  std::vector<Part> partOf_;  ///< by owner
  SurfaceMesh boundary_;
  std::vector<std::uint32_t> walls_;
};

}  // namespace tetrafront
