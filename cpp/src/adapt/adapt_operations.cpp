#include "adapt/adapt_operations.h"

#include <algorithm>
#include <cmath>

#include "geom/coordinates.h"
#include "metric/metric.h"

namespace tetrafront {
namespace {

/// Least fall of the badness that counts.
constexpr double kMinGain = 1e-3;

/// Where lengths lead, elements may become as poor as this, or a tenth poorer than before.
constexpr double kKeptQuality = 0.02;

/// A collapse for lengths must not make an edge longer than this.
constexpr double kLongestCollapsed = 1.45;

/// A swap for quality must gain this factor.
constexpr double kSwapGain = 1.02;

/// Least gain of quality that is not rounding, where edges are removed for quality.
constexpr double kRoundedGain = 1e-9;

/// Least quality after a disturbance.
constexpr double kMinDisturbed = 1e-3;

/// Edges with more elements are not removed.
constexpr std::size_t kLargestShell = 9;

/// A node that splits an edge is not nearer to an end than this part.
constexpr double kMinPart = 0.15;

}  // namespace

void AdaptContext::measure(AdaptNode& node) const {
  node.point = inExactRange(node.point);
  background.measure(node);
}

bool AdaptOperations::isAccepted(Acceptance acceptance) const {
  switch (acceptance) {
    case Acceptance::kBadness:
      return cavity_.gain() > kMinGain;
    case Acceptance::kAny:
      return cavity_.worstAfter() > kMinDisturbed;
    case Acceptance::kLengths:
      return cavity_.worstAfter() > std::min(kKeptQuality, 0.9 * cavity_.worstBefore());
  }
  return false;
}

double AdaptOperations::allowanceFor(Acceptance acceptance, std::span<const TetId> taken,
                                     double edges) const {
  if (acceptance != Acceptance::kBadness) return kForbidden;
  double cost = edges;
  for (const TetId id : taken)
    cost += context_.badness.ofElement(context_.mesh.element(id).quality);
  return cost;
}

/// Returns the part of the edge that is its middle in the metric.
double AdaptOperations::middleOf(NodeId a, NodeId b) const {
  const AdaptMesh& mesh = context_.mesh;
  const Vec3 edge = mesh.point(b) - mesh.point(a);
  const double atA = metricLength(mesh.node(a).metric, edge);
  const double atB = metricLength(mesh.node(b).metric, edge);
  return std::clamp(1.0 / (1.0 + std::sqrt(atA / atB)), kMinPart, 1.0 - kMinPart);
}

/// Places a node on the edge whose shell is known. Returns false if the edge is kept.
bool AdaptOperations::placeOnEdge(NodeId a, NodeId b, double part, AdaptNode& node) const {
  const AdaptMesh& mesh = context_.mesh;
  const AdaptNode& from = mesh.node(a);
  const AdaptNode& to = mesh.node(b);
  node.point = from.point + part * (to.point - from.point);
  node.at = from.at;
  node.part = from.part;
  if (shell_.isInside) return true;
  if (!shell_.isOnPatches()) return false;
  const SmoothPatchId one = shell_.ends[0].patch();
  const SmoothPatchId other = shell_.ends[1].patch();
  if (one == other) {
    const Place& hint = from.place.kind == PlaceKind::kPatch ? from.place : to.place;
    node.place = context_.guide.onPatch(one, hint, node.point);
    return true;
  }
  const FeatureLineId line =
      context_.guide.commonLine(from.place, to.place, one, other, 0.5 * (from.point + to.point));
  if (line.isNone()) return false;
  node.place = context_.guide.onLine(line, from.place, to.place, part, node.point);
  return true;
}

/// Stars the cavity from a new node.
bool AdaptOperations::starFromNew(const AdaptNode& node, const StarPlan& plan,
                                  Acceptance acceptance) {
  AdaptMesh& mesh = context_.mesh;
  mesh.nodes.push_back(node);
  context_.measure(mesh.nodes.back());
  mesh.nodes.back().changed = mesh.now;
  StarPlan own = plan;
  own.apex = NodeId(mesh.nodes.size() - 1);
  own.mayGrow = true;
  if (cavity_.build(own)) {
    cavity_.evaluate();
    if (isAccepted(acceptance) && cavity_.commit()) return true;
  }
  mesh.nodes.pop_back();
  return false;
}

bool AdaptOperations::split(NodeId a, NodeId b, TetId element, Acceptance acceptance, double part) {
  context_.mesh.findShell(a, b, element, shell_);
  for (double at : {part < 0.0 ? middleOf(a, b) : part, 0.5}) {
    AdaptNode node;
    if (!placeOnEdge(a, b, at, node)) return false;
    cavity_.elements = shell_.elements;
    const StarPlan plan{
        .apex = {},
        .under = a,
        .alsoUnder = b,
        .allowance = allowanceFor(acceptance, shell_.elements,
                                  context_.badness.ofEdge(context_.mesh.lengthOf(a, b)))};
    if (starFromNew(node, plan, acceptance)) return true;
    if (!shell_.isInside) return false;
  }
  return false;
}

/// Returns whether node a may move onto b: its patch or line must contain the edge.
bool AdaptOperations::mayCollapse(NodeId a, NodeId b, TetId element) {
  const Place& from = context_.mesh.node(a).place;
  if (!from.isOnBoundary()) return true;
  if (from.kind == PlaceKind::kFixed) return false;
  const Place& to = context_.mesh.node(b).place;
  if (!to.isOnBoundary()) return false;
  context_.mesh.findShell(a, b, element, shell_);
  if (!shell_.isOnPatches()) return false;
  const SmoothPatchId one = shell_.ends[0].patch();
  const SmoothPatchId other = shell_.ends[1].patch();
  if (from.kind == PlaceKind::kPatch) return one == other;
  return one != other && context_.guide.isOnLine(to, FeatureLineId(from.entity));
}

/// Returns the cost of the edges of the elements in the cavity at a node.
double AdaptOperations::costOfEdgesAt(NodeId node) {
  const AdaptMesh& mesh = context_.mesh;
  double cost = 0.0;
  seen_.clear(mesh.nodes.size());
  seen_.mark(node.index());
  for (const TetId id : cavity_.elements) {
    for (const NodeId other : mesh.element(id).nodes) {
      if (seen_.mark(other.index())) cost += context_.badness.ofEdge(mesh.lengthOf(node, other));
    }
  }
  return cost;
}

bool AdaptOperations::collapseOnto(NodeId a, NodeId b, TetId element, Acceptance acceptance) {
  if (!mayCollapse(a, b, element)) return false;
  AdaptMesh& mesh = context_.mesh;
  mesh.findBall(a, cavity_.elements);
  StarPlan plan{.apex = b, .removed = 1};
  if (mesh.node(a).place.isOnBoundary()) plan.under = a;
  plan.allowance = allowanceFor(acceptance, cavity_.elements, costOfEdgesAt(a));
  if (!cavity_.build(plan)) return false;
  cavity_.evaluate();
  if (acceptance == Acceptance::kLengths && cavity_.longestNew() > kLongestCollapsed) return false;
  return isAccepted(acceptance) && cavity_.commit();
}

/// Finds the nodes of the shell but those of its edge.
void AdaptOperations::findRing(NodeId a, NodeId b) {
  ring_.clear();
  for (const TetId id : shell_.elements) {
    for (const NodeId node : context_.mesh.element(id).nodes) {
      if (node != a && node != b && std::ranges::find(ring_, node) == ring_.end())
        ring_.push_back(node);
    }
  }
}

bool AdaptOperations::removeEdge(NodeId a, NodeId b, TetId element, Acceptance acceptance,
                                 AdaptRandom& random) {
  AdaptMesh& mesh = context_.mesh;
  mesh.findShell(a, b, element, shell_);
  if (shell_.elements.size() > kLargestShell) return false;
  StarPlan plan;
  if (!shell_.isInside) {
    if (!shell_.isOnPatches() || !(shell_.ends[0] == shell_.ends[1])) return false;
    plan.under = a;
    plan.alsoUnder = b;
  }
  findRing(a, b);
  plan.allowance =
      allowanceFor(acceptance, shell_.elements, context_.badness.ofEdge(mesh.lengthOf(a, b)));
  double best = acceptance == Acceptance::kBadness ? kMinGain : kRoundedGain;
  NodeId chosen{};
  for (const NodeId node : ring_) {
    if (!shell_.isInside &&
        !context_.guide.isOnPatch(mesh.node(node).place, shell_.ends[0].patch()))
      continue;
    cavity_.elements = shell_.elements;
    plan.apex = node;
    if (!cavity_.build(plan)) continue;
    double gain = cavity_.worstAfter() - kSwapGain * cavity_.worstBefore();
    if (acceptance != Acceptance::kLengths) cavity_.evaluate();
    if (acceptance == Acceptance::kBadness) gain = cavity_.gain();
    if (acceptance == Acceptance::kAny)
      gain = cavity_.worstAfter() > kMinDisturbed ? 1.0 + random.next() : 0.0;
    if (gain <= best) continue;
    best = gain;
    chosen = node;
  }
  if (chosen.isNone()) return false;
  cavity_.elements = shell_.elements;
  plan.apex = chosen;
  if (!cavity_.build(plan)) return false;
  cavity_.evaluate();
  return cavity_.commit();
}

bool AdaptOperations::swapFace(TetId element, std::size_t corner, Acceptance acceptance) {
  const AdaptElement& at = context_.mesh.element(element);
  if (!at.beyond[corner].isElement()) return false;
  cavity_.elements.assign({element, at.beyond[corner].element()});
  if (!cavity_.build(
          {.apex = at.nodes[corner], .allowance = allowanceFor(acceptance, cavity_.elements, 0.0)}))
    return false;
  cavity_.evaluate();
  const bool isGood = acceptance == Acceptance::kBadness
                          ? cavity_.gain() > kMinGain
                          : cavity_.worstAfter() >= kSwapGain * cavity_.worstBefore();
  return isGood && cavity_.commit();
}

bool AdaptOperations::insert(TetId element) {
  AdaptNode node;
  const AdaptMesh& mesh = context_.mesh;
  for (const NodeId corner : mesh.element(element).nodes) node.point += 0.25 * mesh.point(corner);
  const AdaptNode& first = mesh.node(mesh.element(element).nodes[0]);
  node.at = first.at;
  node.part = first.part;
  cavity_.elements.assign({element});
  return starFromNew(node, {}, Acceptance::kBadness);
}

/// The two faces that come onto the boundary must face as the patch does.
bool AdaptOperations::isPeelGood(const AdaptElement& element) const {
  SmoothPatchId patch{};
  for (const Beyond& beyond : element.beyond) {
    if (beyond.isPatch()) patch = beyond.patch();
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (!element.beyond[k].isElement()) continue;
    // Seen from the outside after the element is gone: the inner side of its face.
    const auto& [i, j, l] = kFaceCorners[k];
    const Vec3& a = context_.mesh.point(element.nodes[i]);
    const Vec3& b = context_.mesh.point(element.nodes[l]);
    const Vec3& c = context_.mesh.point(element.nodes[j]);
    if (!context_.guide.isFacing({a, b, c}, patch, {})) return false;
  }
  return true;
}

bool AdaptOperations::peel(TetId id) {
  AdaptMesh& mesh = context_.mesh;
  const AdaptElement element = mesh.element(id);
  std::array<std::size_t, 4> on{};
  std::array<std::size_t, 4> off{};
  std::size_t onCount = 0;
  std::size_t offCount = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (element.beyond[k].isElement()) {
      off[offCount++] = k;
    } else {
      on[onCount++] = k;
    }
  }
  if (onCount != 2 || !element.beyond[on[0]].isPatch() ||
      !(element.beyond[on[0]] == element.beyond[on[1]]))
    return false;
  const Beyond patch = element.beyond[on[0]];
  for (const NodeId node : element.nodes) {
    if (!context_.guide.isOnPatch(mesh.node(node).place, patch.patch())) return false;
  }
  // The edge opposite the faces of the boundary comes onto it, and must not be there already.
  mesh.findShell(element.nodes[on[0]], element.nodes[on[1]], id, shell_);
  if (!shell_.isInside || !isPeelGood(element)) return false;
  const double removed = mesh.lengthOf(element.nodes[off[0]], element.nodes[off[1]]);
  if (context_.badness.ofElement(element.quality) + context_.badness.ofEdge(removed) < kMinGain)
    return false;
  for (const std::size_t k : {off[0], off[1]}) {
    const TetId beside = element.beyond[k].element();
    AdaptElement& other = mesh.element(beside);
    for (Beyond& beyond : other.beyond) {
      if (beyond == Beyond(id)) beyond = patch;
    }
    for (const NodeId node : other.nodes) mesh.node(node).element = beside;
  }
  const std::array<TetId, 2> beside{element.beyond[off[0]].element(),
                                    element.beyond[off[1]].element()};
  mesh.removeElement(id);
  mesh.touch(beside);
  return true;
}

}  // namespace tetrafront
