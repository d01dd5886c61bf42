#pragma once

/// @file The tetrahedra of the exact fill, with their neighbours. There is one change: the
/// tetrahedra of a cavity are replaced by others with the same outer faces.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "fill/exact_points.h"

namespace tetrafront {

/// A face of a tetrahedron, given by its opposite corner.
struct TetFace {
  TetId tet;
  std::uint32_t corner = 0;
  [[nodiscard]] bool isNone() const { return tet.isNone(); }
};

/// A triangle of the FillTask. In the mesh: the given triangle that a face is part of.
using FacetId = Id<struct FacetTag>;

/// Result of a step of the exact fill.
enum class FillState : std::uint8_t { kRunning, kDone, kFailed };

struct FillTet {
  NodeQuad nodes;
  std::array<TetFace, 4> across;
  std::array<FacetId, 4> facet;  ///< per face: the given triangle it is part of, or none
};

/// A face of the boundary, counter-clockwise seen from inside.
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

  /// Creates the first tetrahedron, which must be positively oriented. All others come from
  /// replace().
  void begin(const NodeQuad& nodes);

  [[nodiscard]] std::size_t slotCount() const { return tets_.size(); }
  [[nodiscard]] bool isLive(TetId tet) const { return !tets_[tet.index()].nodes[0].isNone(); }
  [[nodiscard]] const FillTet& tet(TetId tet) const { return tets_[tet.index()]; }
  [[nodiscard]] NodeTriple innerFace(TetId tet, std::uint32_t corner) const;
  [[nodiscard]] std::uint32_t cornerOf(TetId tet, NodeId node) const;
  [[nodiscard]] bool has(TetId tet, NodeId node) const { return cornerOf(tet, node) < 4; }
  /// Returns one tetrahedron at the node, or none if no tetrahedron uses it.
  [[nodiscard]] TetId at(NodeId node) const {
    return node.index() < tetAt_.size() ? tetAt_[node.index()] : TetId();
  }

  /// Collects the tetrahedra at a node that are connected over faces, starting at at(node) or at
  /// `seed`.
  void star(NodeId node, std::vector<TetId>& result) { spread(at(node), {node, node}, result); }
  void starFrom(TetId seed, NodeId node, std::vector<TetId>& result) {
    spread(seed, {node, node}, result);
  }
  /// Returns the other nodes of a star, ascending, each once.
  [[nodiscard]] std::vector<NodeId> neighboursIn(std::span<const TetId> star, NodeId node) const;
  /// Collects the tetrahedra at the edge u-v that are connected over faces, starting at `seed`.
  void ring(TetId seed, NodeId u, NodeId v, std::vector<TetId>& result) {
    spread(seed, {u, v}, result);
  }

  /// Marks both half-faces as part of a given triangle.
  void markFacet(TetId tet, std::uint32_t corner, FacetId facet);

  /// Replaces the tetrahedra of a cavity. A face of `fresh` must pair with another face of `fresh`,
  /// with an outer face of the cavity, or with a face in `boundary`. Outer faces on the boundary
  /// that contain `lost` need no partner. If a face is left over, changes nothing and returns
  /// false. O(n log n) in the number of faces.
  bool replace(std::span<const TetId> old, std::span<const NodeQuad> fresh, NodeId lost,
               std::span<const BoundaryFace> boundary);

  /// The tetrahedra that the last replacement created.
  [[nodiscard]] std::span<const TetId> lastCreated() const { return freshIds_; }

  /// Removes the tetrahedra for which `kept` (one entry per slot) is 0; faces between kept and
  /// removed ones become boundary.
  void keep(const std::vector<std::uint8_t>& kept);
  /// Replaces `node` by the point `own` in the tetrahedra of `sector`.
  void separate(std::span<const TetId> sector, NodeId node, NodeId own);

  /// Returns a new stamp, which marks no tetrahedron yet.
  std::uint32_t nextStamp() { return ++stamp_; }
  void stamp(TetId tet, std::uint32_t value) { stamps_[tet.index()] = value; }
  [[nodiscard]] bool hasStamp(TetId tet, std::uint32_t value) const {
    return stamps_[tet.index()] == value;
  }

 private:
  struct FaceSlot {
    NodeTriple key;
    TetFace face;     ///< of a fresh tetrahedron (tet: its index in `fresh`), or none
    TetFace outside;  ///< for an outer face: the half-face beyond
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
