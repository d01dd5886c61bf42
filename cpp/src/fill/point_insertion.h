#pragma once

/// @file Builds a tetrahedral mesh of the given points inside a large tetrahedron. It is Delaunay
/// except for ties; this makes it likely that edges of the boundary exist from the start. Points
/// are inserted in rounds, each a random half of the points left for later rounds, along a Morton
/// curve (Amenta, Choi & Rote 2003). In the order of the curve alone, each point of a ring of
/// needles would undo what hundreds of points before it made.

#include <span>
#include <vector>

#include "fill/cone.h"
#include "fill/fill_mesh.h"

namespace tetrafront {

class PointInsertion {
 public:
  /// Prepares to insert the points 0 .. count-1 of `mesh.points` into the large tetrahedron, for
  /// which it adds four points. At least one point must exist. Each `variant` is another order.
  PointInsertion(FillMesh& mesh, unsigned variant);

  [[nodiscard]] std::size_t count() const { return order_.size(); }
  /// Call it for 0 .. count()-1. Returns false if two points have the same position.
  bool insert(std::size_t index);

 private:
  [[nodiscard]] TetId locate(NodeId node) const;
  [[nodiscard]] std::uint32_t faceTowards(TetId tet, NodeId node, std::size_t first) const;

  FillMesh& mesh_;
  ConstraintEdges none_;
  Cone cone_;
  std::vector<std::uint32_t> order_;
  NodeId last_;
};

}  // namespace tetrafront
