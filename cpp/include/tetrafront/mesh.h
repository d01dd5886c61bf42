#pragma once

/// @file Meshes as flat arrays: what the public calls take and return.

#include <cstdint>
#include <vector>

namespace tetrafront {

/// A triangle surface. Node i is at points[3i .. 3i+2]. Triangle t has the nodes triangles[3t .. 3t+2],
/// counter-clockwise seen from outside the meshed region. An interface between two regions is stored once, in
/// either orientation.
struct SurfaceMesh {
  static constexpr std::uint32_t kNoRegion = 0xffffffffU;

  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  /// Per triangle: the index of its patch, first those of the model, then those of the bodies; in a given surface, the
  /// index of its shell.
  std::vector<std::uint32_t> trianglePatch;
  /// Two per triangle: the region that sees its nodes clockwise, then the region that sees them
  /// counter-clockwise, which is kNoRegion unless the triangle is an interface. Empty if the regions are not
  /// known; then no triangle counts as an interface.
  std::vector<std::uint32_t> triangleRegions;
  /// Sides of the divided lines: side s has the nodes sides[2s] and sides[2s+1]. Empty for a given surface.
  std::vector<std::uint32_t> sides;
  /// Per side: the index of its line in the model.
  std::vector<std::uint32_t> sideLine;

  /// True if the triangle lies between two regions.
  [[nodiscard]] bool isInterface(std::size_t triangle) const {
    return !triangleRegions.empty() && triangleRegions[2 * triangle + 1] != kNoRegion;
  }
};

/// Regions of a given surface that are known before it is meshed, for example from points that mark them in its file.
struct GivenRegions {
  /// Two per triangle, as SurfaceMesh::triangleRegions: what is meshed on either side. Empty if nothing is known.
  std::vector<std::uint32_t> triangleRegions;
  /// Per index in triangleRegions: largest volume of a tetrahedron, in cubed model units; 0 for no limit. Further ones
  /// have no limit.
  std::vector<double> maxVolumes;
};

/// Closed surfaces beside a drawn model, all in one: the triangles of the bodies of a project. They are kept.
struct BodySurfaces {
  std::vector<double> points;            ///< x y z per node
  std::vector<std::uint32_t> triangles;  ///< three nodes per triangle, in either orientation
  /// Per triangle: the index of its patch among the patches of all bodies, below `patches`.
  std::vector<std::uint32_t> trianglePatch;
  std::uint32_t patches = 0;  ///< number of patches of all bodies
};

/// A tetrahedral mesh. Tetrahedron t has the nodes tetrahedra[4t .. 4t+3] = a b c d with
/// (b-a) x (c-a) . (d-a) > 0. The nodes of the surface come first, in the surface's order.
///
///        d            faces seen from outside, counter-clockwise:
///       /|\           (b c d) (a d c) (a b d) (a c b)
///      a-+-c
///       \|/
///        b
struct VolumeMesh {
  std::vector<double> points;
  std::vector<std::uint32_t> tetrahedra;
  /// Per tetrahedron: the index of its region. Regions are numbered from 0 in the order of their outer shells.
  std::vector<std::uint32_t> regions;
  /// The remaining front of an incomplete mesh: three nodes per active face, counter-clockwise seen from the
  /// empty volume. Empty if the mesh is complete.
  std::vector<std::uint32_t> front;
};

}  // namespace tetrafront
