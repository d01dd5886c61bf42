#pragma once

/// @file Plain output and the currency with outsiders: flat arrays, nothing else.

#include <cstdint>
#include <vector>

namespace tetrafront {

/// A triangle surface. Node i is at points[3i .. 3i+2]; triangle t has the nodes
/// triangles[3t .. 3t+2], counter-clockwise seen from outside the meshed region.
struct SurfaceMesh {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  /// Per triangle: position of its patch in the model; for a given surface, its shell.
  std::vector<std::uint32_t> trianglePatch;
  /// The sides of the divided lines: nodes sides[2s], sides[2s+1]. Empty for a given surface.
  std::vector<std::uint32_t> sides;
  /// Per side: position of its line in the model.
  std::vector<std::uint32_t> sideLine;
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
  /// Per tetrahedron: the region it fills, numbered from 0 in order of the outer shells.
  std::vector<std::uint32_t> regions;
  /// What is left of the front where the mesh is not complete: three nodes per active face,
  /// counter-clockwise seen from the still empty side. Empty when the mesh is done.
  std::vector<std::uint32_t> front;
};

}  // namespace tetrafront
