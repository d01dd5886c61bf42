#pragma once

/// @file The one operation of the exact fill: empty a cavity and join its outer faces to one point,
/// the apex. Every outer face must be visible from the apex by exact signs, so the new tetrahedra
/// fill the cavity. If the apex is a new point, this inserts it. If it is a node of the cavity,
/// this swaps edges and faces. If the cavity is the star of another node, this collapses that node.

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

/// Edges that must stay in the mesh.
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
  /// If the apex does not see a face, the tetrahedron behind it may join the cavity, up to this
  /// total number.
  std::size_t maxCavity = 0;
  /// Tetrahedra whose circumsphere contains the apex join too.
  bool delaunay = false;
  /// A node that vanishes: the cavity may contain it in its interior or on the boundary.
  NodeId lost;
  /// The new boundary faces around `lost` if it was on the boundary.
  std::span<const BoundaryFace> boundary;
};

/// Number of tetrahedra that may join a cavity to make a cone possible. A larger cavity would
/// disturb too much of the mesh around it.
inline constexpr std::size_t kMaxCavityGrowth = 200;

class Cone {
 public:
  Cone(FillMesh& mesh, const ConstraintEdges& constraints)
      : mesh_(mesh), constraints_(constraints) {}

  /// Makes the change, or changes nothing and returns false. Faces marked as facets and constraint
  /// edges stay.
  bool make(NodeId apex, std::span<const TetId> cavity, const ConeRules& rules);
  /// Returns true if the change is possible; minShape() and commit() then refer to it.
  bool plan(NodeId apex, std::span<const TetId> cavity, const ConeRules& rules);
  [[nodiscard]] double minShape() const;
  /// Makes the change of the last successful plan().
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
  std::vector<TetFace> faces_;  ///< of the cavity's tetrahedra, visible from the apex
  std::vector<NodeQuad> fresh_;
  std::vector<std::uint32_t> nodeStamps_;  ///< stamp_ if the node is in fresh_
};

/// Returns the cube of the mean ratio 12 (3V)^(2/3) / (sum of squared edge lengths) in doubles, with the
/// sign of the volume V: 1 for the regular tetrahedron, 0 for a degenerate one.
[[nodiscard]] double shapeOf(const ExactPoints& points, const NodeQuad& nodes);

}  // namespace tetrafront
