#pragma once

/// @file Plain input: the background grid (Löhner & Parikh 1988, section 3), and sources of size
/// as an addition to it.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// The generation parameters at one node of the background grid.
struct BackgroundNode {
  Vec3 position{0.0};
  double size = 0.0;              ///< wanted edge length across the stretching direction, > 0
  double stretching = 1.0;        ///< wanted length along `direction` divided by `size`, >= 1
  Vec3 direction{1.0, 0.0, 0.0};  ///< stretching direction; unit length is not required
};

enum class SourceType : std::uint8_t {
  kPoint = 0,     ///< uses points[0]
  kSegment = 1,   ///< uses points[0] and points[1]
  kTriangle = 2,  ///< uses all three
};

/// A place around which elements are wanted no larger than
///
///     size + growth max(0, r - distance),    r the distance from the point, segment or triangle.
///
/// Of the background grid and all sources the smallest size wins; where the grid asks for
/// stretched elements, every principal axis is cut down to that size.
struct SizeSource {
  SourceType type = SourceType::kPoint;
  std::array<Vec3, 3> points{Vec3(0.0), Vec3(0.0), Vec3(0.0)};
  double size = 0.0;      ///< > 0
  double distance = 0.0;  ///< up to which `size` holds, >= 0
  double growth = 0.3;    ///< of the size per unit of distance beyond, >= 0; 0: `size` everywhere
};

/// Tetrahedra, in any orientation, that together cover the domain to be meshed.
struct BackgroundGrid {
  std::vector<BackgroundNode> nodes;
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< positions in `nodes`
  std::vector<SizeSource> sources{};

  /// What this far outside still counts as covered, as a share of the longest edge of the nearest
  /// tetrahedron, >= 0. 0 for grids drawn around a model; a generated mesh does not quite reach
  /// the curved patches it was made on (gridFromMesh() sets it).
  double overhang = 0.0;
};

}  // namespace tetrafront
