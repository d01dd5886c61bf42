#pragma once

/// @file The triangles that the remesher changes. Edges may have any number of triangles, so there
/// are no links across edges. Instead, each node has a list of its corners.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "remesh/feature_line.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"
#include "topology/edge_table.h"

namespace tetrafront {

/// How a node may move.
enum class NodeKind : std::uint8_t {
  kSmooth,  ///< moves on its patch
  kLine,    ///< moves along its feature line
  kCorner,  ///< stays
};

/// The part of a feature line, between two arcs, that an edge represents.
struct Stretch {
  FeatureLineId line{};
  double begin = 0.0;  ///< arc at `from`
  double end = 0.0;    ///< arc at the other end, larger
  NodeId from{};
};
using StretchId = Id<struct StretchTag>;

class SurfaceComplex {
 public:
  /// A copy of the surface that `reference` describes, which must outlive this.
  explicit SurfaceComplex(const ReferenceSurface& reference);

  // ---- nodes ----

  [[nodiscard]] std::size_t nodeCount() const { return points_.size(); }
  [[nodiscard]] const Vec3& pointOf(NodeId node) const { return points_[node.index()]; }
  [[nodiscard]] NodeKind kindOf(NodeId node) const { return kinds_[node.index()]; }
  /// True if at least one triangle uses the node.
  [[nodiscard]] bool isUsed(NodeId node) const { return !firstCorner_[node.index()].isNone(); }
  NodeId addNode(const Vec3& point, NodeKind kind);
  /// Removes the node that was added last; no triangle may use it.
  void removeLastNode();
  void putOnLine(NodeId node) { kinds_[node.index()] = NodeKind::kLine; }
  void moveNode(NodeId node, const Vec3& point) { points_[node.index()] = point; }

  // ---- triangles ----

  /// Number of slots, including empty ones.
  [[nodiscard]] std::size_t triangleSlots() const { return patches_.size(); }
  [[nodiscard]] std::size_t triangleCount() const { return patches_.size() - free_.size(); }
  [[nodiscard]] bool isAlive(TriangleId triangle) const { return !patchOf(triangle).isNone(); }
  [[nodiscard]] const NodeTriple& nodesOf(TriangleId triangle) const {
    return triangles_[triangle.index()];
  }
  [[nodiscard]] std::array<Vec3, 3> cornersOf(TriangleId triangle) const {
    const auto [a, b, c] = nodesOf(triangle);
    return {pointOf(a), pointOf(b), pointOf(c)};
  }
  [[nodiscard]] SmoothPatchId patchOf(TriangleId triangle) const {
    return patches_[triangle.index()];
  }
  TriangleId addTriangle(const NodeTriple& nodes, SmoothPatchId patch);
  void removeTriangle(TriangleId triangle);

  // ---- around a node ----

  /// Calls visit(triangle, k) for each triangle that has the node, as its corner k.
  template <class Visit>
  void visitStar(NodeId node, Visit visit) const {
    for (HalfEdgeId at = firstCorner_[node.index()]; !at.isNone(); at = nextCorner_[at.index()]) {
      visit(triangleOf(at), at.value % 3);
    }
  }
  /// Writes the triangles of the node to `star`.
  void collectStar(NodeId node, std::vector<TriangleId>& star) const;
  /// Writes the neighbours of the node to `ring`, each once.
  void collectRing(NodeId node, std::vector<NodeId>& ring) const;
  [[nodiscard]] bool areJoined(NodeId a, NodeId b) const { return !halfEdgeBetween(a, b).isNone(); }

  /// Writes the half-edges between two nodes, in either direction, to `edges`.
  void collectEdge(NodeId a, NodeId b, std::vector<HalfEdgeId>& edges) const;
  /// Returns a half-edge between two nodes in either direction, or none.
  [[nodiscard]] HalfEdgeId halfEdgeBetween(NodeId a, NodeId b) const;
  /// The ends of a half-edge, and the third node of its triangle.
  [[nodiscard]] HalfEdgeNodes nodesOf(HalfEdgeId halfEdge) const {
    const NodeTriple& nodes = triangles_[triangleOf(halfEdge).index()];
    const std::uint32_t k = halfEdge.value % 3;
    return {nodes[k], nodes[(k + 1) % 3], nodes[(k + 2) % 3]};
  }

  // ---- feature lines ----

  [[nodiscard]] const Stretch& stretch(StretchId id) const { return stretches_[id.index()]; }
  [[nodiscard]] Stretch& stretch(StretchId id) { return stretches_[id.index()]; }
  /// The stretch of a half-edge, or none.
  [[nodiscard]] StretchId stretchOf(HalfEdgeId halfEdge) const {
    return stretchOf_[halfEdge.index()];
  }
  [[nodiscard]] StretchId stretchBetween(NodeId a, NodeId b) const;
  StretchId addStretch(const Stretch& stretch);
  void removeStretch(StretchId id) { freeStretches_.push_back(id); }
  void setStretch(HalfEdgeId halfEdge, StretchId id) { stretchOf_[halfEdge.index()] = id; }
  /// Sets the stretch of all half-edges between two nodes.
  void setStretchBetween(NodeId a, NodeId b, StretchId id);
  /// The neighbours of a node on its feature line, in the direction of the line; an entry without a
  /// neighbour is none.
  struct LineNeighbours {
    NodeId before{};
    NodeId after{};
    StretchId first{};   ///< from `before`
    StretchId second{};  ///< to `after`
    [[nodiscard]] bool areComplete() const {
      return !before.isNone() && !after.isNone() && before != after;
    }
  };
  [[nodiscard]] LineNeighbours lineNeighbours(NodeId node) const;

 private:
  /// Swaps the ends of an edge if there are fewer corners at `b`: a hub can have thousands. The triangles of the edge are in the same order in
  /// both lists, the last added first.
  void preferFewCorners(NodeId& a, NodeId& b) const;

  std::vector<Vec3> points_;
  std::vector<NodeKind> kinds_;
  std::vector<HalfEdgeId> firstCorner_;     ///< per node
  std::vector<std::uint32_t> cornerCount_;  ///< per node
  std::vector<NodeTriple> triangles_;
  std::vector<SmoothPatchId> patches_;  ///< none in empty slots
  std::vector<HalfEdgeId> nextCorner_;  ///< per corner: the next at the same node
  std::vector<StretchId> stretchOf_;    ///< per half-edge
  std::vector<TriangleId> free_;
  std::vector<Stretch> stretches_;
  std::vector<StretchId> freeStretches_;
};

/// Returns true if a collapse of the edge keeps the topology: its ends have no common neighbours except the apexes of its
/// triangles. `edge`: all half-edges between the two ends. `ringA`, `ringB`: the neighbours of each end.
[[nodiscard]] bool collapseKeepsTopology(std::span<const HalfEdgeId> edge,
                                         std::span<const NodeId> ringA,
                                         std::span<const NodeId> ringB);

}  // namespace tetrafront
