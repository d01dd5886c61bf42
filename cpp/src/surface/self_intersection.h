#pragma once

/// @file Every pair of triangles that meet where they should not, by the exact test of
/// geom/intersect.h over all pairs whose boxes touch and that are not told apart at a common node.

#include <cstdint>
#include <span>
#include <vector>

#include "search/box_tree.h"
#include "surface/boundary_report.h"

namespace tetrafront {

/// In slices. Near-linear for surfaces whose triangles have few others near them.
class SelfIntersectionCheck {
 public:
  /// Triangles flagged in `ignored` take no part. Everything must outlive this.
  SelfIntersectionCheck(const SurfaceMesh& mesh, std::span<const std::uint8_t> ignored,
                        const BoxTree& tree, BoundaryReport& report);

  /// Tests about `budget` triangles against the others; true when finished.
  bool advance(std::uint32_t budget);

  [[nodiscard]] double fraction() const {
    return static_cast<double>(next_) / static_cast<double>(ignored_.size());
  }

 private:
  /// After so many findings the rest would only cost time: some surfaces meet themselves in as
  /// many places as there are pairs.
  static constexpr std::size_t kEnough = 100000;

  void testTriangle(std::uint32_t triangle);

  const SurfaceMesh& mesh_;
  std::span<const std::uint8_t> ignored_;
  const BoxTree& tree_;
  BoundaryReport& report_;
  std::uint32_t next_ = 0;
  std::vector<std::uint32_t> near_;
};

/// The box of each triangle.
[[nodiscard]] std::vector<Box> triangleBoxes(const SurfaceMesh& mesh);

}  // namespace tetrafront
