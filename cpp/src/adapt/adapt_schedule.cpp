#include "adapt/adapt_schedule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

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

/// Edges of this cost or more are out of bounds.
constexpr double kOutOfBounds = 0.5;

/// A mesh with fewer edges out of bounds is not approached again: only what is poor changes, so that most nodes stay where their
/// metrics are given.
constexpr double kNearlyUnit = 0.1;

/// The same for the elements to add, relative to the number of edges: an edge of length l becomes about l^3 elements.
constexpr double kFewAdded = 0.5;

/// Work of a change, in units of an element.
constexpr std::size_t kUnitsPerChange = 8;

/// Elements that are only read, per unit.
constexpr std::size_t kVisitsPerUnit = 8;

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
      operations_(context_),
      mover_(context_) {}

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
    if (operations_.split(edge.a, edge.b, element, Acceptance::kLengths)) ++count;
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
    if (operations_.collapse(edge.a, edge.b, element, Acceptance::kLengths)) ++count;
    co_await work.spend(kUnitsPerChange);
  }
  co_return count;
}

Task<std::vector<AdaptSchedule::Poor>> AdaptSchedule::poorElements(Work& work, double limit) const {
  std::vector<Poor> poor;
  co_await work.forEachId<TetId>(
      mesh_.elements.size(),
      [&](TetId id) {
        const AdaptElement& element = mesh_.element(id);
        if (element.isAlive() && element.quality < limit) poor.push_back({element.quality, id});
      },
      kVisitsPerUnit);
  SlicedSort sort{std::span<Poor>(poor),
                  [](const Poor& a, const Poor& b) { return a.quality < b.quality; }};
  co_await work.finish(sort);
  co_return poor;
}

Task<std::size_t> AdaptSchedule::swapPoor(Work& work, double limit) {
  std::size_t count = 0;
  const std::vector<Poor> all = co_await poorElements(work, limit);
  for (const Poor& poor : all) {
    if (isStopped_) break;
    const AdaptElement& element = mesh_.element(poor.element);
    if (!element.isAlive() || element.quality != poor.quality) continue;
    const NodeQuad nodes = element.nodes;
    bool isSwapped = false;
    for (const TetEdge& e : kTetEdges) {
      isSwapped = isSwapped || operations_.removeEdge(nodes[e.from], nodes[e.to], poor.element,
                                                      Acceptance::kLengths, random_);
    }
    for (std::size_t k = 0; k < 4; ++k)
      isSwapped = isSwapped || operations_.swapFace(poor.element, k, Acceptance::kLengths);
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
    mover_.move(id, effort, random_);
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
    for (AdaptNode& node : mesh_.nodes) node.tried = node.changed;
  }
  for (std::uint32_t sweep = 0; sweep < sweeps_ && !isStopped_; ++sweep) {
    const double last = badness_.floor();
    raiseFloor();
    const bool isRaised = badness_.floor() > last;
    // What was tried in vain may succeed at other costs.
    if (isRaised) {
      for (AdaptElement& element : mesh_.elements) element.tried = 0;
    }
    staysInPlace_ = isNear_ && sweep < kSweepsInPlace && sweep + 1 < sweeps_;
    work.beginPart(static_cast<double>(sweep + 1) / sweeps_);
    std::size_t count = co_await improveEdges(work);
    const std::vector<Poor> poor = co_await poorElements(work, badness_.floor());
    count += poor.size();
    if (!isRaised && sweep >= kMinSweeps &&
        static_cast<double>(count) > kSlowFall * static_cast<double>(before))
      break;
    before = count;
    co_await improveElements(
        work, badness_.floor() + (isNear_ || sweep < kStrictSweeps ? 0.0 : kAboveFloor));
    if (!staysInPlace_) co_await moveAll(work, MoveEffort::kSearch);
  }
  co_await disturbPoor(work);
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
    improveEdge(edge);
    co_await work.spend(kUnitsPerChange);
  }
  co_return edges.size();
}

bool AdaptSchedule::improveEdge(const AdaptEdge& edge) {
  const TetId element = mesh_.findEdge(edge.a, edge.b, edge.element);
  if (element.isNone()) return false;
  const double length = mesh_.lengthOf(edge.a, edge.b);
  if (badness_.ofEdge(length) < kOutOfBounds) return false;
  if (operations_.removeEdge(edge.a, edge.b, element, Acceptance::kBadness, random_)) return true;
  if (staysInPlace_ && length > 1.0) return false;
  const bool isDivided = length > 1.0
                             ? operations_.split(edge.a, edge.b, element, Acceptance::kBadness)
                             : operations_.collapse(edge.a, edge.b, element, Acceptance::kBadness);
  if (isDivided || staysInPlace_) return isDivided;
  mover_.move(edge.a, MoveEffort::kLong, random_);
  mover_.move(edge.b, MoveEffort::kLong, random_);
  return false;
}

/// Returns whether anything around the element changed since it was last tried.
bool AdaptSchedule::isWorthTrying(const AdaptElement& element) const {
  return std::ranges::any_of(element.nodes,
                             [&](NodeId node) { return mesh_.node(node).changed > element.tried; });
}

Task<> AdaptSchedule::improveElements(Work& work, double limit) {
  const std::vector<Poor> all = co_await poorElements(work, limit);
  for (const Poor& poor : all) {
    if (isStopped_) break;
    const AdaptElement& element = mesh_.element(poor.element);
    if (!element.isAlive() || element.quality > limit || !isWorthTrying(element)) continue;
    improveElement(poor.element);
    co_await work.spend(4 * kUnitsPerChange);
  }
}

bool AdaptSchedule::improveElement(TetId id) {
  const NodeQuad nodes = mesh_.element(id).nodes;
  constexpr Acceptance kFalls = Acceptance::kBadness;
  for (const TetEdge& e : kTetEdges) {
    if (operations_.removeEdge(nodes[e.from], nodes[e.to], id, kFalls, random_)) return true;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (operations_.swapFace(id, k, kFalls)) return true;
  }
  if (operations_.peel(id)) return true;
  for (const TetEdge& e : kTetEdges) {
    if (operations_.collapse(nodes[e.from], nodes[e.to], id, kFalls)) return true;
    if (!staysInPlace_ && operations_.split(nodes[e.from], nodes[e.to], id, kFalls)) return true;
  }
  if (staysInPlace_) return false;
  if (mesh_.element(id).quality < badness_.floor() && operations_.insert(id)) return true;
  bool isMoved = false;
  for (const NodeId node : nodes)
    isMoved = mover_.move(node, MoveEffort::kLong, random_) || isMoved;
  if (!isMoved) mesh_.element(id).tried = mesh_.now;
  return isMoved;
}

/// Changes the mesh at the edge of an element, whatever it costs: splits (0), collapses (1) or removes it (2).
bool AdaptSchedule::disturb(std::size_t kind, NodeId a, NodeId b, TetId id) {
  if (kind == 0) return operations_.split(a, b, id, Acceptance::kAny);
  if (kind == 1) return operations_.collapse(a, b, id, Acceptance::kAny);
  return operations_.removeEdge(a, b, id, Acceptance::kAny, random_);
}

/// Improves what has changed since a time, and what is around it.
void AdaptSchedule::settle(std::uint32_t since) {
  constexpr int kRounds = 4;
  constexpr double kAboveFloor = 0.1;
  const auto isNew = [&](NodeId node) { return mesh_.node(node).changed > since; };
  for (int round = 0; round < kRounds; ++round) {
    bool isChanged = false;
    for (const TetId id : IdRange<TetId>(mesh_.elements.size())) {
      const AdaptElement element = mesh_.element(id);
      if (!element.isAlive() || std::ranges::none_of(element.nodes, isNew)) continue;
      for (const TetEdge& e : kTetEdges) {
        const NodeId a = element.nodes[e.from];
        const NodeId b = element.nodes[e.to];
        if (!isNew(a) && !isNew(b)) continue;
        isChanged = improveEdge({mesh_.lengthOf(a, b), a, b, id}) || isChanged;
        if (!mesh_.element(id).isAlive()) break;
      }
      const AdaptElement& at = mesh_.element(id);
      if (at.isAlive() && at.quality < badness_.floor() + kAboveFloor && isWorthTrying(at))
        isChanged = improveElement(id) || isChanged;
    }
    for (const NodeId id : IdRange<NodeId>(mesh_.nodes.size())) {
      if (!mesh_.node(id).element.isNone() && isNew(id))
        mover_.move(id, MoveEffort::kSearch, random_);
    }
    if (!isChanged) break;
  }
}

/// Returns by how much the badness has fallen since a state.
double AdaptSchedule::gainSince(const AdaptMesh::State& before) {
  changes_.clear();
  double gain = 0.0;
  for (std::size_t i = 0; i < mesh_.elements.size(); ++i) {
    const AdaptElement& now = mesh_.elements[i];
    const AdaptElement* old = i < before.elements.size() ? &before.elements[i] : nullptr;
    if (old != nullptr && old->nodes == now.nodes && old->quality == now.quality) continue;
    if (old != nullptr && old->isAlive()) {
      gain += badness_.ofElement(old->quality);
      for (const TetEdge& e : kTetEdges) {
        const NodeId a = old->nodes[e.from];
        const NodeId b = old->nodes[e.to];
        changes_(a, b).before =
            metricLengthBetween(before.nodes[a.index()], before.nodes[b.index()]);
      }
    }
    if (!now.isAlive()) continue;
    gain -= badness_.ofElement(now.quality);
    for (const TetEdge& e : kTetEdges)
      changes_(now.nodes[e.from], now.nodes[e.to]).after =
          mesh_.lengthOf(now.nodes[e.from], now.nodes[e.to]);
  }
  for (const auto& [low, high, length] : changes_.entries()) {
    if (length.before > 0.0) gain += badness_.ofEdge(length.before);
    if (length.after > 0.0) gain -= badness_.ofEdge(length.after);
  }
  return gain;
}

/// Improves what a disturbance has changed: lengths first, while elements may be poor.
void AdaptSchedule::settleInSteps(std::uint32_t since) {
  const double floor = badness_.floor();
  badness_.setFloor(0.5 * floor);
  settle(since);
  badness_.setFloor(floor);
  settle(since);
}

/// Disturbs the mesh at an edge of an element and improves what is around it. Keeps the change and saves the state if the badness
/// has fallen; restores the state otherwise. Returns whether the mesh has changed.
bool AdaptSchedule::disturbAndSettle(std::size_t kind, const TetEdge& edge, TetId id,
                                     AdaptMesh::State& state) {
  constexpr double kLeastFall = 0.1;
  const NodeQuad nodes = mesh_.element(id).nodes;
  const std::uint32_t since = mesh_.now;
  if (!disturb(kind, nodes[edge.from], nodes[edge.to], id)) return false;
  settleInSteps(since);
  const bool isBetter = gainSince(state) > kLeastFall;
  if (isBetter) {
    mesh_.save(state);
  } else {
    mesh_.restore(state);
  }
  return isBetter;
}

/// Where no single change improves one of the last poor elements, tries changes that make it worse at first.
Task<> AdaptSchedule::disturbPoor(Work& work) {
  constexpr std::size_t kKinds = 3;  // of disturbances
  constexpr double kFarBelow = 0.9;  // quality / floor
  constexpr std::size_t kFew = 100;  // elements; more of them have a common cause
  constexpr int kRounds = 40;
  // Each try copies and looks at all elements.
  constexpr std::size_t kTries = 40;
  constexpr std::size_t kCopied = 10'000'000;
  AdaptMesh::State state;
  std::size_t triesLeft =
      std::min(kTries, kCopied / std::max<std::size_t>(1, mesh_.elements.size()));
  std::vector<Poor> failed;
  bool isChanged = true;
  for (int round = 0; round < kRounds && isChanged; ++round) {
    isChanged = false;
    const std::vector<Poor> all = co_await poorElements(work, kFarBelow * badness_.floor());
    if (all.empty() || all.size() > kFew) break;
    if (round == 0) mesh_.save(state);
    for (const Poor& poor : all) {
      const AdaptElement& element = mesh_.element(poor.element);
      const bool isSame = element.isAlive() && element.quality == poor.quality;
      const auto isIt = [&](const Poor& other) {
        return other.element == poor.element && other.quality == poor.quality;
      };
      if (!isSame || std::ranges::any_of(failed, isIt)) continue;
      bool isBetter = false;
      for (std::size_t i = 0; i < kKinds * kTetEdges.size() && !isBetter; ++i) {
        if (isStopped_ || triesLeft-- == 0) co_return;
        isBetter = disturbAndSettle(i / kTetEdges.size(), kTetEdges[i % kTetEdges.size()],
                                    poor.element, state);
        co_await work.spend(mesh_.elements.size());
      }
      isChanged = isChanged || isBetter;
      if (!isBetter) failed.push_back(poor);
    }
  }
}

}  // namespace tetrafront
