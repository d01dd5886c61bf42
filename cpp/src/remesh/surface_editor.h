#pragma once

/// @file The operations of the remesher: split, absorb, collapse, flip and move. They keep the number
/// of triangles at every edge. Corners do not move, nodes of a feature line stay on it, and other
/// nodes stay in their patch. Every feature edge and its stretch of the line stay within the
/// tolerance of each other. GuardedSurface rejects changes that violate its other conditions.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.h"
#include "field/size_tensor.h"
#include "remesh/guarded_surface.h"
#include "remesh/remesh_sizes.h"
#include "remesh/surface_complex.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Conditions under which a collapse is made.
struct CollapseRule {
  double longest = 1.4;  ///< largest length of a new edge, in target lengths
  /// Smallest radius ratio of a new triangle, unless a removed one was below it or no new angle is smaller than the
  /// smallest removed one.
  double poorest = 0.3;
  bool mustImprove = false;  ///< the smallest radius ratio must rise
};

/// kSmooth raises the mean radius ratio, or the poorest one; kImprove only the poorest one, also by a little.
enum class MovePurpose : std::uint8_t { kSmooth, kImprove };

class SurfaceEditor {
 public:
  /// The first two must outlive this. `isSettled`: per node, 1 if its triangles need no change; empty if none is. `keepsSettled`: these
  /// nodes stay settled and where they are.
  SurfaceEditor(GuardedSurface& surface, const RemeshSizes& sizes,
                std::span<const std::uint8_t> isSettled = {}, bool keepsSettled = false);

  // ---- operations: each returns true if it was made ----

  /// Splits an edge at `part` of its length; the new node is the last one.
  bool split(NodeId a, NodeId b, double part = 0.5);
  /// Removes a cap whose longest edge is the feature edge between the nodes: the line then goes through the apex, which
  /// must be almost on it. Such a cap can be neither flipped nor split.
  bool absorb(NodeId a, NodeId b);
  /// Moves `a` onto its neighbour `b`.
  bool collapse(NodeId a, NodeId b, const CollapseRule& rule);
  /// Replaces the edge between two triangles by the other diagonal if this raises the smallest
  /// angle.
  bool flip(NodeId a, NodeId b);
  /// False if the angle opposite the edge is so small that only the triangle on its other side could justify a flip.
  [[nodiscard]] bool mayFlip(HalfEdgeId halfEdge) const;
  /// Moves a node to the position at which its triangles are best on average.
  bool smooth(NodeId node);
  /// Moves a node to a position at which its poorest triangle is better.
  bool improve(NodeId node);

  // ---- measures, in the metric of the size field ----

  [[nodiscard]] const SurfaceComplex& complex() const { return complex_; }
  /// Length of an edge in target lengths.
  [[nodiscard]] double lengthOf(NodeId a, NodeId b) const;
  /// Squared sine of the smallest angle of a triangle, which is at most 60 degrees.
  [[nodiscard]] double squaredSineOf(const NodeTriple& nodes) const;
  [[nodiscard]] double sizeOf(NodeId node) const { return size_[node.index()]; }

  // ---- time: each node stores when one of its triangles last changed ----

  static constexpr std::uint32_t kFirstTime = 1;
  std::uint32_t nextTime() { return ++time_; }
  [[nodiscard]] std::uint32_t lastChange(NodeId node) const { return changed_[node.index()]; }
  /// Returns true if the triangles of the node need no change, and have not changed.
  [[nodiscard]] bool isSettled(NodeId node) const { return lastChange(node) < kFirstTime; }

 private:
  using Corners = std::array<Vec3, 3>;

  [[nodiscard]] bool isKept(NodeId node) const { return keepsSettled_ && isSettled(node); }

  NodeId addNode(const Vec3& point, NodeKind kind, NodeId near, std::uint32_t region);
  void removeLastNode();
  void measureSize(NodeId node);
  void updateSize(NodeId node);
  [[nodiscard]] std::uint32_t regionAround(std::span<const HalfEdgeId> edge) const;
  void enterRegion(NodeId node, std::uint32_t region);
  [[nodiscard]] bool isFarMove() const;
  bool apply(bool coversSame = false);

  [[nodiscard]] Vec3 positionOf(NodeId node) const {
    return node == change_.moved ? change_.position : complex_.pointOf(node);
  }
  [[nodiscard]] Corners cornersOf(const NodeTriple& nodes) const {
    return {positionOf(nodes[0]), positionOf(nodes[1]), positionOf(nodes[2])};
  }
  /// Returns the corners in the space in which the target triangle is equilateral.
  [[nodiscard]] Corners inMetric(const NodeTriple& nodes, Corners corners) const;
  [[nodiscard]] double radiusRatioOf(const NodeTriple& nodes) const;
  [[nodiscard]] bool allowsShapes(const CollapseRule& rule) const;
  [[nodiscard]] double smallestRemoved() const;
  [[nodiscard]] double smallestAdded() const;
  [[nodiscard]] double poorestRemoved() const;
  /// Radius ratios of several triangles.
  struct Ratios {
    double poorest = 1.0;
    double mean = 0.0;
  };
  [[nodiscard]] Ratios ratiosAdded() const;

  /// Returns true if the line between two arcs and the segment a b are within the tolerance of each
  /// other.
  [[nodiscard]] bool follows(FeatureLineId line, double begin, double end, const Vec3& a,
                             const Vec3& b) const;
  struct StretchParts {
    Stretch before;
    Stretch after;
    NodeId to{};  ///< the end of `after`
  };
  [[nodiscard]] std::optional<StretchParts> partsOf(StretchId id, NodeId a, NodeId b,
                                                    const Vec3& position, double arc) const;
  void divideStretch(StretchId id, StretchParts parts, NodeId middle);
  void addLineEdges(const StretchParts& parts, NodeId middle);
  bool tryAbsorb(HalfEdgeId cap, HalfEdgeId other);
  bool trySplit(NodeId a, NodeId b, const Vec3& position, StretchId id, double arc);
  [[nodiscard]] Vec3 splitPosition(const Vec3& straight, TriangleId triangle) const;
  [[nodiscard]] bool keepsTopology(NodeId a, NodeId b);
  void beginMove(NodeId node);
  /// Ends a trial move: the measures use the node's own position again.
  bool endMove(bool wasMade);
  bool moveOnPatch(NodeId node, const Vec3& target, MovePurpose purpose);
  bool moveOnLine(NodeId node, double arc, MovePurpose purpose);
  [[nodiscard]] bool projectMove(NodeId node);
  [[nodiscard]] bool isBetter(const Ratios& before, MovePurpose purpose) const;
  [[nodiscard]] Vec3 centreOf(NodeId node) const;
  bool improveOnLine(NodeId node);
  bool improveOnPatch(NodeId node);

  GuardedSurface& surface_;
  const SurfaceComplex& complex_;
  const ReferenceSurface& reference_;
  const RemeshSizes& sizes_;
  bool isStretched_;
  std::vector<double> size_;                 ///< per node: target length
  std::vector<RemeshSizes::Hint> sizeHint_;  ///< per node
  std::vector<SymmetricTensor> view_;  ///< per node, if stretched: maps target edges to unit length
  std::vector<std::uint32_t> changed_;  ///< per node
  bool keepsSettled_;
  std::uint32_t time_ = kFirstTime;

  SurfaceChange change_;
  std::vector<NodeId> ringA_;
  std::vector<NodeId> ringB_;
  std::vector<HalfEdgeId> edge_;
};

}  // namespace tetrafront
