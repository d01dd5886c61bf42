#pragma once

/// @file The exact fill: tetrahedra for any closed, embedded, consistently oriented set of triangles. New
/// points are in the interior only. All signs are exact, so the only step that can fail is the last one,
/// which rounds interior points to doubles. If it fails, the volume around these points is left open and
/// everything else is filled.
///
/// 1. Insert the nodes into a nearly Delaunay mesh (PointInsertion).
/// 2. Recover the edges, then the triangles, by swaps and by points on the boundary (BoundaryRecovery).
/// 3. Drop the exterior tetrahedra (OutsideRemoval).
/// 4. Replace the points on the boundary by interior ones (SectorSeparation, BoundaryPointRemoval).
/// 5. Remove interior points or round them to doubles (InteriorPointRounding); most are not needed.

#include <cstdint>
#include <functional>
#include <limits>

#include "base/task.h"
#include "fill/fill_mesh.h"
#include "fill/fill_result.h"

namespace tetrafront {

class ExactFill {
 public:
  /// Number of orders in which nodes can be inserted and edges recovered. If an interior point cannot be
  /// rounded to doubles after one order, it mostly can after another.
  static constexpr unsigned kOrders = 6;

  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  /// Fails after `limit` units of the budget of advance().
  explicit ExactFill(FillTask task, unsigned order = 0, std::uint64_t limit = kNoLimit);
  ExactFill(const ExactFill&) = delete;
  ExactFill& operator=(const ExactFill&) = delete;

  enum class State : std::uint8_t {
    kRunning,
    kDone,
    kPartial,  ///< the volume around interior points that doubles cannot hold is left open
    kFailed    ///< the triangles are not a closed boundary, or the limit is reached; no result
  };
  /// Does about `budget` x 2 microseconds of work. The outcome does not depend on the budget.
  State advance(std::uint32_t budget) { return job_.advance(budget) ? state_ : State::kRunning; }

  /// Work done so far, in units of the budget of advance().
  [[nodiscard]] std::uint64_t cost() const;

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const { return job_.fraction(); }

  /// Empty until the state is kDone or kPartial.
  [[nodiscard]] const FillResult& result() const { return result_; }

 private:
  using Step = std::function<FillState()>;

  Task<> run(Work& work);
  Task<bool> fill(Work& work);
  Task<bool> insertNodes(Work& work);
  Task<bool> recoverBoundary(Work& work);
  Task<bool> removePoints(Work& work);
  Task<bool> repeat(Work& work, const Step& step);
  [[nodiscard]] std::uint64_t signs() const;

  FillTask task_;
  unsigned order_;
  std::uint64_t limit_;
  FillMesh mesh_;
  FillResult result_;
  State state_ = State::kRunning;
  std::uint64_t touched_ = 0;   ///< tetrahedra visited without computing a sign
  std::uint64_t paid_ = 0;      ///< part of cost() that was subtracted from budgets
  std::vector<NodeId> points_;  ///< added on the boundary, later in the interior, which are left
  Job<> job_{[this](Work& work) { return run(work); }};  ///< the last: it uses the others
};

}  // namespace tetrafront
