#pragma once

/// @file The volumes that a closed surface separates, and which of them are meshed.
///
/// If every edge of a component has an even number of triangles, the component separates meshed from empty volume:
/// inside a region it bounds a cavity, and inside that cavity another region. If some edge of a component has an odd
/// number of triangles, the component contains interfaces, and every volume that it encloses is meshed.
/// InnerShells::kByOrientation applies the second rule also to a component inside a region if it faces the same way as the
/// outer shell of this region: both bound bodies. InnerShells::kRegions applies it to every component. If the regions on the
/// sides of the triangles are given, they replace these rules.

#include <cstdint>
#include <span>
#include <vector>

#include "boundary/boundary_report.h"
#include "boundary/shell_nesting.h"
#include "search/box_tree.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "topology/edge_table.h"
#include "topology/half_faces.h"

namespace tetrafront {

struct RegionMap {
  std::vector<ComponentId> componentOf;  ///< per triangle
  std::vector<ShellId> shellOf;          ///< per half-face
  std::vector<Shell> shells;
  /// Per shell: the shell that bounds the same volume from outside. This is the shell itself if its volume is
  /// positive, and none if the volume is unbounded.
  std::vector<ShellId> outerShellOf;
  std::vector<std::uint8_t> isMeshed;  ///< per shell: whether the volume it bounds is meshed
  /// Per component: whether its orientation says that it bounds a body inside a body. Empty if none are looked for.
  std::vector<std::uint8_t> isBody;
  /// Per shell: the given region, SurfaceMesh::kNoRegion if its volume is not meshed; empty if none are given.
  std::vector<std::uint32_t> givenRegionOf;

  /// Returns whether the volume that the half-face looks into is meshed.
  [[nodiscard]] bool isMeshedAt(HalfFaceId halfFace) const {
    return isMeshed[shellOf[halfFace.index()].index()] != 0;
  }
  [[nodiscard]] ShellId outerShellAt(HalfFaceId halfFace) const {
    return outerShellOf[shellOf[halfFace.index()].index()];
  }
  /// Returns whether there is meshed volume on both sides of the triangle.
  [[nodiscard]] bool isInterface(TriangleId triangle) const {
    return isMeshedAt(backOf(triangle)) && isMeshedAt(frontOf(triangle));
  }
  /// Returns whether the half-face looks out of what its component encloses.
  [[nodiscard]] bool looksOut(HalfFaceId halfFace) const {
    return outerShellAt(halfFace) != shellOf[halfFace.index()];
  }
  /// Returns whether the triangle belongs to the outside of a body inside a body.
  [[nodiscard]] bool isOfBody(TriangleId triangle) const {
    return !isBody.empty() && isBody[componentOf[triangle.index()].index()] != 0 &&
           looksOut(backOf(triangle)) != looksOut(frontOf(triangle));
  }
  /// Returns whether the triangle would be an interface if every bounded volume were meshed.
  [[nodiscard]] bool isBetweenBoundedVolumes(TriangleId triangle) const {
    return !outerShellAt(frontOf(triangle)).isNone() && !outerShellAt(backOf(triangle)).isNone();
  }
};

/// What decides which of the volumes are meshed.
struct MeshedRule {
  InnerShells innerShells = InnerShells::kByOrientation;
  /// First triangle whose orientation means something; that of drawn patches does not.
  std::uint32_t firstOriented = 0;
  /// Two per triangle, as SurfaceMesh::triangleRegions, or empty.
  std::span<const std::uint32_t> givenRegions;
};

/// The surface must have no open edges and no self-intersections. Reports kZeroVolume, and kDanglingSheet for
/// triangles with the same volume on both sides; the map is then incomplete. Exact except for the signs of volumes.
/// Reports kInconsistentRegions for triangles whose given regions contradict those of others, or that have none on either
/// side. O(n log n).
[[nodiscard]] RegionMap findRegions(const SurfaceMesh& mesh, const EdgeTable& edges,
                                    const BoxTree& tree, const MeshedRule& rule,
                                    BoundaryReport& report);

}  // namespace tetrafront
