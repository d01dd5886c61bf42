#include "adapt/disturbance.h"

#include <algorithm>

namespace tetrafront {
namespace {

/// Least fall of the badness for which a disturbance is kept.
constexpr double kMinFall = 0.1;

/// Elements below this part of the floor are tried.
constexpr double kFarBelow = 0.9;

/// If there are more such elements, they have a common cause, and none is tried.
constexpr std::size_t kMaxPoor = 100;

/// Lists of poor elements that are worked off at most.
constexpr int kMaxRounds = 40;

/// Each try copies and looks at all elements: tries, and elements that all of them copy, at most.
constexpr std::size_t kMaxTries = 40;
constexpr std::size_t kMaxCopied = 10'000'000;

}  // namespace

bool Disturbance::disturb(Kind kind, NodeId a, NodeId b, TetId id) {
  AdaptOperations& operations = improvement_.operations();
  switch (kind) {
    case Kind::kSplit:
      return operations.split(a, b, id, Acceptance::kAny);
    case Kind::kCollapse:
      return operations.collapse(a, b, id, Acceptance::kAny);
    case Kind::kRemove:
      break;
  }
  return operations.removeEdge(a, b, id, Acceptance::kAny, improvement_.random());
}

/// Improves what has changed since a time, and what is around it.
void Disturbance::settle(std::uint32_t since) {
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
        isChanged = improvement_.improveEdge({mesh_.lengthOf(a, b), a, b, id}) || isChanged;
        if (!mesh_.element(id).isAlive()) break;
      }
      const AdaptElement& at = mesh_.element(id);
      if (at.isAlive() && at.quality < badness_.floor() + kAboveFloor &&
          improvement_.isWorthTrying(at))
        isChanged = improvement_.improveElement(id) || isChanged;
    }
    for (const NodeId id : IdRange<NodeId>(mesh_.nodes.size())) {
      if (!mesh_.node(id).element.isNone() && isNew(id)) improvement_.move(id, MoveEffort::kSearch);
    }
    if (!isChanged) break;
  }
}

/// Returns by how much the badness has fallen since the state.
double Disturbance::gain() {
  changes_.clear();
  double gain = 0.0;
  for (std::size_t i = 0; i < mesh_.elements.size(); ++i) {
    const AdaptElement& now = mesh_.elements[i];
    const AdaptElement* old = i < state_.elements.size() ? &state_.elements[i] : nullptr;
    if (old != nullptr && old->nodes == now.nodes && old->quality == now.quality) continue;
    if (old != nullptr && old->isAlive()) {
      gain += badness_.ofElement(old->quality);
      for (const TetEdge& e : kTetEdges) {
        const NodeId a = old->nodes[e.from];
        const NodeId b = old->nodes[e.to];
        changes_(a, b).before =
            metricLengthBetween(state_.nodes[a.index()], state_.nodes[b.index()]);
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
void Disturbance::settleInSteps(std::uint32_t since) {
  const double floor = badness_.floor();
  badness_.setFloor(0.5 * floor);
  settle(since);
  badness_.setFloor(floor);
  settle(since);
}

/// Disturbs the mesh at an edge of an element and improves what is around it. Keeps the change and saves the state if the badness
/// has fallen; restores the state otherwise. Returns whether the mesh has changed.
bool Disturbance::disturbAndSettle(Kind kind, const TetEdge& edge, TetId id) {
  const NodeQuad nodes = mesh_.element(id).nodes;
  const std::uint32_t since = mesh_.now;
  if (!disturb(kind, nodes[edge.from], nodes[edge.to], id)) return false;
  settleInSteps(since);
  const bool isBetter = gain() > kMinFall;
  if (isBetter) {
    mesh_.save(state_);
  } else {
    mesh_.restore(state_);
  }
  return isBetter;
}

/// Returns whether the mesh has changed.
Task<bool> Disturbance::tryElement(Work& work, TetId id) {
  for (const Kind kind : {Kind::kSplit, Kind::kCollapse, Kind::kRemove}) {
    for (const TetEdge& edge : kTetEdges) {
      if (isStopped_ || triesLeft_ == 0) co_return false;
      --triesLeft_;
      const bool isBetter = disturbAndSettle(kind, edge, id);
      co_await work.spend(mesh_.elements.size());
      if (isBetter) co_return true;
    }
  }
  co_return false;
}

bool Disturbance::wasTried(const PoorElement& poor) const {
  return std::ranges::any_of(failed_, [&](const PoorElement& other) {
    return other.element == poor.element && other.quality == poor.quality;
  });
}

Task<> Disturbance::run(Work& work) {
  triesLeft_ = std::min(kMaxTries, kMaxCopied / std::max<std::size_t>(1, mesh_.elements.size()));
  bool isChanged = true;
  for (int round = 0; round < kMaxRounds && isChanged; ++round) {
    isChanged = false;
    const std::vector<PoorElement> all =
        co_await listPoor(work, mesh_, kFarBelow * badness_.floor());
    if (all.empty() || all.size() > kMaxPoor) break;
    if (round == 0) mesh_.save(state_);
    for (const PoorElement& poor : all) {
      const AdaptElement& element = mesh_.element(poor.element);
      const bool isSame = element.isAlive() && element.quality == poor.quality;
      if (!isSame || wasTried(poor)) continue;
      if (isStopped_ || triesLeft_ == 0) co_return;
      const bool isBetter = co_await tryElement(work, poor.element);
      isChanged = isChanged || isBetter;
      if (!isBetter) failed_.push_back(poor);
    }
  }
}

}  // namespace tetrafront
