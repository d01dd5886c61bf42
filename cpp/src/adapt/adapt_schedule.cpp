#include "adapt/adapt_schedule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "adapt/edge_list.h"
#include "adapt/poor_list.h"
#include "base/sort.h"

namespace tetrafront {
namespace {

// Passes: edges longer than the first are split, shorter than the second collapsed.
constexpr double kLongEdge = 1.41;
constexpr double kShortEdge = 0.68;

/// Passes at most, with a least size that is still too large and with the asked one.
constexpr int kEarlyPasses = 3;
constexpr int kLastPasses = 14;

/// The asked size is approached when fewer than this part of the edges are split or collapsed.
constexpr double kFewChanges = 0.02;

/// Elements below these qualities are swapped after the splits and after the collapses.
constexpr double kPoorAfterSplits = 0.3;
constexpr double kPoorAfterCollapses = 0.5;

/// A mesh with fewer edges out of bounds is not approached again: only what is poor changes, so that most nodes stay where their
/// metrics are given.
constexpr double kNearlyUnit = 0.1;

/// The same for the elements to add, relative to the number of edges: an edge of length l becomes about l^3 elements.
constexpr double kFewAdded = 0.5;

/// Work of a change, in units of an element.
constexpr std::size_t kUnitsPerChange = 8;

}  // namespace

AdaptSchedule::AdaptSchedule(AdaptMesh& mesh, const BoundaryGuide& guide,
                             MetricBackground& background, Badness& badness, std::uint32_t sweeps,
                             const bool& isStopped)
    : mesh_(mesh),
      background_(background),
      badness_(badness),
      goal_(badness.floor()),
      sweeps_(sweeps),
      isStopped_(isStopped),
      context_{mesh, guide, background, badness},
      improvement_(context_),
      number_(mesh, badness),
      disturbance_(mesh, badness, improvement_, isStopped) {}

Task<> AdaptSchedule::run(Work& work) {
  work.beginPart(0.01);
  isNear_ = co_await hasNearlyUnitEdges(work);
  work.beginPart(0.4);
  if (!isNear_) co_await approach(work);
  work.beginPart(1.0);
  co_await improve(work);
}

Task<> AdaptSchedule::measureAll(Work& work) {
  work.beginPart(0.5);
  co_await work.forEachId<NodeId>(mesh_.nodes.size(),
                                  [this](NodeId id) { context_.measure(mesh_.node(id)); });
  work.beginPart(1.0);
  co_await work.forEachId<TetId>(mesh_.elements.size(), [this](TetId id) {
    AdaptElement& element = mesh_.element(id);
    if (element.isAlive()) element.quality = mesh_.qualityOf(element.nodes);
  });
}

Task<bool> AdaptSchedule::hasNearlyUnitEdges(Work& work) const {
  const std::vector<AdaptEdge> edges = co_await listEdges(work, mesh_);
  double out = 0.0;
  double added = 0.0;
  for (const AdaptEdge& edge : edges) {
    if (badness_.ofEdge(edge.length) < kOutOfBounds) continue;
    out += 1.0;
    if (edge.length > 1.0) added += edge.length * edge.length * edge.length;
  }
  const auto count = static_cast<double>(edges.size());
  const bool isNear = out <= kNearlyUnit * count && added <= kFewAdded * count;
  co_return isNear;
}

/// Returns the index of the smallest of the descending sizes that the mesh can begin with: nearly all edges are short.
Task<std::size_t> AdaptSchedule::firstStage(Work& work, const std::vector<double>& sizes) {
  constexpr double kFarTooLong = 4.0;
  constexpr double kFewLong = 0.01;
  for (std::size_t stage = sizes.size() - 1; stage > 0; --stage) {
    background_.limitSizes(sizes[stage]);
    co_await measureAll(work);
    const std::vector<AdaptEdge> edges = co_await listEdges(work, mesh_);
    const auto isLong = [](const AdaptEdge& edge) { return edge.length > kFarTooLong; };
    const auto count = static_cast<double>(std::ranges::count_if(edges, isLong));
    if (count <= kFewLong * static_cast<double>(edges.size())) co_return stage;
  }
  co_return 0;
}

/// Elements that are coarse in the metric have such a poor quality there that changes would be refused, so the least size falls
/// step by step.
Task<> AdaptSchedule::approach(Work& work) {
  std::vector<double> sizes;
  for (double size = background_.maxSize(); size > 1.2 * background_.minSize(); size *= 0.5)
    sizes.push_back(size);
  sizes.push_back(background_.minSize());
  work.beginPart(0.05);
  const std::size_t first = co_await firstStage(work, sizes);
  for (std::size_t stage = first; stage < sizes.size(); ++stage) {
    const bool isLast = stage + 1 == sizes.size();
    work.beginPart(static_cast<double>(stage + 1) / static_cast<double>(sizes.size()));
    background_.limitSizes(isLast ? 0.0 : sizes[stage]);
    co_await measureAll(work);
    co_await adaptStage(work, isLast ? kLastPasses : kEarlyPasses);
  }
}

Task<> AdaptSchedule::adaptStage(Work& work, int passes) {
  for (int pass = 0; pass < passes && !isStopped_; ++pass) {
    std::size_t edgeCount = 0;
    double limit = kLongEdge;
    {
      const std::vector<AdaptEdge> edges = co_await listEdges(work, mesh_);
      edgeCount = edges.size();
      for (const AdaptEdge& edge : edges) limit = std::max(limit, 0.5 * edge.length);
    }
    std::size_t changes = co_await splitLong(work, limit);
    co_await swapPoor(work, kPoorAfterSplits);
    const std::size_t collapses = co_await collapseShort(work);
    changes += collapses;
    co_await swapPoor(work, kPoorAfterCollapses);
    co_await moveAll(work, MoveEffort::kTargets);
    if (limit < 1.5 && static_cast<double>(changes) < kFewChanges * static_cast<double>(edgeCount))
      break;
  }
}

Task<std::size_t> AdaptSchedule::splitLong(Work& work, double limit) {
  std::vector<AdaptEdge> edges = co_await listEdges(work, mesh_);
  std::erase_if(edges, [limit](const AdaptEdge& edge) { return edge.length < limit; });
  SlicedSort sort{std::span<AdaptEdge>(edges),
                  [](const AdaptEdge& a, const AdaptEdge& b) { return a.length > b.length; }};
  co_await work.finish(sort);
  std::size_t count = 0;
  for (const AdaptEdge& edge : edges) {
    if (isStopped_) break;
    const TetId element = mesh_.findEdge(edge.a, edge.b, edge.element);
    if (element.isNone()) continue;
    if (improvement_.operations().split(edge.a, edge.b, element, Acceptance::kLengths)) ++count;
    co_await work.spend(kUnitsPerChange);
  }
  co_return count;
}

Task<std::size_t> AdaptSchedule::collapseShort(Work& work) {
  std::vector<AdaptEdge> edges = co_await listEdges(work, mesh_);
  std::erase_if(edges, [](const AdaptEdge& edge) { return edge.length > kShortEdge; });
  SlicedSort sort{std::span<AdaptEdge>(edges),
                  [](const AdaptEdge& a, const AdaptEdge& b) { return a.length < b.length; }};
  co_await work.finish(sort);
  std::size_t count = 0;
  for (const AdaptEdge& edge : edges) {
    if (isStopped_) break;
    const TetId element = mesh_.findEdge(edge.a, edge.b, edge.element);
    if (element.isNone()) continue;
    if (improvement_.operations().collapse(edge.a, edge.b, element, Acceptance::kLengths)) ++count;
    co_await work.spend(kUnitsPerChange);
  }
  co_return count;
}

Task<std::size_t> AdaptSchedule::swapPoor(Work& work, double limit) {
  std::size_t count = 0;
  const std::vector<PoorElement> all = co_await listPoor(work, mesh_, limit);
  for (const PoorElement& poor : all) {
    if (isStopped_) break;
    const AdaptElement& element = mesh_.element(poor.element);
    if (!element.isAlive() || element.quality != poor.quality) continue;
    const NodeQuad nodes = element.nodes;
    bool isSwapped = false;
    for (const TetEdge& e : kTetEdges) {
      isSwapped = isSwapped ||
                  improvement_.operations().removeEdge(nodes[e.from], nodes[e.to], poor.element,
                                                       Acceptance::kLengths, improvement_.random());
    }
    for (std::size_t k = 0; k < 4; ++k)
      isSwapped =
          isSwapped || improvement_.operations().swapFace(poor.element, k, Acceptance::kLengths);
    count += isSwapped ? 1 : 0;
    co_await work.spend(kUnitsPerChange);
  }
  co_return count;
}

Task<> AdaptSchedule::moveAll(Work& work, MoveEffort effort) {
  for (const NodeId id : IdRange<NodeId>(mesh_.nodes.size())) {
    if (isStopped_) break;
    const AdaptNode& node = mesh_.node(id);
    if (node.element.isNone()) continue;
    if (effort != MoveEffort::kTargets && node.changed <= node.tried) continue;
    improvement_.move(id, effort);
    co_await work.spend(kUnitsPerChange);
  }
}

/// Sets the floor to the largest quality up to the goal that nearly all elements reach, but to no less than half of the goal, and
/// never lower than before. Where the shape of the boundary keeps many elements poor, a high floor would sacrifice edges, and the
/// poorest elements too, for the many that it cannot help.
void AdaptSchedule::raiseFloor() {
  constexpr double kFewBelow = 0.004;
  constexpr int kSteps = 10;
  std::array<std::size_t, kSteps> below{};
  for (const AdaptElement& element : mesh_.elements) {
    if (!element.isAlive() || element.quality >= goal_) continue;
    const double step = std::floor(2.0 * kSteps * element.quality / goal_ - kSteps);
    ++below[static_cast<std::size_t>(std::clamp(step, 0.0, kSteps - 1.0))];
  }
  const double few = kFewBelow * static_cast<double>(mesh_.elementCount());
  double floor = 0.5 * goal_;
  std::size_t count = 0;
  for (int i = 0; i < kSteps; ++i) {
    count += below[static_cast<std::size_t>(i)];
    if (static_cast<double>(count) > few) break;
    floor = goal_ * (0.5 + 0.5 * (i + 1) / kSteps);
  }
  badness_.setFloor(std::max(floor, badness_.floor()));
}

Task<> AdaptSchedule::improve(Work& work) {
  constexpr double kAboveFloor = 0.1;
  constexpr std::uint32_t kStrictSweeps = 2;
  constexpr std::uint32_t kSweepsInPlace = 2;
  // The sweeps end when the number of edges out of bounds and of poor elements hardly falls any more.
  constexpr std::uint32_t kMinSweeps = 4;
  constexpr double kSlowFall = 0.9;
  std::size_t before = 0;
  badness_.setFloor(0.5 * goal_);
  if (isNear_) {
    badness_.weakenPull();
    for (AdaptNode& node : mesh_.nodes) node.tried = node.changed;
  }
  for (std::uint32_t sweep = 0; sweep < sweeps_ && !isStopped_; ++sweep) {
    const double last = badness_.floor();
    raiseFloor();
    const bool isRaised = badness_.floor() > last;
    // What was tried in vain may succeed at a higher floor.
    if (isRaised) {
      for (AdaptElement& element : mesh_.elements) element.tried = 0;
    }
    improvement_.setStaysInPlace(isNear_ && sweep < kSweepsInPlace && sweep + 1 < sweeps_);
    work.beginPart(static_cast<double>(sweep + 1) / sweeps_);
    const bool isThinned = co_await thin(work);
    std::size_t count = co_await improveEdges(work);
    const std::vector<PoorElement> poor = co_await listPoor(work, mesh_, badness_.floor());
    count += poor.size();
    if (!isRaised && !isThinned && sweep >= kMinSweeps &&
        static_cast<double>(count) > kSlowFall * static_cast<double>(before))
      break;
    before = count;
    co_await improveElements(
        work, badness_.floor() + (isNear_ || sweep < kStrictSweeps ? 0.0 : kAboveFloor));
    if (!improvement_.staysInPlace()) co_await moveAll(work, MoveEffort::kSearch);
  }
  number_.clearPrice();
  co_await disturbance_.run(work);
}

/// Collapses short edges while there are more elements than the metric asks for; returns whether their number has fallen clearly.
Task<bool> AdaptSchedule::thin(Work& work) {
  constexpr double kThinned = 0.95;    // metric length below which edges are collapsed
  constexpr double kClearFall = 0.01;  // share of the elements
  // Elements / those asked for: below, a mesh that is nearly adapted keeps its nodes.
  constexpr double kFarMore = 1.3;
  std::vector<AdaptEdge> edges = co_await listEdges(work, mesh_);
  const auto isOut = [this](const AdaptEdge& edge) {
    return badness_.ofEdge(edge.length) >= kOutOfBounds;
  };
  const auto out = static_cast<double>(std::ranges::count_if(edges, isOut));
  co_await number_.measure(work);
  if (isNear_ && number_.excess() < kFarMore) {
    number_.clearPrice();
    co_return false;
  }
  number_.setPrice(out / static_cast<double>(edges.size()));
  std::erase_if(edges, [](const AdaptEdge& edge) { return edge.length > kThinned; });
  SlicedSort sort{std::span<AdaptEdge>(edges),
                  [](const AdaptEdge& a, const AdaptEdge& b) { return a.length < b.length; }};
  co_await work.finish(sort);
  const auto before = static_cast<double>(mesh_.elementCount());
  for (const AdaptEdge& edge : edges) {
    if (isStopped_ || !number_.isExceeded()) break;
    const TetId element = mesh_.findEdge(edge.a, edge.b, edge.element);
    if (element.isNone()) continue;
    improvement_.operations().collapse(edge.a, edge.b, element, Acceptance::kBadness);
    co_await work.spend(kUnitsPerChange);
  }
  co_return static_cast<double>(mesh_.elementCount()) < (1.0 - kClearFall) * before;
}

/// Returns the number of edges that were out of bounds.
Task<std::size_t> AdaptSchedule::improveEdges(Work& work) {
  std::vector<AdaptEdge> edges = co_await listEdges(work, mesh_);
  std::erase_if(
      edges, [this](const AdaptEdge& edge) { return badness_.ofEdge(edge.length) < kOutOfBounds; });
  const auto ratio = [](const AdaptEdge& edge) { return std::max(edge.length, 1.0 / edge.length); };
  SlicedSort sort{std::span<AdaptEdge>(edges),
                  [&](const AdaptEdge& a, const AdaptEdge& b) { return ratio(a) > ratio(b); }};
  co_await work.finish(sort);
  for (const AdaptEdge& edge : edges) {
    if (isStopped_) break;
    improvement_.improveEdge(edge);
    co_await work.spend(kUnitsPerChange);
  }
  co_return edges.size();
}

Task<> AdaptSchedule::improveElements(Work& work, double limit) {
  const std::vector<PoorElement> all = co_await listPoor(work, mesh_, limit);
  for (const PoorElement& poor : all) {
    if (isStopped_) break;
    const AdaptElement& element = mesh_.element(poor.element);
    if (!element.isAlive() || element.quality > limit || !improvement_.isWorthTrying(element))
      continue;
    improvement_.improveElement(poor.element);
    co_await work.spend(4 * kUnitsPerChange);
  }
}

}  // namespace tetrafront
