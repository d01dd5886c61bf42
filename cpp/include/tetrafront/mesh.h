#pragma once

/// @file Plain output and the currency with outsiders: flat arrays, nothing else.

#include <cstdint>
#include <vector>

namespace tetrafront {

/// A triangle surface. Node i is at points[3i .. 3i+2]; triangle t has the nodes
/// triangles[3t .. 3t+2], counter-clockwise seen from outside the meshed region. A wall between two
/// regions is there once, turned either way.
struct SurfaceMesh {
  static constexpr std::uint32_t kNoRegion = 0xffffffffU;

  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  /// Per triangle: position of its patch in the model; for a given surface, its shell.
  std::vector<std::uint32_t> trianglePatch;
  /// Two per triangle: the region from which its nodes are seen clockwise, and the one from which
  /// they are seen counter-clockwise, kNoRegion but for walls. Empty where regions are not known:
  /// then there are no walls.
  std::vector<std::uint32_t> triangleRegions;
  /// The sides of the divided lines: nodes sides[2s], sides[2s+1]. Empty for a given surface.
  std::vector<std::uint32_t> sides;
  /// Per side: position of its line in the model.
  std::vector<std::uint32_t> sideLine;

  [[nodiscard]] bool isWall(std::size_t triangle) const {
    return !triangleRegions.empty() && triangleRegions[2 * triangle + 1] != kNoRegion;
  }
};

/// A tetrahedral mesh. Tetrahedron t has the nodes tetrahedra[4t .. 4t+3] = a b c d with
/// (b-a) x (c-a) . (d-a) > 0. The first nodes are those of the surface, in its order.
///
///        d            faces seen from outside, counter-clockwise:
///       /|\           (b c d) (a d c) (a b d) (a c b)
///      a-+-c
///       \|/
///        b
struct VolumeMesh {
  std::vector<double> points;
  std::vector<std::uint32_t> tetrahedra;
  /// Per tetrahedron: the region it fills, numbered from 0 in order of the shells around them.
  std::vector<std::uint32_t> regions;
  /// What is left of the front where the mesh is not complete: three nodes per active face,
  /// counter-clockwise seen from the still empty side. Empty when the mesh is done.
  std::vector<std::uint32_t> front;
};

}  // namespace tetrafront
