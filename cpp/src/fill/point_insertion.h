#pragma once

/// @file A tetrahedral mesh of given points, Delaunay but for ties, within a large tetrahedron around
/// them. That it is Delaunay only makes it likely that edges of the boundary are there already. The
/// points come in rounds, each a random half of those left for later ones, along a Morton curve (Amenta,
/// Choi & Rote 2003): in the curve's order alone each next point of a ring of needles would undo what
/// hundreds before it have made.

#include <span>
#include <vector>

#include "fill/cone.h"
#include "fill/fill_mesh.h"

namespace tetrafront {

class PointInsertion {
 public:
  /// Puts the points 0 .. count-1 of `mesh.points` into the large tetrahedron, of which four more
  /// points are made. At least one point must be there. Each `variant` is another order.
  PointInsertion(FillMesh& mesh, unsigned variant);

  [[nodiscard]] std::size_t count() const { return order_.size(); }
  /// To be called for 0 .. count()-1. False if two points are at one position.
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
