#pragma once

/// @file Makes the given edges and triangles appear in a mesh of their nodes: each edge as a chain of
/// edges, each triangle as a sheet of faces. Where swaps do not do it, a point is put where an edge
/// meets a face, or a triangle an edge. With every such point one crossing is gone for good and none
/// is made, so this ends. Points wait until swaps alone get no further: most edges that cannot be had
/// at first can be once others are there, while pieces of split edges, which must stay, block the
/// swaps of the rest.

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "fill/cone.h"
#include "fill/fill_mesh.h"

namespace tetrafront {

class BoundaryRecovery {
 public:
  /// In which the edges are recovered. Long edges need the most room for swaps, and edges that are
  /// there must stay, so the first order mostly makes the fewest points; but no order is best for all.
  enum class EdgeOrder : std::uint8_t { kLongestFirst, kByNodes, kShortestFirst };

  /// `triangles` must outlive this. All their nodes must be nodes of the mesh.
  BoundaryRecovery(FillMesh& mesh, const std::vector<NodeTriple>& triangles, EdgeOrder order);

  /// Works on one edge.
  FillState recoverNextEdge();

  /// How far the edges are, 0 to 1, estimated.
  [[nodiscard]] double edgesFraction() const;

  [[nodiscard]] std::size_t triangleCount() const { return triangles_.size(); }
  /// To be called for all triangles once the edges are done. False if it cannot be.
  bool recoverTriangle(FacetId triangle);

  /// Points put on the boundary, in the order they were made.
  [[nodiscard]] std::span<const NodeId> boundaryPoints() const { return boundaryPoints_; }

 private:
  struct Edge {
    NodeId from;
    NodeId to;
    std::vector<NodeId> chain;  ///< all its nodes in order, once recovered
  };
  /// What a ray from a node meets first.
  struct Hit {
    enum class Kind : std::uint8_t { kNothing, kNode, kEdge, kFace } kind = Kind::kNothing;
    TetId tet;
    std::uint32_t corner = 0;  ///< where the ray starts
    NodeId u;                  ///< the node, or the edge's ends
    NodeId v;
  };
  using Direction = NodePair;  ///< an edge in the order of its ends

  void collectEdges(EdgeOrder order);
  void sortWaiting(EdgeOrder order);
  void beginPass();
  /// kRunning: swaps do not do it.
  FillState recoverEdge(Edge& edge);
  Hit firstHit(NodeId from, NodeId towards);
  [[nodiscard]] Hit walkToHit(NodeId from, NodeId towards) const;
  Hit hitInTet(TetId tet, NodeId from, NodeId towards, std::uint32_t& away) const;
  void tetsAtHit(const Hit& hit, std::vector<TetId>& result);
  bool swapAtHit(const Hit& hit, NodeId apex);
  NodeId splitEdgeAt(const Edge& edge, const Hit& hit);

  void beginTriangle(FacetId triangle);
  [[nodiscard]] std::vector<NodeId> chainBetween(NodeId from, NodeId to) const;
  bool findFaceAt(FacetId triangle, Direction edge);
  bool passCrossing(FacetId triangle, Direction edge, NodeId below, NodeId above, TetId tet);
  bool splitCrossing(FacetId triangle, NodeId below, NodeId above, std::span<const TetId> around);
  void markFace(FacetId triangle, TetId tet, NodeId x, NodeId y, NodeId w);
  void close(Direction edge);

  FillMesh& mesh_;
  const std::vector<NodeTriple>& triangles_;
  ConstraintEdges constraints_;
  Cone cone_;
  std::vector<Edge> edges_;
  std::vector<std::pair<NodePair, std::uint32_t>> edgeOf_;  ///< sorted
  std::vector<std::uint32_t> waiting_;                      ///< edges of this pass
  std::vector<std::uint32_t> postponed_;                    ///< to the next
  std::size_t nextWaiting_ = 0;
  bool maySplit_ = false;
  double passBegan_ = 0.0;  ///< on the way of the edges, 0 to 1
  std::vector<NodeId> boundaryPoints_;
  std::vector<TetId> tets_;
  std::vector<TetId> star_;
  // Of the triangle at work:
  std::set<Direction> open_;             ///< edges whose left side is not yet covered by faces
  std::vector<std::int8_t> planeSigns_;  ///< per node; kUnknown until asked for
  std::vector<NodeId> knownSigns_;
};

}  // namespace tetrafront
