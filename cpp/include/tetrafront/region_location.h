#pragma once

/// @file Finds in which of the volumes that a surface encloses given positions lie. Files of TetGen and others mark the
/// regions and holes of a model in this way.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/sliced_tool.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Volumes that a surface encloses, and the positions in them.
struct RegionLocation {
  /// In RegionLocation::volumeOf: outside all volumes, or on a triangle.
  static constexpr std::uint32_t kOutside = 0xffffffffU;
  static constexpr std::uint32_t kOnBoundary = 0xfffffffeU;

  std::uint32_t volumes =
      0;  ///< number of enclosed volumes, numbered in the order of their outer shells
  /// The given triangles; those of the outside face outward.
  std::vector<std::uint32_t> triangles;
  /// Two per triangle, as SurfaceMesh::triangleRegions: every enclosed volume counts as a region.
  std::vector<std::uint32_t> triangleRegions;
  std::vector<std::uint32_t> volumeOf;  ///< per position: its volume, kOutside or kOnBoundary
  /// Not empty if the surface cannot be meshed, as MeshRun reports it; nothing else is set then.
  std::vector<Diagnostic> diagnostics;
};

/// Locates positions in slices; exact. O(n log n) for n triangles, and O(triangles near a ray) per position.
class RegionLocator : public SlicedTool<RegionLocation> {
 public:
  /// Arrays as for MeshRun, in any orientation; they are copied. `positions`: x y z each, finite.
  RegionLocator(std::span<const double> points, std::span<const std::uint32_t> triangles,
                std::span<const double> positions);
};

}  // namespace tetrafront
