#include "optimize/last_resort_improver.h"

#include <algorithm>
#include <tuple>

#include "base/sort.h"
#include "optimize/rules.h"

namespace tetrafront {
namespace {

template <class Id>
void sortOnce(std::vector<Id>& ids) {
  stableSort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

template <class Space>
bool LastResortImprover<Space>::hasImproved() const {
  return !complex_.isLive(tet_) || complex_.cost(tet_) <= 1.0 ||
         complex_.element(tet_).nodes != nodes_;
}

template <class Space>
void LastResortImprover<Space>::begin(TetId tet) {
  tet_ = tet;
  nodes_ = complex_.element(tet).nodes;
  gather();
  next_ = triedBefore();
}

/// Returns how many changes have failed on the element and its unchanged surroundings.
template <class Space>
std::size_t LastResortImprover<Space>::triedBefore() const {
  const auto last = std::find_if(tried_.rbegin(), tried_.rend(),
                                 [&](const Tried& tried) { return tried.nodes == nodes_; });
  if (last == tried_.rend()) return 0;
  const bool isUnchanged =
      std::ranges::all_of(near_, [&](TetId tet) { return complex_.changedIn(tet) < last->pass; });
  return isUnchanged ? last->next : 0;
}

template <class Space>
void LastResortImprover<Space>::gather() {
  near_.clear();
  freeNodes_.clear();
  edges_.clear();
  Vec3 centroid(0.0);
  for (const NodeId node : nodes_) {
    centroid += complex_.position(node) * 0.25;
    if (!complex_.findStar(node, star_)) continue;
    near_.insert(near_.end(), star_.elements.begin(),
                 star_.elements.begin() + static_cast<std::ptrdiff_t>(star_.size));
  }
  sortOnce(near_);
  for (const TetId tet : near_) {
    const Corners& corners = complex_.element(tet).nodes;
    for (const NodeId node : corners) {
      if (!complex_.isFixed(node)) freeNodes_.push_back(node);
    }
    for (const TetEdge& ends : kTetEdges) {
      const auto [a, b] = std::minmax(corners[ends.from], corners[ends.to]);
      const Vec3 away = (complex_.position(a) + complex_.position(b)) * 0.5 - centroid;
      edges_.push_back({glm::dot(away, away), a, b});
    }
  }
  sortOnce(freeNodes_);
  stableSort(edges_, [](const NearEdge& p, const NearEdge& q) {
    return std::tie(p.distance, p.a, p.b) < std::tie(q.distance, q.a, q.b);
  });
  const auto isSame = [](const NearEdge& p, const NearEdge& q) { return p.a == q.a && p.b == q.b; };
  edges_.erase(std::unique(edges_.begin(), edges_.end(), isSame), edges_.end());
}

/// Returns one of the collected elements that still has the edge, or none.
template <class Space>
TetId LastResortImprover<Space>::elementAt(const NearEdge& edge) const {
  const auto found = std::ranges::find_if(near_, [&](TetId tet) {
    return complex_.isLive(tet) &&
           edgeBetween(complex_.element(tet), edge.a, edge.b) < kTetEdges.size();
  });
  return found == near_.end() ? TetId() : *found;
}

template <class Space>
void LastResortImprover<Space>::moveAll(const std::vector<NodeId>& nodes,
                                        const ElementCost<Space>& cost) {
  constexpr int kSweeps = 4;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const NodeId node : nodes) mover_.improve(node, MoveKind::kLowerPowers, cost);
  }
}

/// Moves all nodes of what the trial touched, then improves the worst of it.
template <class Space>
void LastResortImprover<Space>::settle(const ElementCost<Space>& cost) {
  std::vector<NodeId> nodes;
  for (const TetId tet : complex_.touchedByTrial()) {
    for (const NodeId node : complex_.element(tet).nodes) {
      if (!complex_.isFixed(node)) nodes.push_back(node);
    }
  }
  sortOnce(nodes);
  moveAll(nodes, cost);
  improver_.settle(nodes, cost);
}

/// Makes a trial change and improves what it touched.
template <class Space>
template <class Change>
bool LastResortImprover<Space>::attempt(const ElementCost<Space>& cost, Change change) {
  // On the way, elements may be worse than the cost permits.
  const ElementCost<Space> onTheWay = cost.within({});
  complex_.beginTrial();
  if (change(onTheWay)) {
    settle(onTheWay);
    const auto counts = complex_.sumsOfTrial([](double one) { return one > 1.0 ? 1.0 : 0.0; });
    const auto powers =
        complex_.sumsOfTrial([](double one) { return one > 1.0 ? one * one * one * one : 0.0; });
    if (counts.now <= counts.before && powers.now < powers.before * (1.0 - kLastResortGain) &&
        complex_.fitsTrial() && complex_.isTrialValid(cost)) {
      complex_.keepTrial();
      return true;
    }
  }
  complex_.takeBack();
  return false;
}

template <class Space>
bool LastResortImprover<Space>::changeEdge(const NearEdge& edge, bool split,
                                           const ElementCost<Space>& cost) {
  const TetId tet = elementAt(edge);
  if (tet.isNone()) return false;
  EdgeRing ring;
  const std::size_t at = edgeBetween(complex_.element(tet), edge.a, edge.b);
  if (!findRing(complex_, tet, at, kLastResortRing, ring) || !ring.closed) return false;
  --tries_;
  return attempt(cost, [&](const ElementCost<Space>& onTheWay) {
    return split ? !splitter_.force(ring, onTheWay).isNone() : removal_.force(ring, onTheWay);
  });
}

template <class Space>
bool LastResortImprover<Space>::tryOne(const ElementCost<Space>& cost) {
  constexpr double kMaxLength = 2.0;  // in target lengths
  const std::size_t collapses = 1 + 2 * edges_.size();
  if (hasImproved()) return false;
  // Where parts of the mesh touch in a node, another part may have been gathered, with fewer changes, than last time.
  if (tries_ == 0 || next_ >= collapses + freeNodes_.size()) {
    tried_.push_back({nodes_, complex_.pass(), next_});
    return false;
  }
  const std::size_t at = next_++;
  if (at == 0) {
    attempt(cost, [&](const ElementCost<Space>& onTheWay) {
      moveAll(freeNodes_, onTheWay);
      return true;
    });
  } else if (at < collapses) {
    changeEdge(edges_[(at - 1) / 2], (at - 1) % 2 == 1, cost);
  } else {
    --tries_;
    attempt(cost, [&](const ElementCost<Space>& onTheWay) {
      return collapser_.force(freeNodes_[at - collapses], onTheWay, kMaxLength);
    });
  }
  return true;
}

template class LastResortImprover<PlainSpace>;
template class LastResortImprover<StretchedSpace>;

}  // namespace tetrafront
