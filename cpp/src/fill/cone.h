#pragma once

/// @file The one operation of the exact fill: a cavity emptied and joined to one point, its apex. All
/// outer faces must be seen from the apex by exact signs, so the new tetrahedra fill the cavity. With
/// a new point as apex this inserts it; with a node of the cavity, it swaps edges and faces, or,
/// where the cavity is another node's star, collapses that node.

#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "fill/fill_mesh.h"

namespace tetrafront {

using NodePair = std::pair<NodeId, NodeId>;

[[nodiscard]] inline NodePair lowerFirst(NodeId u, NodeId v) {
  return u < v ? NodePair(u, v) : NodePair(v, u);
}

/// Edges that must stay, by their nodes, least first.
class ConstraintEdges {
 public:
  void add(NodeId u, NodeId v) { edges_.insert(lowerFirst(u, v)); }
  [[nodiscard]] bool contains(NodeId u, NodeId v) const {
    return edges_.contains(lowerFirst(u, v));
  }
  [[nodiscard]] bool empty() const { return edges_.empty(); }
  void clear() { edges_.clear(); }

 private:
  std::set<NodePair> edges_;
};

struct ConeRules {
  /// Where a face is not seen, the tetrahedron behind it may join the cavity, up to so many.
  std::size_t maxCavity = 0;
  /// Tetrahedra whose circumsphere holds the apex join too.
  bool delaunay = false;
  /// The cavity may hold this node inside; it vanishes.
  NodeId lost;
  /// The new faces around `lost` on the boundary, if it was there.
  std::span<const BoundaryFace> boundary;
};

/// Number of tetrahedra that may join a cavity to make a cone possible; more would disturb too much of
/// the mesh around.
inline constexpr std::size_t kMaxCavityGrowth = 200;

class Cone {
 public:
  Cone(FillMesh& mesh, const ConstraintEdges& constraints)
      : mesh_(mesh), constraints_(constraints) {}

  /// Makes the change, or none and returns false. Faces marked as facets and constraint edges stay.
  bool make(NodeId apex, std::span<const TetId> cavity, const ConeRules& rules);
  /// Would it be possible? If so, `shape` is the least shape measure of the new tetrahedra.
  bool plan(NodeId apex, std::span<const TetId> cavity, const ConeRules& rules);
  [[nodiscard]] double minShape() const;
  /// Makes what plan() has found possible.
  bool commit();

 private:
  bool grow(const ConeRules& rules);
  bool look(TetFace face, const ConeRules& rules);
  void enter(TetId tet);
  [[nodiscard]] bool isInCircumsphere(TetFace beyond) const;
  bool collect(const ConeRules& rules);
  bool losesNodes(NodeId lost);
  [[nodiscard]] bool losesEdges() const;

  FillMesh& mesh_;
  const ConstraintEdges& constraints_;
  NodeId apex_;
  NodeId lost_;
  std::span<const BoundaryFace> boundary_;
  std::uint32_t stamp_ = 0;
  std::vector<TetId> cavity_;
  std::vector<TetFace> faces_;  ///< of the cavity's tetrahedra, seen from the apex
  std::vector<NodeQuad> fresh_;
  std::vector<std::uint32_t> nodeStamps_;  ///< stamp_ where a node is in fresh_
};

/// 12 (3V)^(2/3) / (sum of squared edges), cubed: 1 for the regular tetrahedron. In doubles.
[[nodiscard]] double shapeOf(const ExactPoints& points, const NodeQuad& nodes);

}  // namespace tetrafront
