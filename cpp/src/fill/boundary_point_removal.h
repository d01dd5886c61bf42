#pragma once

/// @file Removes the points that had to be added on the boundary. Each is replaced by an interior
/// point: an existing one that sees all faces around it, or a new one a short way inwards. The
/// parts of the given triangles around it are triangulated again without it, so that in the end the
/// boundary is the given one. That such interior points exist is shown by Du & Wang (2004) and by
/// George, Borouchaki & Saltel (2003).

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
  /// `points` are the points to be removed. The mesh must hold interior tetrahedra only, connected
  /// over faces around each of these points (SectorSeparation). `triangles` gives the planes of the
  /// facets. It and the mesh must outlive this object.
  BoundaryPointRemoval(FillMesh& mesh, const std::vector<NodeTriple>& triangles,
                       std::span<const NodeId> points);

  /// Tries to replace one point. kFailed does not occur in a valid mesh.
  FillState step();

  /// Estimated progress, 0 to 1, from the number of points still on the boundary.
  [[nodiscard]] double fraction() const;

  /// New interior points in the order in which they were made; some may have been removed again.
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
  BoundaryFans fans_;  ///< boundary around the current point
  /// Which queue a node waits in.
  enum class Queue : std::uint8_t { kNone, kWaiting, kPostponed };
  std::vector<Queue> queueOf_;   ///< per node
  std::vector<NodeId> waiting_;  ///< nodes to be tried, from nextWaiting_ on
  /// nodes that failed, from nextPostponed_ on; outdated entries have another queueOf_
  std::vector<NodeId> postponed_;
  std::size_t initialCount_;  ///< number of points on the boundary at the start
  std::size_t remaining_;     ///< number of them that are still on the boundary
  std::size_t nextWaiting_ = 0;
  std::size_t nextPostponed_ = 0;
  std::vector<NodeId> interiorPoints_;
  std::vector<NodeId> sliverPoints_;  ///< points added to remove slivers around the current point
  std::vector<TetId> star_;
};

}  // namespace tetrafront
