#pragma once

/// @file Where the triangles of a surface intersect: a point or a segment for each pair that is not in one plane. Exact.

#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/cut_graph.h"
#include "arrangement/cut_points.h"
#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "topology/disjoint_sets.h"

namespace tetrafront {

/// Cuts of triangles, and the sets of triangles that overlap in one plane.
class TriangleCuts {
 public:
  /// A cut of one triangle.
  struct Cut {
    TriangleId triangle;
    CutSegment segment;
  };

  /// Both must outlive this object.
  TriangleCuts(const SurfaceMesh& mesh, CutPoints& points);

  /// Adds the cuts of two triangles that intersect. Neither may be degenerate.
  void addPair(TriangleId a, TriangleId b);

  /// Returns all cuts, in the order of their triangles; call once.
  [[nodiscard]] std::vector<Cut> takeCuts();
  /// Returns the triangles that are cut or overlap others in their plane: in sets of triangles that overlap, each ascending,
  /// in the order of their lowest triangles. `cuts`: all cuts, sorted.
  [[nodiscard]] std::vector<std::vector<TriangleId>> takeGroups(std::span<const Cut> cuts);

 private:
  /// Adds the points where corners and edges of one triangle are on the other.
  void collectPoints(const NodeTriple& triangle, const NodeTriple& other,
                     const std::array<int, 3>& sides, std::vector<CutPointId>& found);
  [[nodiscard]] std::array<int, 3> sidesOf(const NodeTriple& triangle,
                                           const NodeTriple& other) const;
  [[nodiscard]] bool isCornerInside(const NodeTriple& triangle, NodeId corner) const;
  [[nodiscard]] bool isEdgeThrough(const NodeTriple& triangle, NodeId from, NodeId to) const;

  const SurfaceMesh& mesh_;
  CutPoints& points_;
  std::vector<Cut> cuts_;
  DisjointSets coplanar_;
  std::vector<std::uint8_t>
      isCoplanar_;  ///< per triangle: whether it overlaps another one in its plane
};

}  // namespace tetrafront
