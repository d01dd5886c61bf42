#pragma once

/// @file Tetrahedra whose four nodes are in one plane but for rounding leave no room for points beside
/// them: needles of a turned flat face cross others there, one just below the other. Where two edges of
/// such a flat one nearly meet, a new point a little off the plane takes the position of one of them, and with
/// it of all flat ones there.

#include <array>
#include <vector>

#include "fill/cone.h"
#include "fill/fill_mesh.h"

namespace tetrafront {

class SliverRemoval {
 public:
  explicit SliverRemoval(FillMesh& mesh) : mesh_(mesh), cone_(mesh, none_) {}

  /// Does away with flat tetrahedra at a node, as far as possible; the new points, all inside and of
  /// doubles, are appended. How many there are.
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
