#pragma once

/// @file The tetrahedra of the exact fill, with their neighbours. There is one change: the
/// tetrahedra of a cavity out, others with the same outer faces in.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "fill/exact_points.h"

namespace tetrafront {

/// Corners of the face opposite corner i, counter-clockwise seen from inside: with that corner they
/// make the tetrahedron again.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kInnerCorners{
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// A face of a tetrahedron: which, and the corner opposite.
struct TetFace {
  TetId tet;
  std::uint32_t corner = 0;
  [[nodiscard]] bool isNone() const { return tet.isNone(); }
};

/// A triangle of the FillTask; in the mesh, the triangle that a face is part of.
using FacetId = Id<struct FacetTag>;

/// How a step of the exact fill ended.
enum class FillState : std::uint8_t { kRunning, kDone, kFailed };

struct FillTet {
  NodeQuad nodes;
  std::array<TetFace, 4> across;
  std::array<FacetId, 4> facet;  ///< per face: the given triangle it is part of, or none
};

/// A piece of the boundary, counter-clockwise seen from inside.
struct BoundaryFace {
  NodeTriple nodes;
  FacetId facet;
};

[[nodiscard]] inline bool contains(const NodeTriple& nodes, NodeId node) {
  return nodes[0] == node || nodes[1] == node || nodes[2] == node;
}
[[nodiscard]] inline bool contains(const NodeQuad& nodes, NodeId node) {
  return nodes[0] == node || nodes[1] == node || nodes[2] == node || nodes[3] == node;
}

class FillMesh {
 public:
  ExactPoints points;

  /// The first tetrahedron; its nodes must be in order. All else comes by replace().
  void begin(const NodeQuad& nodes);

  [[nodiscard]] std::size_t slotCount() const { return tets_.size(); }
  [[nodiscard]] bool isLive(TetId tet) const { return !tets_[tet.index()].nodes[0].isNone(); }
  [[nodiscard]] const FillTet& tet(TetId tet) const { return tets_[tet.index()]; }
  [[nodiscard]] NodeTriple innerFace(TetId tet, std::uint32_t corner) const;
  [[nodiscard]] std::uint32_t cornerOf(TetId tet, NodeId node) const;
  [[nodiscard]] bool has(TetId tet, NodeId node) const { return cornerOf(tet, node) < 4; }
  /// One tetrahedron at the node; none if no longer used.
  [[nodiscard]] TetId at(NodeId node) const {
    return node.index() < tetAt_.size() ? tetAt_[node.index()] : TetId();
  }

  /// The tetrahedra at a node that are joined by faces, from at(node) or from `seed` on.
  void star(NodeId node, std::vector<TetId>& result) { spread(at(node), {node, node}, result); }
  void starFrom(TetId seed, NodeId node, std::vector<TetId>& result) {
    spread(seed, {node, node}, result);
  }
  /// The other nodes of a star, ascending, each once.
  [[nodiscard]] std::vector<NodeId> neighboursIn(std::span<const TetId> star, NodeId node) const;
  /// The tetrahedra at an edge of `seed` that are joined by faces.
  void ring(TetId seed, NodeId u, NodeId v, std::vector<TetId>& result) {
    spread(seed, {u, v}, result);
  }

  /// Marks both sides of a face as part of a given triangle.
  void markFacet(TetId tet, std::uint32_t corner, FacetId facet);

  /// Replaces the tetrahedra of a cavity. Faces of `fresh` that pair neither with each other nor
  /// with an outer face of the cavity must be given in `boundary`; outer faces on the boundary that
  /// contain `lost` need no partner. False, and nothing changed, if anything is left over.
  bool replace(std::span<const TetId> old, std::span<const NodeQuad> fresh, NodeId lost,
               std::span<const BoundaryFace> boundary);

  /// What the last replacement has made.
  [[nodiscard]] std::span<const TetId> lastCreated() const { return freshIds_; }

  /// Keeps only the tetrahedra so marked; faces between kept ones and others become boundary.
  void keep(const std::vector<std::uint8_t>& kept);
  /// Gives the tetrahedra of `sector` a point of their own in position of `node`.
  void separate(std::span<const TetId> sector, NodeId node, NodeId own);

  /// Marks of a fresh set of tetrahedra.
  std::uint32_t nextStamp() { return ++stamp_; }
  void stamp(TetId tet, std::uint32_t value) { stamps_[tet.index()] = value; }
  [[nodiscard]] bool hasStamp(TetId tet, std::uint32_t value) const {
    return stamps_[tet.index()] == value;
  }

 private:
  struct FaceSlot {
    NodeTriple key;
    TetFace face;     ///< of a fresh tetrahedron (tet: its position), or none
    TetFace outside;  ///< for an outer face: what is beyond
    FacetId facet;
  };

  void spread(TetId seed, const std::array<NodeId, 2>& nodes, std::vector<TetId>& result);
  void collectOuterFaces(std::span<const TetId> old, NodeId lost);
  void collectFreshFaces(std::span<const NodeQuad> fresh);
  [[nodiscard]] bool facesPair() const;
  TetId takeSlot();

  std::vector<FillTet> tets_;
  std::vector<std::uint32_t> stamps_;
  std::vector<TetId> freeSlots_;
  std::vector<TetId> tetAt_;
  std::uint32_t stamp_ = 0;
  std::vector<FaceSlot> slots_;
  std::vector<TetId> freshIds_;
};

}  // namespace tetrafront
