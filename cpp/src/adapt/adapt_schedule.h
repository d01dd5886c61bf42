#pragma once

/// @file The order of an adaptation: passes that bring the lengths near 1, through metrics of falling least size, and then
/// sweeps that lower the badness.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "adapt/adapt_operations.h"
#include "adapt/edge_list.h"
#include "adapt/node_mover.h"
#include "base/task.h"

namespace tetrafront {

class AdaptSchedule {
 public:
  /// All must outlive this. `sweeps`: number of sweeps at most. When `isStopped` becomes true, the work ends soon.
  AdaptSchedule(AdaptMesh& mesh, const BoundaryGuide& guide, MetricBackground& background,
                Badness& badness, std::uint32_t sweeps, const bool& isStopped);

  /// Computes the metrics of all nodes and the qualities of all elements.
  Task<> measureAll(Work& work);
  Task<> run(Work& work);

 private:
  /// Elements from the poorest on.
  struct Poor {
    double quality;
    TetId element;
    std::uint32_t unused = 0;
  };

  /// Metric lengths of an edge before and after a change; 0 if it is not there.
  struct Change {
    double before = 0.0;
    double after = 0.0;
  };

  Task<bool> hasNearlyUnitEdges(Work& work) const;
  Task<> approach(Work& work);
  Task<> improve(Work& work);
  Task<std::size_t> firstStage(Work& work, const std::vector<double>& sizes);
  Task<> adaptStage(Work& work, int passes);
  Task<std::size_t> splitLong(Work& work, double limit);
  Task<std::size_t> collapseShort(Work& work);
  Task<std::size_t> swapPoor(Work& work, double limit);
  Task<> moveAll(Work& work, MoveEffort effort);
  void raiseFloor();
  Task<std::size_t> improveEdges(Work& work);
  Task<> improveElements(Work& work, double limit);
  bool improveEdge(const AdaptEdge& edge);
  bool improveElement(TetId id);
  Task<> disturbPoor(Work& work);
  bool disturb(std::size_t kind, NodeId a, NodeId b, TetId id);
  void settle(std::uint32_t since);
  void settleInSteps(std::uint32_t since);
  bool disturbAndSettle(std::size_t kind, const TetEdge& edge, TetId id, AdaptMesh::State& state);
  [[nodiscard]] double gainSince(const AdaptMesh::State& before);
  [[nodiscard]] bool isWorthTrying(const AdaptElement& element) const;
  Task<std::vector<Poor>> poorElements(Work& work, double limit) const;

  AdaptMesh& mesh_;
  MetricBackground& background_;
  Badness& badness_;
  double goal_;  ///< the floor that is asked for
  std::uint32_t sweeps_;
  bool isNear_ = false;  ///< the mesh is adapted except in some places
  /// Neither moves a node nor adds one: the metrics of the nodes stay those that are given.
  bool staysInPlace_ = false;
  const bool& isStopped_;
  AdaptContext context_;
  AdaptOperations operations_;
  NodeMover mover_;
  AdaptRandom random_;
  EdgeMap<Change> changes_;
};

}  // namespace tetrafront
