#pragma once

/// @file Frees the boundary of the points that had to be put on it: each is replaced by a point
/// inside, an existing one that sees all that is around it, or a new one a little way inwardDirection. The
/// pieces of given triangles around it are triangulated anew without it, so that in the end the
/// boundary is the given one. Existence of interior points that do: Du & Wang 2004; George, Borouchaki
/// & Saltel 2003.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fill/boundary_fans.h"
#include "fill/cone.h"
#include "fill/fill_mesh.h"
#include "fill/sliver_removal.h"

namespace tetrafront {

class BoundaryPointRemoval {
 public:
  /// `triangles` gives the planes of facets; it must outlive this. The mesh must hold the inside only, and
  /// each of `points`, those to be replaced, one piece of it.
  BoundaryPointRemoval(FillMesh& mesh, const std::vector<NodeTriple>& triangles,
                       std::span<const NodeId> points);

  /// Deals with one point.
  FillState step();

  /// How far it is, 0 to 1, estimated by the points left on the boundary.
  [[nodiscard]] double fraction() const;

  /// New points inside, in the order they were made; some may have been removed again.
  [[nodiscard]] std::span<const NodeId> interiorPoints() const { return interiorPoints_; }

 private:
  void wait(NodeId node);
  void postpone(NodeId node);
  NodeId nextToLift();
  void queueTouched(std::span<const TetId> changed);
  [[nodiscard]] std::vector<NodeId> candidates(NodeId node) const;
  bool replaceByExisting(NodeId node);
  bool replaceByExistingWithGrowth(NodeId node);
  bool replaceByNew(NodeId node);
  bool replaceByDouble(NodeId node);
  bool replaceByExact(NodeId node);
  [[nodiscard]] double reach(NodeId node) const;
  bool tryPosition(NodeId node, const Vec3& position, std::size_t growth);
  bool tryPosition(NodeId node, const DyadicVec3& position);
  bool tryLast(NodeId node, std::size_t growth);

  FillMesh& mesh_;
  ConstraintEdges none_;
  Cone cone_;
  SliverRemoval slivers_;
  BoundaryFans fans_;  ///< around the point that is dealt with
  /// What is to be done with a node next.
  enum class Queue : std::uint8_t { kNone, kWaiting, kPostponed };
  std::vector<Queue> queueOf_;     ///< per node
  std::vector<NodeId> waiting_;    ///< to be tried, from nextWaiting_ on
  std::vector<NodeId> postponed_;  ///< from nextPostponed_ on; some may have been tried again since
  std::size_t initialCount_;       ///< of the points on the boundary at first
  std::size_t remaining_;          ///< of them
  std::size_t nextWaiting_ = 0;
  std::size_t nextPostponed_ = 0;
  std::vector<NodeId> interiorPoints_;
  std::vector<NodeId>
      sliverPoints_;  ///< points beside flat tetrahedra around the one that is lifted
  std::vector<TetId> star_;
};

}  // namespace tetrafront
