#include "adapt/local_improvement.h"

#include <algorithm>
#include <cstddef>

namespace tetrafront {

bool LocalImprovement::improveEdge(const AdaptEdge& edge) {
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
  move(edge.a, MoveEffort::kLong);
  move(edge.b, MoveEffort::kLong);
  return false;
}

bool LocalImprovement::isWorthTrying(const AdaptElement& element) const {
  return std::ranges::any_of(element.nodes,
                             [&](NodeId node) { return mesh_.node(node).changed > element.tried; });
}

bool LocalImprovement::improveElement(TetId id) {
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
  for (const NodeId node : nodes) isMoved = move(node, MoveEffort::kLong) || isMoved;
  if (!isMoved) mesh_.element(id).tried = mesh_.now;
  return isMoved;
}

}  // namespace tetrafront
