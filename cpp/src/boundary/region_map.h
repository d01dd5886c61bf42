#pragma once

/// @file The spaces that a closed surface divides, and which of them are filled.
///
/// A part of the surface that is connected over edges, all of which have an even number of triangles,
/// is a skin: it divides what is filled from what is not, so that within a body it bounds a cavity,
/// and within that an island. Where an odd number of triangles meet at some edge of a part, it has
/// walls, and every space that the part encloses is filled. On wish that holds for every part.

#include <cstdint>
#include <vector>

#include "search/box_tree.h"
#include "boundary/boundary_report.h"
#include "boundary/edge_table.h"
#include "boundary/shell_nesting.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"

namespace tetrafront {

struct RegionMap {
  std::vector<std::uint32_t> componentOf;  ///< per triangle: what it is connected with over edges
  std::vector<std::uint32_t> shellOf;      ///< per side (half_faces.h)
  std::vector<Shell> shells;
  /// Per shell: the shell that bounds the same space from outside, itself if its volume is positive;
  /// or kUnbounded.
  std::vector<std::uint32_t> outerShellOf;
  std::vector<std::uint8_t> isMeshed;  ///< per shell: whether the space it looks into is

  static constexpr std::uint32_t kUnbounded = 0xffffffffU;

  [[nodiscard]] bool isMeshedAt(std::uint32_t side) const { return isMeshed[shellOf[side]] != 0; }
  [[nodiscard]] std::uint32_t outerShellAt(std::uint32_t side) const {
    return outerShellOf[shellOf[side]];
  }
};

/// The surface must have no open edge and not meet itself. Reports kZeroVolume, and kDanglingSheet for
/// triangles with one space on both sides; then the rest is not complete. Exact but for the signs of
/// volumes. O(n log n).
[[nodiscard]] RegionMap findRegions(const SurfaceMesh& mesh, const EdgeTable& edges,
                                    const BoxTree& tree, EnclosedBodies enclosed,
                                    BoundaryReport& report);

}  // namespace tetrafront
