#pragma once

/// @file Finds all pairs of triangles that intersect where it is not allowed, with the exact test of
/// geom/intersect.h. Pairs without a common node are found by their boxes (triangle_pairs.h). Pairs with a common
/// node are found among the triangles at that node, by the directions in which these lie: the boxes of the
/// thousands of needles around the tip of a cone all overlap, but few needles lie in the same direction.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "boundary/boundary_report.h"
#include "search/box_tree.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Returns the box of each triangle.
[[nodiscard]] std::vector<Box> triangleBoxes(const SurfaceMesh& mesh);

/// Two triangles that intersect where it is not allowed.
struct IntersectingPair {
  TriangleId low;
  TriangleId high;
  friend auto operator<=>(const IntersectingPair&, const IntersectingPair&) = default;
};

/// Returns the pairs of triangles that intersect, ascending. Ignores the triangles whose flag in `ignored` is set. `tree`: tree
/// of triangleBoxes(). Everything must outlive the task. The search ends early after `maxPairs` pairs. O(n log n) for
/// surfaces whose triangles have few others near them.
Task<std::vector<IntersectingPair>> findSelfIntersections(Work& work, const SurfaceMesh& mesh,
                                                          std::span<const std::uint8_t> ignored,
                                                          const BoxTree& tree,
                                                          std::size_t maxPairs);

/// Reports the self-intersections in the order of their triangles, found as by findSelfIntersections(). The search ends early,
/// and the report says so, after 100 000 self-intersections or as many as the report keeps, whichever is more.
Task<> checkSelfIntersections(Work& work, const SurfaceMesh& mesh,
                              std::span<const std::uint8_t> ignored, const BoxTree& tree,
                              BoundaryReport& report);

}  // namespace tetrafront
