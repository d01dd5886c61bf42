#pragma once

/// @file Makes the given edges and triangles appear in a mesh of their nodes: each edge as a chain
/// of mesh edges, each triangle as a set of faces. Swaps are tried first. If they fail, a point is
/// added where an edge meets a face, or a triangle meets an edge. Each such point permanently
/// removes one crossing and adds none, so this terminates.
///
/// Points are added only when passes of swaps make no more progress. Most edges that cannot be recovered at
/// first can be later, when others are present; but the parts of a split edge must stay, and block swaps.

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
  /// Order in which edges are recovered. Long edges need the most room for swaps, and recovered
  /// edges must stay, so kLongestFirst mostly adds the fewest points. No order is best for all
  /// inputs.
  enum class EdgeOrder : std::uint8_t { kLongestFirst, kByNodes, kShortestFirst };

  /// `triangles` must outlive this object. Their nodes must be nodes of the mesh.
  BoundaryRecovery(FillMesh& mesh, const std::vector<NodeTriple>& triangles, EdgeOrder order);

  /// Works on one edge. Returns kFailed if the triangles self-intersect.
  FillState recoverNextEdge();

  /// Estimated progress over the edges, 0 to 1.
  [[nodiscard]] double edgesFraction() const;

  /// Tetrahedra of stars that were searched for an edge, a measure of work besides the signs.
  [[nodiscard]] std::uint64_t visitedTetrahedra() const { return visitedTetrahedra_; }

  [[nodiscard]] std::size_t triangleCount() const { return triangles_.size(); }
  /// Call it for each triangle when the edges are done. Returns false if the triangles
  /// self-intersect.
  bool recoverTriangle(FacetId triangle);

  /// Points added on the boundary, in the order in which they were made.
  [[nodiscard]] std::span<const NodeId> boundaryPoints() const { return boundaryPoints_; }

 private:
  struct Edge {
    NodeId from;
    NodeId to;
    std::vector<NodeId> chain;  ///< its nodes in order, when recovered
  };
  /// The first node, edge or face that a ray from a node meets.
  struct Hit {
    enum class Kind : std::uint8_t { kNothing, kNode, kEdge, kFace } kind = Kind::kNothing;
    TetId tet;
    std::uint32_t corner = 0;  ///< of `tet`: the start of the ray
    NodeId u;                  ///< the node hit, or with v the ends of the edge hit
    NodeId v;
  };
  using Direction = NodePair;  ///< an edge from its first to its second node

  void collectEdges(EdgeOrder order);
  void sortWaiting(EdgeOrder order);
  void beginPass();
  /// Returns kRunning if swaps do not recover the edge.
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
  /// ascending by nodes: index of the edge
  std::vector<std::pair<NodePair, std::uint32_t>> edgeOf_;
  std::vector<std::uint32_t> waiting_;    ///< edges of this pass
  std::vector<std::uint32_t> postponed_;  ///< edges of the next pass
  std::size_t nextWaiting_ = 0;
  bool maySplit_ = false;
  double passBegan_ = 0.0;  ///< progress over the edges at the start of the pass, 0 to 1
  std::vector<NodeId> boundaryPoints_;
  std::vector<TetId> tets_;
  std::vector<TetId> star_;
  std::uint64_t visitedTetrahedra_ = 0;
  // State of the current triangle.
  std::set<Direction> open_;  ///< edges whose left side is not covered by faces yet
  /// per node: sign relative to the triangle's plane, or kUnknown
  std::vector<std::int8_t> planeSigns_;
  std::vector<NodeId> knownSigns_;
};

}  // namespace tetrafront
