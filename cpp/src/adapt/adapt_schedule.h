#pragma once

/// @file The order of an adaptation: passes that bring the lengths near 1, through metrics of falling least size; sweeps that lower
/// the badness and the number of elements; at last disturbances.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "adapt/adapt_operations.h"
#include "adapt/disturbance.h"
#include "adapt/element_number.h"
#include "adapt/local_improvement.h"
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
  Task<bool> thin(Work& work);
  Task<std::size_t> improveEdges(Work& work);
  Task<> improveElements(Work& work, double limit);

  AdaptMesh& mesh_;
  MetricBackground& background_;
  Badness& badness_;
  double goal_;  ///< the floor that is asked for
  std::uint32_t sweeps_;
  bool isNear_ = false;  ///< the mesh is adapted except in some places
  const bool& isStopped_;
  AdaptContext context_;
  LocalImprovement improvement_;
  ElementNumber number_;
  Disturbance disturbance_;
};

}  // namespace tetrafront
