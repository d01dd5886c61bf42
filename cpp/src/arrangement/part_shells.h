#pragma once

/// @file The shells of an arrangement and how often its triangles wind around the volume that each shell bounds. From them
/// follows the boundary of the inside.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/arrangement.h"
#include "base/ids.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// A part of a triangle that bounds the inside.
struct BoundaryPart {
  std::array<CutPointId, 3> points;  ///< counter-clockwise as seen from outside
  TriangleId origin;                 ///< triangle of the surface
  bool isInterface = false;          ///< there is inside on either side
  /// Regions behind and before it, if those of the surface are known.
  std::array<std::uint32_t, 2> regions{SurfaceMesh::kNoRegion, SurfaceMesh::kNoRegion};
};

/// A region in which a volume lies that belongs to another one.
struct SharingRegion {
  std::uint32_t region = 0;
  bool isAround = false;  ///< it contains the other region as a whole
};

/// A volume that lies in several regions.
struct SharedCell {
  std::uint32_t owner = 0;  ///< the region that gets the volume
  std::vector<SharingRegion> others;
  double volume = 0.0;
  double width = 0.0;  ///< 2 x volume / area: the mean width, if it is thin
  Vec3 position{0.0};  ///< on its boundary
};

struct InsideBoundary {
  std::vector<BoundaryPart> parts;
  double area = 0.0;       ///< of all parts of the arrangement
  double sheetArea = 0.0;  ///< of the parts with the same volume on both sides
  /// If the regions of the surface are given: whether they contradict each other. The boundary is then that without regions.
  bool areRegionsInconsistent = false;
  std::vector<SharedCell> shared;  ///< if the regions of the surface are given
};

/// Returns the boundary of the inside, in the order of the triangles that it comes from. `isInterface`: per triangle, whether it stands for
/// two triangles of opposite orientation; empty if none does.
///
/// Each component of the arrangement, which is connected over edges, is considered alone. Parts with the same volume on both sides, as those of fins, are left
/// out first. Crossing a triangle from its front to its back adds one to the winding number. If this gives each volume one
/// number, the volumes with positive numbers are inside, or those with negative numbers if there are no positive ones. Between two of
/// them, parts of triangles with opposite orientations remain as interfaces. If the numbers contradict each
/// other, because interfaces end at an edge, every bounded volume is inside, and all parts between different
/// volumes remain.
///
/// If the surface has triangleRegions, the winding number of each region is counted alone, over all components. Of the regions
/// with positive ones, a volume belongs to one that contains no other of them as a whole (CellRegions), and the parts between different
/// regions remain.
///
/// Exact except for the signs of volumes. O(n log n).
[[nodiscard]] InsideBoundary boundaryOfInside(const SurfaceMesh& mesh,
                                              const Arrangement& arrangement,
                                              std::span<const std::uint8_t> isInterface);

}  // namespace tetrafront
