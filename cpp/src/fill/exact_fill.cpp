#include "fill/exact_fill.h"

#include <array>
#include <utility>

#include "fill/boundary_point_removal.h"
#include "fill/boundary_recovery.h"
#include "fill/interior_point_rounding.h"
#include "fill/outside_removal.h"
#include "fill/point_insertion.h"
#include "fill/sector_separation.h"

namespace tetrafront {
namespace {

/// Signs per unit of the budget.
constexpr std::uint64_t kSignsPerUnit = 20;
/// Visiting this many tetrahedra sequentially costs as much as computing one sign.
constexpr std::uint64_t kTouchedPerSign = 4;

/// Progress at the end of each stage, 0 to 1. Slow boundaries consist of needles; there most of the
/// time goes into the edges and into the points added on the boundary.
constexpr double kInsertEnd = 0.1;
constexpr double kBoundaryEnd = 0.5;
/// Share of the edges in the recovery of the boundary, and of the points on it in the removal of points.
constexpr double kEdgesShare = 0.8;
constexpr double kBoundaryPointsShare = 0.5;

constexpr std::array<BoundaryRecovery::EdgeOrder, 3> kEdgeOrders{
    BoundaryRecovery::EdgeOrder::kLongestFirst, BoundaryRecovery::EdgeOrder::kByNodes,
    BoundaryRecovery::EdgeOrder::kShortestFirst};

double share(std::size_t done, std::size_t all) {
  return all == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(all);
}

}  // namespace

ExactFill::ExactFill(FillTask task, unsigned order, std::uint64_t limit)
    : task_(std::move(task)), order_(order), limit_(limit) {}

std::uint64_t ExactFill::signs() const { return mesh_.points.work() + touched_ / kTouchedPerSign; }

std::uint64_t ExactFill::cost() const { return signs() / kSignsPerUnit; }

Task<> ExactFill::run(Work& work) {
  const bool isFilled = co_await fill(work);
  const State filled = result_.isPartial() ? State::kPartial : State::kDone;
  state_ = isFilled ? filled : State::kFailed;
}

Task<bool> ExactFill::fill(Work& work) {
  if (task_.triangles.empty()) co_return true;
  for (const Vec3& position : task_.positions) mesh_.points.add(position);
  work.beginPart(kInsertEnd);
  if (!co_await insertNodes(work)) co_return false;
  work.beginPart(kBoundaryEnd);
  if (!co_await recoverBoundary(work)) co_return false;
  work.beginPart(1.0);
  if (!co_await removePoints(work)) co_return false;
  result_ = collectResult(mesh_, task_.positions.size(), points_);
  co_return !result_.tetrahedra.empty();
}

/// Repeats a step until it has done its part. Returns false if it fails, or at the limit, which is looked at after every step, so
/// that the outcome does not depend on the length of the slices.
Task<bool> ExactFill::repeat(Work& work, const Step& step) {
  for (FillState state = step(); state != FillState::kDone; state = step()) {
    if (state == FillState::kFailed || cost() > limit_) co_return false;
    const std::uint64_t paid = std::exchange(paid_, cost());
    co_await work.spend(static_cast<std::size_t>(paid_ - paid));
  }
  co_return true;
}

Task<bool> ExactFill::insertNodes(Work& work) {
  PointInsertion insertion(mesh_, order_);
  std::size_t next = 0;
  const Step insert = [&] {
    if (next == insertion.count()) return FillState::kDone;
    work.setFraction(share(next, insertion.count()));
    return insertion.insert(next++) ? FillState::kRunning : FillState::kFailed;
  };
  const bool isGood = co_await repeat(work, insert);
  co_return isGood;
}

/// Recovers the boundary, drops what is outside, and separates what touches.
Task<bool> ExactFill::recoverBoundary(Work& work) {
  BoundaryRecovery recovery(mesh_, task_.triangles, kEdgeOrders.at(order_ % kEdgeOrders.size()));
  const Step recoverEdge = [&] {
    work.setFraction(recovery.edgesFraction());
    const std::uint64_t visited = recovery.visitedTetrahedra();
    const FillState state = recovery.recoverNextEdge();
    touched_ += recovery.visitedTetrahedra() - visited;
    return state;
  };
  work.beginPart(kEdgesShare);
  if (!co_await repeat(work, recoverEdge)) co_return false;
  std::size_t next = 0;
  const Step recoverTriangle = [&] {
    if (next == recovery.triangleCount()) return FillState::kDone;
    work.setFraction(share(next, recovery.triangleCount()));
    return recovery.recoverTriangle(FacetId(next++)) ? FillState::kRunning : FillState::kFailed;
  };
  work.beginPart(1.0);
  if (!co_await repeat(work, recoverTriangle)) co_return false;

  OutsideRemoval outside(mesh_, task_.triangles);
  const Step dropOutside = [&] {
    ++touched_;
    return outside.step();
  };
  if (!co_await repeat(work, dropOutside)) co_return false;
  SectorSeparation separation(mesh_, recovery.boundaryPoints());
  touched_ += mesh_.slotCount();
  const Step separate = [&] {
    if (separation.isDone()) return FillState::kDone;
    touched_ += separation.step();
    return FillState::kRunning;
  };
  if (!co_await repeat(work, separate)) co_return false;
  points_.assign(separation.points().begin(), separation.points().end());
  co_return true;
}

/// Replaces the points on the boundary by interior ones, and removes or rounds these. Points that cannot be rounded only make the
/// result partial.
Task<bool> ExactFill::removePoints(Work& work) {
  BoundaryPointRemoval removal(mesh_, task_.triangles, points_);
  const Step remove = [&] {
    work.setFraction(removal.fraction());
    return removal.step();
  };
  work.beginPart(kBoundaryPointsShare);
  if (!co_await repeat(work, remove)) co_return false;
  InteriorPointRounding rounding(mesh_, removal.interiorPoints());
  // After the last step, the limit does not count.
  if (cost() > limit_) co_return false;
  const Step round = [&] {
    work.setFraction(rounding.fraction());
    return rounding.step() == FillState::kRunning ? FillState::kRunning : FillState::kDone;
  };
  work.beginPart(1.0);
  if (!co_await repeat(work, round)) co_return false;
  points_ = rounding.points();
  co_return true;
}

}  // namespace tetrafront
