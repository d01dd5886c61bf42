#include "optimize/element_improver.h"

#include <algorithm>
#include <limits>

#include "base/sort.h"
#include "optimize/rules.h"

namespace tetrafront {

template <class Space>
bool ElementImprover<Space>::stillPoor(TetId tet, const Corners& nodes) const {
  return complex_.isLive(tet) && complex_.cost(tet) > 1.0 && complex_.element(tet).nodes == nodes;
}

/// Makes a trial change and keeps it if the cost of what it touched falls by that fraction.
template <class Space>
template <class Change>
bool ElementImprover<Space>::attempt(double gain, const ElementCost<Space>& cost, Change change) {
  const auto excess = [&](double one) {
    if (one <= counted_) return 0.0;
    return aim_ == ImprovementGoal::kFewer ? one : one * one * one * one;
  };
  complex_.beginTrial();
  if (change()) {
    const auto sums = complex_.sumsOfTrial(excess);
    if (sums.now < sums.before * (1.0 - gain) && complex_.fitsTrial() &&
        complex_.isTrialValid(cost)) {
      complex_.keepTrial();
      return true;
    }
  }
  complex_.takeBack();
  return false;
}

template <class Space>
bool ElementImprover<Space>::improve(TetId tet, const ElementCost<Space>& cost) {
  const Corners nodes = complex_.element(tet).nodes;
  attempt(kRepairGain, cost, [&] { return swapAround(tet, cost); });
  if (!stillPoor(tet, nodes)) return true;
  attempt(kRepairGain, cost, [&] { return moveCorners(nodes, cost); });
  if (!stillPoor(tet, nodes)) return true;
  attempt(kRepairGain, cost, [&] { return collapseCorner(nodes, cost); });
  if (!stillPoor(tet, nodes)) return true;
  attempt(kRepairGain, cost, [&] { return insertNode(tet, cost); });
  if (!stillPoor(tet, nodes)) return true;
  compound(tet, cost);
  if (!stillPoor(tet, nodes)) return true;
  detour(tet, cost);
  return !stillPoor(tet, nodes);
}

template <class Space>
bool ElementImprover<Space>::swapAround(TetId tet, const ElementCost<Space>& cost) {
  EdgeRing ring;
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    if (!findRing(complex_, tet, e, kRepairRing, ring)) continue;
    if (removal_.improve(ring, cost, kRepairOptions)) return true;
  }
  return false;
}

template <class Space>
bool ElementImprover<Space>::moveCorners(const Corners& nodes, const ElementCost<Space>& cost) {
  bool moved = false;
  for (const NodeId node : nodes) {
    moved = mover_.improve(node, MoveKind::kLowerWorst, cost) || moved;
  }
  return moved;
}

template <class Space>
bool ElementImprover<Space>::collapseCorner(const Corners& nodes, const ElementCost<Space>& cost) {
  constexpr double kMaxLength = 2.0;  // in target lengths
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeId node) {
    return collapser_.collapse(node, cost, kMaxLength, kRepairGain);
  });
}

/// Returns a point above the middle of the shortest edge, at its length: where an element at the short edge of a needle needs
/// its apex.
template <class Space>
Vec3 ElementImprover<Space>::besideShortestEdge(const Corners& nodes, const Vec3& centroid) const {
  double shortest = std::numeric_limits<double>::infinity();
  Vec3 middle = centroid;
  for (const TetEdge& ends : kTetEdges) {
    const Vec3& a = complex_.position(nodes[ends.from]);
    const Vec3& b = complex_.position(nodes[ends.to]);
    const double length = glm::length(b - a);
    if (length >= shortest) continue;
    shortest = length;
    middle = (a + b) * 0.5;
  }
  const double whole = glm::length(centroid - middle);
  return whole > shortest ? middle + (centroid - middle) * (shortest / whole) : centroid;
}

template <class Space>
bool ElementImprover<Space>::insertNode(TetId tet, const ElementCost<Space>& cost) {
  const Corners nodes = complex_.element(tet).nodes;
  Vec3 centroid(0.0);
  for (const NodeId node : nodes) centroid += complex_.position(node) * 0.25;
  const Target target =
      Space::meanOf(complex_.target<Space>(nodes[0]), complex_.target<Space>(nodes[1]),
                    complex_.target<Space>(nodes[2]), complex_.target<Space>(nodes[3]));
  if (insertAt(std::span(&tet, 1), centroid, target, cost)) return true;
  if (insertAt(std::span(&tet, 1), besideShortestEdge(nodes, centroid), target, cost)) return true;
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    EdgeRing ring;
    if (!findRing(complex_, tet, e, kRepairRing, ring) || !ring.closed) continue;
    const Vec3 middle = (complex_.position(ring.from) + complex_.position(ring.to)) * 0.5;
    if (insertAt(ring.elementSpan(), middle, target, cost)) return true;
  }
  return insertBeside(tet, target, cost);
}

/// Inserts a node among the neighbours of an element with two faces on the boundary. If these lie in one plane, up to rounding,
/// there is no room for a node within the element.
template <class Space>
bool ElementImprover<Space>::insertBeside(TetId tet, const Target& target,
                                          const ElementCost<Space>& cost) {
  std::array<TetId, 5> seeds{tet};
  std::size_t count = 1;
  for (const ElementFace across : complex_.element(tet).across) {
    if (!across.isNone()) seeds[count++] = across.tet();
  }
  constexpr std::size_t kMaxNeighbours = 2;
  if (count > 1 + kMaxNeighbours) return false;
  Vec3 middle(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    for (const NodeId node : complex_.element(seeds[i]).nodes) middle += complex_.position(node);
  }
  return insertAt(std::span(seeds).first(count), middle / (4.0 * static_cast<double>(count)),
                  target, cost);
}

/// Returns the cost of the element of an apex and a face.
template <class Space>
typename Space::Frame ElementImprover<Space>::coneFrame(const Target& apex, const Corners& nodes,
                                                        std::size_t side) const {
  if constexpr (Space::kIsStretched) {
    const auto& corners = kFaceCorners[side];
    return Space::frameOf(apex, complex_.target<Space>(nodes[corners[0]]),
                          complex_.target<Space>(nodes[corners[1]]),
                          complex_.target<Space>(nodes[corners[2]]));
  } else {
    return {};
  }
}

/// Adds every neighbour whose common face would form an element with the apex that is worse than
/// the limit. Returns false if that reaches the boundary or goes too far.
template <class Space>
bool ElementImprover<Space>::growCavity(const Vec3& position, const Target& target,
                                        const ElementCost<Space>& cost, double limit) {
  for (std::size_t i = 0; i < cavity_.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Element& element = complex_.element(cavity_[i]);
      const ElementFace across = element.across[k];
      if (!across.isNone() && inCavity_[across.tet().index()] == cavityStamp_) continue;
      const auto& side = kFaceCorners[k];
      const double here =
          cost(position, complex_.position(element.nodes[side[0]]),
               complex_.position(element.nodes[side[1]]), complex_.position(element.nodes[side[2]]),
               coneFrame(target, element.nodes, k));
      if (here <= limit) continue;
      if (across.isNone()) {
        if (here >= kInvalidCost) return false;
        continue;
      }
      if (cavity_.size() == kMaxRepairCavity) return false;
      cavity_.push_back(across.tet());
      inCavity_[across.tet().index()] = cavityStamp_;
    }
  }
  return true;
}

template <class Space>
bool ElementImprover<Space>::isInCavity(ElementFace across) const {
  return !across.isNone() && inCavity_[across.tet().index()] == cavityStamp_;
}

/// Calls visit(element, k) for each face k between an element of the cavity and the rest of the mesh. Stops and returns
/// false when `visit` returns false.
template <class Space>
template <class Visitor>
bool ElementImprover<Space>::visitCavityFaces(Visitor visit) const {
  for (const TetId tet : cavity_) {
    const Element& element = complex_.element(tet);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!isInCavity(element.across[k]) && !visit(element, k)) return false;
    }
  }
  return true;
}

template <class Space>
void ElementImprover<Space>::hollowOut(const Target& target) {
  hollow_.clear();
  visitCavityFaces([&](const Element& element, std::size_t k) {
    const auto& face = kFaceCorners[k];
    hollow_.add(complex_.position(element.nodes[face[0]]),
                complex_.position(element.nodes[face[1]]),
                complex_.position(element.nodes[face[2]]), coneFrame(target, element.nodes, k));
    return true;
  });
}

template <class Space>
bool ElementImprover<Space>::insertAt(std::span<const TetId> seeds, const Vec3& start,
                                      const Target& target, const ElementCost<Space>& cost) {
  constexpr int kRounds = 3;
  constexpr int kSteps = 6;
  constexpr double kAbsorb =
      0.7;  // absorb a neighbour behind a cone element worse than this fraction of the worst
  constexpr double kTighten = 0.95;
  constexpr double kNear = 1.05;  // about as poor as before; a few more steps may succeed
  inCavity_.resize(std::max(inCavity_.size(), complex_.slotCount()), 0);
  ++cavityStamp_;
  cavity_.assign(seeds.begin(), seeds.end());
  double worst = 0.0;
  for (const TetId tet : cavity_) {
    inCavity_[tet.index()] = cavityStamp_;
    worst = std::max(worst, complex_.cost(tet));
  }
  Vec3 position = start;
  double limit = worst * kAbsorb;
  bool isNear = true;
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t before = cavity_.size();
    if (!growCavity(position, target, cost, limit)) return false;
    if (!isNear && cavity_.size() == before) return false;
    for (const TetId tet : cavity_) worst = std::max(worst, complex_.cost(tet));
    hollowOut(target);
    double best = hollow_.costAt(position, cost, kInvalidCost);
    if (best >= kInvalidCost) return false;
    lowerWorst(hollow_, cost, kSteps, position, best);
    if (best < worst * (1.0 - kRepairGain)) return fillCavity(position, target, cost);
    isNear = best < worst * kNear;
    limit = best * kTighten;
  }
  return false;
}

template <class Space>
bool ElementImprover<Space>::fillCavity(const Vec3& position, const Target& target,
                                        const ElementCost<Space>& cost) {
  const NodeId apex = complex_.addNode<Space>(position, target);
  fresh_.clear();
  std::vector<NodeId> kept;
  const bool isValid = visitCavityFaces([&](const Element& element, std::size_t k) {
    const auto& face = kFaceCorners[k];
    const Corners nodes{apex, element.nodes[face[0]], element.nodes[face[1]],
                        element.nodes[face[2]]};
    fresh_.push_back({nodes, complex_.costOf(cost, nodes)});
    kept.insert(kept.end(), nodes.begin() + 1, nodes.end());
    return fresh_.back().cost < kInvalidCost;
  });
  if (!isValid) return false;
  // A cavity may remove free nodes, but not fixed ones.
  sortFew(kept);
  std::vector<NodeId> swallowed;
  for (const TetId tet : cavity_) {
    for (const NodeId node : complex_.element(tet).nodes) {
      if (std::binary_search(kept.begin(), kept.end(), node)) continue;
      if (complex_.isFixed(node)) return false;
      swallowed.push_back(node);
    }
  }
  complex_.replace(cavity_, fresh_);
  for (const NodeId node : swallowed) complex_.forget(node);
  return true;
}

template <class Space>
bool ElementImprover<Space>::compound(TetId tet, const ElementCost<Space>& cost) {
  const Corners nodes = complex_.element(tet).nodes;
  for (const TetEdge& ends : kTetEdges) {
    for (const bool split : {false, true}) {
      if (tryCompound(tet, nodes[ends.from], nodes[ends.to], split, cost)) return true;
      if (!complex_.isLive(tet) || complex_.element(tet).nodes != nodes) return false;
    }
  }
  return false;
}

/// Makes compound changes that begin at a neighbour.
template <class Space>
bool ElementImprover<Space>::detour(TetId tet, const ElementCost<Space>& cost) {
  const std::array<ElementFace, 4> sides = complex_.element(tet).across;
  for (const ElementFace across : sides) {
    if (across.isNone()) continue;
    const Corners nodes = complex_.element(across.tet()).nodes;
    for (const TetEdge& ends : kTetEdges) {
      for (const bool split : {false, true}) {
        if (tryCompound(across.tet(), nodes[ends.from], nodes[ends.to], split, cost)) {
          return true;
        }
      }
    }
  }
  return false;
}

/// Removes or splits the edge at any cost, improves the surroundings, and keeps the result if its
/// worst element is better than before.
template <class Space>
bool ElementImprover<Space>::tryCompound(TetId tet, NodeId a, NodeId b, bool split,
                                         const ElementCost<Space>& cost) {
  if (compounds_ == 0) return false;
  EdgeRing ring;
  const std::size_t edge = edgeBetween(complex_.element(tet), a, b);
  if (edge == kTetEdges.size() || !findRing(complex_, tet, edge, kRepairRing, ring)) {
    return false;
  }
  if (!ring.closed) return false;
  --compounds_;
  return attempt(kCompoundGain, cost, [&] {
    // On the way, elements may be worse than the cost permits.
    const ElementCost<Space> onTheWay = cost.within({});
    std::vector<NodeId> nodes(ring.nodes.begin(),
                              ring.nodes.begin() + static_cast<std::ptrdiff_t>(ring.nodeCount));
    nodes.insert(nodes.end(), {ring.from, ring.to});
    if (split) {
      const NodeId middle = splitter_.force(ring, onTheWay);
      if (middle.isNone()) return false;
      nodes.push_back(middle);
    } else if (!removal_.force(ring, onTheWay)) {
      return false;
    }
    settle(nodes, onTheWay);
    return true;
  });
}

template <class Space>
void ElementImprover<Space>::settle(std::span<const NodeId> nodes, const ElementCost<Space>& cost) {
  constexpr int kSteps = 20;
  const auto moveAll = [&] {
    for (const NodeId node : nodes) mover_.improve(node, MoveKind::kLowerWorst, cost);
  };
  moveAll();
  for (int i = 0; i < kSteps && settleOne(cost); ++i) {
  }
  moveAll();
}

/// Improves one of the few worst elements that the trial touched, if possible.
template <class Space>
bool ElementImprover<Space>::settleOne(const ElementCost<Space>& cost) {
  constexpr std::size_t kWorst = 4;
  std::vector<TetId> poor = complex_.touchedByTrial();
  std::erase_if(poor, [&](TetId tet) { return complex_.cost(tet) <= 1.0; });
  stableSort(poor, [&](TetId p, TetId q) { return complex_.cost(p) > complex_.cost(q); });
  poor.resize(std::min(poor.size(), kWorst));
  return std::any_of(poor.begin(), poor.end(), [&](TetId tet) {
    const Corners nodes = complex_.element(tet).nodes;
    return swapAround(tet, cost) || moveCorners(nodes, cost) || collapseCorner(nodes, cost) ||
           insertNode(tet, cost);
  });
}

template class ElementImprover<PlainSpace>;
template class ElementImprover<StretchedSpace>;

}  // namespace tetrafront
