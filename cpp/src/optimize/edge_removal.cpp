#include "optimize/edge_removal.h"

#include <algorithm>

namespace tetrafront {
namespace {

/// Walks around an edge from one of its elements, leaving through the face opposite `opposite` and
/// keeping `kept`. Calls `visit(element, new node)`; ends at the boundary or back at `start`.
/// Returns 0 at the boundary, 1 if closed, -1 if the visitor stops.
template <class Visit>
int walkAround(const TetComplex& complex, TetId start, NodeId opposite, NodeId kept, Visit visit) {
  TetId tet = start;
  for (;;) {
    const ElementFace across =
        complex.element(tet).across[cornerOf(complex.element(tet), opposite)];
    if (across.isNone()) return 0;
    if (across.tet() == start) return 1;
    const NodeId fresh = complex.element(across.tet()).nodes[across.corner()];
    if (!visit(across.tet(), fresh)) return -1;
    opposite = kept;
    kept = fresh;
    tet = across.tet();
  }
}

}  // namespace

std::size_t edgeBetween(const Element& element, NodeId a, NodeId b) {
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    const NodeId one = element.nodes[kTetEdges[e].from];
    const NodeId other = element.nodes[kTetEdges[e].to];
    if ((one == a && other == b) || (one == b && other == a)) return e;
  }
  return kTetEdges.size();
}

namespace {

/// Walks in the first direction and sets ring.closed. Returns false if the ring is too large or
/// contains a rejected element.
template <class IsWelcome>
bool walkForth(const TetComplex& complex, TetId tet, std::size_t edge, std::size_t maxNodes,
               EdgeRing& ring, IsWelcome isWelcome) {
  const TetEdge& ends = kTetEdges[edge];
  const Element& element = complex.element(tet);
  const NodeId first = element.nodes[ends.left];
  const NodeId second = element.nodes[ends.right];
  ring.from = element.nodes[ends.from];
  ring.to = element.nodes[ends.to];
  ring.nodes[0] = first;
  ring.nodes[1] = second;
  ring.elements[0] = tet;
  ring.nodeCount = 2;
  ring.elementCount = 1;
  const int end = walkAround(complex, tet, first, second, [&](TetId next, NodeId node) {
    if (!isWelcome(next)) return false;
    if (ring.nodeCount == maxNodes) {
      // In a closed ring the last element yields the first node again.
      if (node != first) return false;
    } else {
      ring.nodes[ring.nodeCount] = node;
    }
    ++ring.nodeCount;
    ring.elements[ring.elementCount++] = next;
    return ring.elementCount < kMaxRing;
  });
  if (end < 0) return false;
  ring.closed = end == 1;
  if (ring.closed) --ring.nodeCount;  // the first node was visited twice
  return !ring.closed || ring.nodeCount <= maxNodes;
}

}  // namespace

bool findClosedRing(const TetComplex& complex, TetId tet, std::size_t edge, std::size_t maxNodes,
                    std::uint32_t since, EdgeRing& ring) {
  return walkForth(complex, tet, edge, maxNodes, ring,
                   [&](TetId other) { return other > tet || complex.changedIn(other) < since; }) &&
         ring.closed;
}

bool findRing(const TetComplex& complex, TetId tet, std::size_t edge, std::size_t maxNodes,
              EdgeRing& ring) {
  if (!walkForth(complex, tet, edge, maxNodes, ring, [](TetId) { return true; })) return false;
  if (ring.closed) return true;
  // Open: the elements in the other direction come first.
  const NodeId first = ring.nodes[0];
  const NodeId second = ring.nodes[1];
  const int back = walkAround(complex, tet, second, first, [&](TetId next, NodeId node) {
    if (ring.nodeCount + 1 > maxNodes || ring.nodeCount + 1 > kMaxRing) return false;
    std::copy_backward(ring.nodes.begin(), ring.nodes.begin() + static_cast<int>(ring.nodeCount),
                       ring.nodes.begin() + static_cast<int>(ring.nodeCount) + 1);
    std::copy_backward(ring.elements.begin(),
                       ring.elements.begin() + static_cast<int>(ring.elementCount),
                       ring.elements.begin() + static_cast<int>(ring.elementCount) + 1);
    ring.nodes[0] = node;
    ring.elements[0] = next;
    ++ring.nodeCount;
    ++ring.elementCount;
    return true;
  });
  return back == 0 && ring.nodeCount <= maxNodes;
}

bool isBoundaryEdge(const TetComplex& complex, TetId tet, std::size_t edge) {
  const Corners& nodes = complex.element(tet).nodes;
  const TetEdge& ends = kTetEdges[edge];
  return walkAround(complex, tet, nodes[ends.left], nodes[ends.right],
                    [](TetId, NodeId) { return true; }) == 0;
}

/// Returns the cost of the two elements over ring nodes i, j, k in ring order; kInvalidCost if it
/// is `bound` or more.
template <class Space>
double EdgeRemoval<Space>::costOverTriangle(const EdgeRing& ring, const ElementCost<Space>& cost,
                                            std::size_t i, std::size_t j, std::size_t k,
                                            double bound) const {
  const NodeId a = ring.nodes[i];
  const NodeId b = ring.nodes[j];
  const NodeId c = ring.nodes[k];
  const double above = complex_.costOf(cost, {a, b, c, ring.to});
  if (above >= bound) return kInvalidCost;
  const double both = cost.combined(above, complex_.costOf(cost, {a, c, b, ring.from}));
  return both < bound ? both : kInvalidCost;
}

/// Computes intervals_[i][n] for all intervals in [first, last]; in a closed ring, ring nodes count
/// on beyond the end. Most triangles are never evaluated, because their neighbours already cost too
/// much. Returns false if no interval is below the bound.
template <class Space>
bool EdgeRemoval<Space>::costIntervals(const EdgeRing& ring, const ElementCost<Space>& cost,
                                       bool wraps, double bound) {
  const std::size_t count = ring.nodeCount;
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) intervals_[i][1] = 0.0;
  for (std::size_t length = 2; length < count; ++length) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!wraps && i + length >= count) break;
      double best = bound;
      for (std::size_t cut = 1; cut < length; ++cut) {
        const std::size_t middle = (i + cut) % count;
        const double sides = cost.combined(intervals_[i][cut], intervals_[middle][length - cut]);
        if (sides >= best) continue;
        const double here = costOverTriangle(ring, cost, i, middle, (i + length) % count, best);
        const double sum = cost.combined(sides, here);
        if (sum >= best) continue;
        best = sum;
        cuts_[i][length] = static_cast<std::uint8_t>(cut);
      }
      intervals_[i][length] = best < bound ? best : kInvalidCost;
      any = any || best < bound;
    }
  }
  return any;
}

template <class Space>
void EdgeRemoval<Space>::costSectors(const EdgeRing& ring, const ElementCost<Space>& cost,
                                     double bound) {
  const std::size_t count = ring.nodeCount;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t length = 1; length < count; ++length) {
      if (!ring.closed && i + length >= count) break;
      double& value = sectors_[i][length];
      if (length == 1) {
        value = complex_.cost(ring.elements[i]);
      } else if ((ring.closed && length + 1 == count) || intervals_[i][length] >= bound) {
        value = kInvalidCost;
      } else {
        value = complex_.costOf(
            cost, {ring.from, ring.to, ring.nodes[i], ring.nodes[(i + length) % count]});
      }
    }
  }
}

/// Keeps the edge but merges some sectors: finds the best way once around, for each starting node.
template <class Space>
void EdgeRemoval<Space>::planFans(const EdgeRing& ring, const ElementCost<Space>& cost,
                                  double bound) {
  costSectors(ring, cost, bound);
  const std::size_t count = ring.nodeCount;
  const std::size_t steps = ring.closed ? count : count - 1;
  std::array<double, kMaxRing + 1> best{};
  std::array<std::uint8_t, kMaxRing + 1> cameFrom{};
  for (std::size_t start = 0; start < (ring.closed ? count : 1); ++start) {
    best[0] = 0.0;
    for (std::size_t at = 1; at <= steps; ++at) {
      best[at] = kInvalidCost;
      for (std::size_t before = 0; before < at; ++before) {
        const std::size_t length = at - before;
        const std::size_t i = (start + before) % count;
        if (length >= count || best[before] >= bound || sectors_[i][length] >= bound) continue;
        if (intervals_[i][length] >= bound) continue;
        const double sum =
            cost.combined(best[before], cost.combined(sectors_[i][length], intervals_[i][length]));
        if (sum >= best[at]) continue;
        best[at] = sum;
        cameFrom[at] = static_cast<std::uint8_t>(before);
      }
    }
    if (best[steps] >= planCost_) continue;
    plan_ = Plan::kFans;
    planCost_ = best[steps];
    fanStart_ = start;
    fanCount_ = 0;
    for (std::size_t at = steps; at > 0; at = cameFrom[at]) {
      fanCuts_[fanCount_++] = static_cast<std::uint8_t>(at);
    }
    fanCuts_[fanCount_++] = 0;
  }
}

template <class Space>
bool EdgeRemoval<Space>::plan(const EdgeRing& ring, const ElementCost<Space>& cost, bool fans,
                              double bound) {
  plan_ = Plan::kNone;
  planCost_ = bound;
  if (ring.nodeCount < 3) return false;
  if (!costIntervals(ring, cost, fans && ring.closed, bound)) return false;
  const double removed = ring.closed ? intervals_[0][ring.nodeCount - 1] : kInvalidCost;
  if (removed < planCost_) {
    plan_ = Plan::kRemove;
    planCost_ = removed;
  }
  if (fans) planFans(ring, cost, bound);
  return plan_ != Plan::kNone;
}

template <class Space>
void EdgeRemoval<Space>::put(const ElementCost<Space>& cost, NodeId a, NodeId b, NodeId c,
                             NodeId d) {
  const Corners nodes{a, b, c, d};
  // Kept sectors may have been too flat on entry.
  fresh_[freshCount_++] = {nodes, std::min(complex_.costOf(cost, nodes), kEntryCost)};
}

template <class Space>
void EdgeRemoval<Space>::fillInterval(const EdgeRing& ring, const ElementCost<Space>& cost,
                                      std::size_t first, std::size_t length) {
  if (length < 2) return;
  const std::size_t count = ring.nodeCount;
  const std::size_t cut = cuts_[first][length];
  const std::size_t middle = (first + cut) % count;
  const NodeId a = ring.nodes[first];
  const NodeId b = ring.nodes[middle];
  const NodeId c = ring.nodes[(first + length) % count];
  put(cost, a, b, c, ring.to);
  put(cost, a, c, b, ring.from);
  fillInterval(ring, cost, first, cut);
  fillInterval(ring, cost, middle, length - cut);
}

template <class Space>
bool EdgeRemoval<Space>::apply(const EdgeRing& ring, const ElementCost<Space>& cost) {
  freshCount_ = 0;
  if (plan_ == Plan::kRemove) {
    fillInterval(ring, cost, 0, ring.nodeCount - 1);
  } else {
    for (std::size_t i = fanCount_ - 1; i > 0; --i) {
      const std::size_t first = (fanStart_ + fanCuts_[i]) % ring.nodeCount;
      const std::size_t length = fanCuts_[i - 1] - fanCuts_[i];
      put(cost, ring.from, ring.to, ring.nodes[first],
          ring.nodes[(first + length) % ring.nodeCount]);
      fillInterval(ring, cost, first, length);
    }
  }
  if (!complex_.hasRoomFor(ring.elementCount, freshCount_)) return false;
  complex_.replace(ring.elementSpan(), std::span(fresh_).first(freshCount_));
  return true;
}

template <class Space>
bool EdgeRemoval<Space>::improve(const EdgeRing& ring, const ElementCost<Space>& cost,
                                 const EdgeRemovalOptions& options) {
  double old = 0.0;
  for (const TetId tet : ring.elementSpan()) old = cost.combined(old, complex_.cost(tet));
  // A relative gain on a cost near 0 is a rounding error.
  constexpr double kMinGain = 1e-12;
  const double bound = old * (1.0 - options.minGain) - kMinGain;
  if (!(bound > 0.0) || (!ring.closed && !options.fans)) return false;
  return plan(ring, cost, options.fans, bound) && apply(ring, cost);
}

template <class Space>
bool EdgeRemoval<Space>::force(const EdgeRing& ring, const ElementCost<Space>& cost) {
  return ring.closed && plan(ring, cost, false, kInvalidCost) && apply(ring, cost);
}

template class EdgeRemoval<PlainSpace>;
template class EdgeRemoval<StretchedSpace>;

}  // namespace tetrafront
