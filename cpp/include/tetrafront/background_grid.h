#pragma once

/// @file Input: the background grid (Löhner & Parikh 1988, section 3) and, as an addition to it, size sources.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Node of the background grid with its generation parameters.
struct BackgroundNode {
  Vec3 position{0.0};
  double size = 0.0;              ///< target edge length across the stretching direction, > 0
  double stretching = 1.0;        ///< target length along `direction` / `size`, >= 1
  Vec3 direction{1.0, 0.0, 0.0};  ///< stretching direction, of any length
};

/// Second stretching of a background node, along a direction orthogonal to its first one: elements may be thin in one
/// direction and wide in two.
struct SecondStretching {
  double stretching = 1.0;  ///< target length along `direction` / size of the node, >= 1
  /// Of any length. If the first stretching is above 1 too, the cosine of the angle between the two directions is at most
  /// kMaxDirectionCosine, and the part orthogonal to the first direction counts.
  Vec3 direction{0.0, 1.0, 0.0};
};

/// Two directions of a node with a smaller cosine than this are orthogonal, up to the rounding of typed decimals.
inline constexpr double kMaxDirectionCosine = 0.01;

enum class SourceType : std::uint8_t {
  kPoint = 0,     ///< uses points[0]
  kSegment = 1,   ///< uses points[0] and points[1]
  kTriangle = 2,  ///< uses all three
};

/// Caps the element size near a point, segment or triangle, at distance r from it, at
///
///     size + growth max(0, r - distance).
///
/// The smallest size of the background grid and all sources applies. In a stretched grid, every principal size is
/// capped at the size of the sources.
struct SizeSource {
  SourceType type = SourceType::kPoint;
  std::array<Vec3, 3> points{Vec3(0.0), Vec3(0.0), Vec3(0.0)};
  double size = 0.0;      ///< > 0
  double distance = 0.0;  ///< distance up to which `size` applies, >= 0
  /// Growth of the cap per unit of distance beyond, >= 0; 0: `size` everywhere.
  double growth = 0.3;
};

/// Tetrahedra in any orientation that cover the meshed domain.
struct BackgroundGrid {
  std::vector<BackgroundNode> nodes;
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< indices into `nodes`
  std::vector<SizeSource> sources{};

  /// Distance outside the grid that still counts as covered, relative to the longest edge of the nearest
  /// tetrahedron, >= 0. 0 suits a grid around a model. gridFromMesh() sets it, because a mesh does not quite reach
  /// the curved patches from which it was generated.
  double coverageMargin = 0.0;

  /// One per node, or none if no node has a second stretching. If any is above 1, metrics are interpolated and limited as
  /// such (field/grid_locator.h); otherwise sizes are.
  std::vector<SecondStretching> secondStretchings{};
};

}  // namespace tetrafront
