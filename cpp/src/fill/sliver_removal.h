#pragma once

/// @file Removes slivers: tetrahedra whose four nodes lie in one plane apart from rounding. They
/// leave no room for points next to them. They occur on flat faces of rotated parts, where one
/// needle crosses another that lies just below it. Where two opposite edges of a sliver nearly
/// meet, a new point slightly off the plane replaces one of these edges, and with it all slivers at
/// the edge.

#include <array>
#include <vector>

#include "fill/cone.h"
#include "fill/fill_mesh.h"

namespace tetrafront {

class SliverRemoval {
 public:
  explicit SliverRemoval(FillMesh& mesh) : mesh_(mesh), cone_(mesh, none_) {}

  /// Removes slivers at a node as far as possible. Appends the new points, which are interior and
  /// exact as doubles, and returns their number.
  std::size_t removeAt(NodeId node, std::vector<NodeId>& made);

 private:
  struct Edge {
    NodeId u;
    NodeId v;
  };
  NodeId replaceOneOf(const NodeQuad& flat);
  NodeId replace(const Edge& edge, const Edge& other);
  bool collectRing(const Edge& edge);

  FillMesh& mesh_;
  ConstraintEdges none_;
  Cone cone_;
  std::vector<TetId> star_;
  std::vector<TetId> ring_;
};

}  // namespace tetrafront
