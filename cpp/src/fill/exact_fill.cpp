#include "fill/exact_fill.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tetrafront {
namespace {

/// Signs per unit of the budget.
constexpr std::uint64_t kSignsPerUnit = 20;
/// Visiting this many tetrahedra sequentially costs as much as computing one sign.
constexpr std::uint64_t kTouchedPerSign = 4;

/// Progress at the end of each stage, 0 to 1. Slow boundaries consist of needles; there most of the
/// time goes into the edges and into the points added on the boundary.
constexpr double kInsertEnd = 0.1;
constexpr double kEdgesEnd = 0.4;
constexpr double kTrianglesEnd = 0.5;
constexpr double kBoundaryPointsEnd = 0.75;

double between(double from, double to, double part) { return from + (to - from) * part; }

double share(std::size_t done, std::size_t all) {
  return all == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(all);
}

constexpr std::array<BoundaryRecovery::EdgeOrder, 3> kEdgeOrders{
    BoundaryRecovery::EdgeOrder::kLongestFirst, BoundaryRecovery::EdgeOrder::kByNodes,
    BoundaryRecovery::EdgeOrder::kShortestFirst};

}  // namespace

ExactFill::ExactFill(FillTask task, unsigned order, std::uint64_t limit)
    : task_(std::move(task)), order_(order), limit_(limit) {}

ExactFill::State ExactFill::advance(std::uint32_t budget) {
  const std::uint64_t end = signs() + kSignsPerUnit * std::max(budget, 1U);
  while (stage_ != Stage::kDone && stage_ != Stage::kFailed && signs() < end) {
    step();
    // Check the limit after every step, so that the outcome does not depend on the slice length.
    if (stage_ != Stage::kDone && cost() > limit_) stage_ = Stage::kFailed;
  }
  if (stage_ == Stage::kFailed) return State::kFailed;
  if (stage_ != Stage::kDone) return State::kRunning;
  return result_.isPartial() ? State::kPartial : State::kDone;
}

std::uint64_t ExactFill::signs() const { return mesh_.points.work() + touched_ / kTouchedPerSign; }

std::uint64_t ExactFill::cost() const { return signs() / kSignsPerUnit; }

double ExactFill::fraction() const {
  switch (stage_) {
    case Stage::kBegin:
      return 0.0;
    case Stage::kInsert:
      return between(0.0, kInsertEnd, share(next_, insertion_->count()));
    case Stage::kEdges:
      return between(kInsertEnd, kEdgesEnd, recovery_->edgesFraction());
    case Stage::kTriangles:
      return between(kEdgesEnd, kTrianglesEnd, share(next_, recovery_->triangleCount()));
    case Stage::kDropOutside:
    case Stage::kSeparate:
      return kTrianglesEnd;
    case Stage::kRemoveBoundaryPoints:
      return between(kTrianglesEnd, kBoundaryPointsEnd, removal_->fraction());
    case Stage::kRoundInteriorPoints:
      return between(kBoundaryPointsEnd, 1.0, rounding_->fraction());
    case Stage::kDone:
    case Stage::kFailed:
      break;
  }
  return 1.0;
}

void ExactFill::step() {
  switch (stage_) {
    case Stage::kBegin:
      return begin();
    case Stage::kInsert:
      if (next_ == insertion_->count()) return beginRecovery();
      return failUnless(insertion_->insert(next_++));
    case Stage::kEdges:
      return recoverEdges();
    case Stage::kTriangles:
      if (next_ == recovery_->triangleCount()) return beginDropping();
      return failUnless(recovery_->recoverTriangle(FacetId(next_++)));
    case Stage::kDropOutside:
      return dropOutside();
    case Stage::kSeparate:
      return separate();
    case Stage::kRemoveBoundaryPoints:
      return removeBoundaryPoints();
    case Stage::kRoundInteriorPoints:
      return roundInteriorPoints();
    case Stage::kDone:
    case Stage::kFailed:
      return;
  }
}

void ExactFill::beginStage(Stage stage) {
  stage_ = stage;
  next_ = 0;
}

void ExactFill::failUnless(bool isGood) {
  if (!isGood) stage_ = Stage::kFailed;
}

void ExactFill::begin() {
  if (task_.triangles.empty()) return beginStage(Stage::kDone);
  for (const Vec3& position : task_.positions) mesh_.points.add(position);
  insertion_.emplace(mesh_, order_);
  beginStage(Stage::kInsert);
}

void ExactFill::beginRecovery() {
  insertion_.reset();
  recovery_.emplace(mesh_, task_.triangles, kEdgeOrders.at(order_ % kEdgeOrders.size()));
  beginStage(Stage::kEdges);
}

void ExactFill::recoverEdges() {
  const std::uint64_t visited = recovery_->visitedTetrahedra();
  const FillState state = recovery_->recoverNextEdge();
  touched_ += recovery_->visitedTetrahedra() - visited;
  if (state == FillState::kDone) return beginStage(Stage::kTriangles);
  failUnless(state == FillState::kRunning);
}

void ExactFill::beginDropping() {
  outside_.emplace(mesh_, task_.triangles);
  beginStage(Stage::kDropOutside);
}

void ExactFill::dropOutside() {
  ++touched_;
  const FillState state = outside_->step();
  if (state == FillState::kRunning) return;
  if (state == FillState::kFailed) return failUnless(false);
  outside_.reset();
  separation_.emplace(mesh_, recovery_->boundaryPoints());
  recovery_.reset();
  touched_ += mesh_.slotCount();
  beginStage(Stage::kSeparate);
}

void ExactFill::separate() {
  if (!separation_->isDone()) {
    touched_ += separation_->step();
    return;
  }
  removal_.emplace(mesh_, task_.triangles, separation_->points());
  separation_.reset();
  beginStage(Stage::kRemoveBoundaryPoints);
}

void ExactFill::removeBoundaryPoints() {
  const FillState state = removal_->step();
  if (state == FillState::kRunning) return;
  if (state == FillState::kFailed) return failUnless(false);
  rounding_.emplace(mesh_, removal_->interiorPoints());
  removal_.reset();
  beginStage(Stage::kRoundInteriorPoints);
}

/// Points that cannot be rounded only make the result partial.
void ExactFill::roundInteriorPoints() {
  if (rounding_->step() == FillState::kRunning) return;
  result_ = collectResult(mesh_, task_.positions.size(), rounding_->points());
  if (result_.tetrahedra.empty()) return failUnless(false);
  beginStage(Stage::kDone);
}

}  // namespace tetrafront
