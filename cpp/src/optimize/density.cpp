#include "optimize/density.h"

#include <algorithm>

#include "base/sort.h"
#include "optimize/rules.h"

namespace tetrafront {

template <class Space>
void EdgeSplitter<Space>::collect(std::size_t first, std::size_t last, std::uint32_t since) {
  EdgeRing ring;
  for (std::size_t t = first; t < last; ++t) {
    const TetId tet(t);
    if (!complex_.isLive(tet) || complex_.changedIn(tet) < since) continue;
    const Corners& nodes = complex_.element(tet).nodes;
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      const NodeId a = nodes[kTetEdges[e].from];
      const NodeId b = nodes[kTetEdges[e].to];
      const double length = relativeLength<Space>(complex_, a, b);
      if (length <= kMaxSparseEdge) continue;
      if (!findClosedRing(complex_, tet, e, kMaxSplitRing, since, ring)) continue;
      edges_.push_back({length, a, b, tet});
    }
  }
}

template <class Space>
void EdgeSplitter<Space>::sortCollected() {
  stableSort(edges_, [](const LongEdge& p, const LongEdge& q) { return p.length > q.length; });
}

template <class Space>
std::size_t EdgeSplitter<Space>::splitSome(std::size_t next, std::size_t count,
                                           const ElementCost<Space>& cost) {
  std::size_t done = 0;
  EdgeRing ring;
  for (std::size_t i = next; i < std::min(next + count, edges_.size()); ++i) {
    const LongEdge& edge = edges_[i];
    if (!complex_.isLive(edge.tet)) continue;
    const std::size_t at = edgeBetween(complex_.element(edge.tet), edge.a, edge.b);
    if (at == kTetEdges.size()) continue;
    if (!findRing(complex_, edge.tet, at, kMaxSplitRing, ring) || !ring.closed) continue;
    done += split(ring, cost) ? 1 : 0;
  }
  return done;
}

/// Returns the edge's midpoint, moved to where the new elements cost least.
template <class Space>
Vec3 EdgeSplitter<Space>::bestMiddle(const EdgeRing& ring, const ElementCost<Space>& cost) {
  const Vec3& from = complex_.position(ring.from);
  const Vec3& to = complex_.position(ring.to);
  hollow_.clear();
  const auto frame = [&](NodeId end, std::size_t i) -> typename Space::Frame {
    if constexpr (Space::kIsStretched) {
      return Space::frameOf(targetAtMiddle(ring), complex_.target<Space>(end),
                            complex_.target<Space>(ring.nodes[i]),
                            complex_.target<Space>(ring.nodes[(i + 1) % ring.nodeCount]));
    } else {
      return {};
    }
  };
  for (std::size_t i = 0; i < ring.nodeCount; ++i) {
    const Vec3& p = complex_.position(ring.nodes[i]);
    const Vec3& q = complex_.position(ring.nodes[(i + 1) % ring.nodeCount]);
    hollow_.add(to, p, q, frame(ring.to, i));
    hollow_.add(from, q, p, frame(ring.from, i));
  }
  Vec3 position = (from + to) * 0.5;
  constexpr int kSteps = 2;
  for (int i = 0; i < kSteps; ++i) {
    Vec3 step(0.0);
    if (!newtonStep(hollow_, position, false, step)) break;
    const double here = hollow_.costAt(position, cost, kInvalidCost);
    if (hollow_.costAt(position + step, cost, here) < here) position += step;
  }
  return position;
}

template <class Space>
bool EdgeSplitter<Space>::makeHalves(const EdgeRing& ring, const ElementCost<Space>& cost,
                                     NodeId middle) {
  for (std::size_t i = 0; i < ring.nodeCount; ++i) {
    const NodeId p = ring.nodes[i];
    const NodeId q = ring.nodes[(i + 1) % ring.nodeCount];
    const Corners upper{middle, ring.to, p, q};
    const Corners lower{ring.from, middle, p, q};
    fresh_[2 * i] = {upper, complex_.costOf(cost, upper)};
    fresh_[2 * i + 1] = {lower, complex_.costOf(cost, lower)};
    if (fresh_[2 * i].cost >= kInvalidCost || fresh_[2 * i + 1].cost >= kInvalidCost) return false;
  }
  return true;
}

template <class Space>
bool EdgeSplitter<Space>::split(const EdgeRing& ring, const ElementCost<Space>& cost) {
  if (!complex_.hasRoomFor(ring.elementCount, 2 * ring.elementCount)) return false;
  const Vec3 position = bestMiddle(ring, cost);
  double worst = 0.0;
  for (const TetId tet : ring.elementSpan()) worst = std::max(worst, complex_.cost(tet));
  if (relativeLength<Space>(complex_, ring.from, ring.to) > muchTooLong_) {
    worst = std::max(worst, kBearable);
  }
  // The worst element decides: by the sum, few edges would ever be split.
  for (std::size_t i = 0; i < hollow_.size(); ++i) {
    if (hollow_.costOf(i, position, cost) > worst) return false;
  }
  const NodeId middle = complex_.addNode<Space>(position, targetAtMiddle(ring));
  // makeHalves() orders the corners differently, so the last bit may differ.
  if (!makeHalves(ring, cost, middle)) return false;
  complex_.replace(ring.elementSpan(), std::span(fresh_).first(2 * ring.nodeCount));
  return true;
}

template <class Space>
NodeId EdgeSplitter<Space>::force(const EdgeRing& ring, const ElementCost<Space>& cost) {
  const Vec3 position = (complex_.position(ring.from) + complex_.position(ring.to)) * 0.5;
  const NodeId middle = complex_.addNode<Space>(position, targetAtMiddle(ring));
  if (!makeHalves(ring, cost, middle)) return {};
  complex_.replace(ring.elementSpan(), std::span(fresh_).first(2 * ring.nodeCount));
  return middle;
}

template <class Space>
void NodeCollapser<Space>::findNeighbours(NodeId node) {
  if (marks_.size() < complex_.nodeCount()) marks_.resize(complex_.nodeCount() * 3 / 2, 0);
  ++mark_;
  marks_[node.index()] = mark_;
  neighbours_.clear();
  for (std::size_t i = 0; i < star_.size; ++i) {
    for (const NodeId other : complex_.element(star_.elements[i]).nodes) {
      if (marks_[other.index()] == mark_) continue;
      marks_[other.index()] = mark_;
      neighbours_.push_back(other);
    }
  }
}

template <class Space>
void NodeCollapser<Space>::collect(std::size_t first, std::size_t last, std::uint32_t since) {
  for (std::size_t i = first; i < last; ++i) {
    const NodeId node(i);
    if (complex_.isFixed(node) || !complex_.isUsed(node)) continue;
    if (complex_.starChangedIn(node) < since || !complex_.findStar(node, star_)) continue;
    findNeighbours(node);
    double sum = 0.0;
    for (const NodeId other : neighbours_) sum += relativeLength<Space>(complex_, node, other);
    nodes_.push_back({sum / static_cast<double>(neighbours_.size()), node});
  }
}

template <class Space>
void NodeCollapser<Space>::sortCollected() {
  stableSort(nodes_, [](const Crowded& p, const Crowded& q) { return p.length < q.length; });
}

template <class Space>
std::size_t NodeCollapser<Space>::collapseSome(std::size_t next, std::size_t count,
                                               const ElementCost<Space>& cost) {
  std::size_t done = 0;
  for (std::size_t i = next; i < std::min(next + count, nodes_.size()); ++i) {
    done += collapse(nodes_[i].node, cost, maxEdge_, 0.0) ? 1 : 0;
  }
  return done;
}

/// Returns the cost of the star's elements with the node at the target; fills fresh_.
template <class Space>
double NodeCollapser<Space>::costOnto(NodeId target, const ElementCost<Space>& cost,
                                      const typename Space::Limit& limit, double bound) {
  freshCount_ = 0;
  const Vec3& position = complex_.position(target);
  double sum = 0.0;
  for (std::size_t i = 0; i < star_.size; ++i) {
    const Corners& nodes = complex_.element(star_.elements[i]).nodes;
    if (std::find(nodes.begin(), nodes.end(), target) != nodes.end()) continue;
    const auto& side = kFaceCorners[star_.corner[i]];
    const Corners moved{target, nodes[side[0]], nodes[side[1]], nodes[side[2]]};
    const double one = complex_.costOf(cost, moved);
    if (one >= kInvalidCost) return kInvalidCost;
    sum = cost.combined(sum, one);
    if (sum >= bound) return kInvalidCost;
    for (int k = 1; k < 4; ++k) {
      if (limit.isExceededBy(complex_.position(moved[k]) - position)) return kInvalidCost;
    }
    fresh_[freshCount_++] = {moved, one};
  }
  return sum;
}

/// Collects the star of a node and its neighbours. Returns false if the node is fixed or removed,
/// or has too many elements.
template <class Space>
bool NodeCollapser<Space>::findStarOf(NodeId node) {
  if (complex_.isFixed(node) || !complex_.isUsed(node) || !complex_.findStar(node, star_)) {
    return false;
  }
  findNeighbours(node);
  return true;
}

/// Collapses onto the neighbour with the lowest total cost of the star's elements, if it is below
/// the bound.
template <class Space>
bool NodeCollapser<Space>::collapseBelow(double bound, NodeId node, const ElementCost<Space>& cost,
                                         double maxLength) {
  const auto limit = [&](NodeId target) {
    return typename Space::Limit(maxLength, complex_.target<Space>(node),
                                 complex_.target<Space>(target));
  };
  NodeId target;
  for (const NodeId other : neighbours_) {
    const double sum = costOnto(other, cost, limit(other), bound);
    if (sum >= bound) continue;
    bound = sum;
    target = other;
  }
  if (target.isNone()) return false;
  costOnto(target, cost, limit(target), kInvalidCost);
  complex_.replace(std::span(star_.elements).first(star_.size),
                   std::span(fresh_).first(freshCount_));
  complex_.forget(node);
  return true;
}

template <class Space>
bool NodeCollapser<Space>::collapse(NodeId node, const ElementCost<Space>& cost, double maxLength,
                                    double minGain) {
  if (!findStarOf(node)) return false;
  double old = 0.0;
  for (std::size_t i = 0; i < star_.size; ++i) {
    old = cost.combined(old, complex_.cost(star_.elements[i]));
  }
  for (const NodeId other : neighbours_) {
    maxLength = std::max(maxLength, relativeLength<Space>(complex_, node, other));
  }
  const bool canGiveUp =
      cost.measure() == Measure::kBulk && old > kHopeless * static_cast<double>(star_.size);
  return collapseBelow(old * (1.0 - minGain), node, cost, canGiveUp ? kInvalidCost : maxLength);
}

template <class Space>
bool NodeCollapser<Space>::force(NodeId node, const ElementCost<Space>& cost, double maxLength) {
  return findStarOf(node) && collapseBelow(kInvalidCost, node, cost, maxLength);
}

template class EdgeSplitter<PlainSpace>;
template class EdgeSplitter<StretchedSpace>;
template class NodeCollapser<PlainSpace>;
template class NodeCollapser<StretchedSpace>;

}  // namespace tetrafront
