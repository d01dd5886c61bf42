#include "adapt/cavity.h"

#include <algorithm>

#include "adapt/rules.h"

namespace tetrafront {
namespace {

constexpr std::size_t kLargestGrown = 60;
constexpr int kGrowthRounds = 7;

bool hasNode(const NodeTriple& face, NodeId node) {
  return face[0] == node || face[1] == node || face[2] == node;
}

}  // namespace

Cavity::HullKind Cavity::kindOf(const NodeTriple& nodes, Beyond beyond,
                                const StarPlan& plan) const {
  if (hasNode(nodes, plan.apex)) return HullKind::kAtApex;
  const bool isUnder = beyond.isPatch() && !plan.under.isNone() && hasNode(nodes, plan.under) &&
                       (plan.alsoUnder.isNone() || hasNode(nodes, plan.alsoUnder));
  return isUnder ? HullKind::kUnder : HullKind::kStarred;
}

/// Returns false if the hull cannot be starred. `hasGrown`: an element was added, so the hull is not complete.
bool Cavity::collectHull(const StarPlan& plan, bool& hasGrown) {
  hull_.clear();
  made_.clear();
  worstAfter_ = 2.0;
  hasGrown = false;
  double cost = 0.0;
  const std::size_t count = elements.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const AdaptElement& element = mesh_.element(elements[i]);
      const Beyond beyond = element.beyond[k];
      if (beyond.isElement() && isTaken(beyond.element())) continue;
      const auto& [a, b, c] = kFaceCorners[k];
      const NodeTriple nodes{element.nodes[a], element.nodes[c], element.nodes[b]};
      const HullKind kind = kindOf(nodes, beyond, plan);
      hull_.push_back({nodes, beyond, kind, static_cast<std::uint32_t>(made_.size())});
      if (kind != HullKind::kStarred) continue;
      const NodeQuad corners{nodes[0], nodes[1], nodes[2], plan.apex};
      const double quality = mesh_.qualityOf(corners);
      if (quality < kFlatQuality) {
        if (!plan.mayGrow || !beyond.isElement() || elements.size() > kLargestGrown) return false;
        elements.push_back(beyond.element());
        taken_.mark(beyond.element().index());
        hasGrown = true;
      }
      cost += badness_.ofElement(quality);
      if (!hasGrown && cost > plan.allowance) return false;
      made_.push_back({corners, quality});
      worstAfter_ = std::min(worstAfter_, quality);
    }
  }
  return true;
}

bool Cavity::build(const StarPlan& plan) {
  apex_ = plan.apex;
  taken_.clear(mesh_.elements.size());
  for (const TetId id : elements) taken_.mark(id.index());
  StarPlan own = plan;
  bool hasGrown = true;
  for (int round = 0; hasGrown; ++round) {
    if (round > kGrowthRounds || !collectHull(own, hasGrown)) return false;
    own.allowance = kForbidden;
  }
  return !made_.empty() && keepsNodes(plan);
}

bool Cavity::keepsNodes(const StarPlan& plan) {
  const auto countNew = [this](const NodeQuad& nodes) {
    std::uint32_t count = 0;
    for (const NodeId node : nodes) count += seen_.mark(node.index()) ? 1 : 0;
    return count;
  };
  std::uint32_t before = mesh_.node(plan.apex).element.isNone() ? 1 : 0;
  seen_.clear(mesh_.nodes.size());
  for (const TetId id : elements) before += countNew(mesh_.element(id).nodes);
  std::uint32_t after = 0;
  seen_.clear(mesh_.nodes.size());
  for (const NewElement& element : made_) after += countNew(element.nodes);
  return before == after + plan.removed;
}

void Cavity::evaluate() {
  edges_.clear();
  worstBefore_ = 2.0;
  change_ = 0.0;
  longestNew_ = 0.0;
  for (const TetId id : elements) {
    const AdaptElement& element = mesh_.element(id);
    worstBefore_ = std::min(worstBefore_, element.quality);
    change_ -= badness_.ofElement(element.quality);
    for (const TetEdge& e : kTetEdges)
      edges_(element.nodes[e.from], element.nodes[e.to]).isOld = true;
  }
  for (const NewElement& element : made_) {
    change_ += badness_.ofElement(element.quality);
    for (const TetEdge& e : kTetEdges)
      edges_(element.nodes[e.from], element.nodes[e.to]).isNew = true;
  }
  for (const HullFace& face : hull_) {
    if (face.kind != HullKind::kAtApex || !face.beyond.isElement()) continue;
    for (std::size_t j = 0; j < 3; ++j) edges_(face.nodes[j], face.nodes[(j + 1) % 3]).isNew = true;
  }
  for (const auto& [low, high, state] : edges_.entries()) {
    if (state.isOld == state.isNew) continue;
    const double length = mesh_.lengthOf(low, high);
    const double cost = badness_.ofEdge(length);
    change_ += state.isNew ? cost : -cost;
    if (state.isNew) longestNew_ = std::max(longestNew_, length);
  }
}

/// A new edge at the apex must not exist elsewhere, as it can beside a concave boundary: the mesh would be pinched.
bool Cavity::keepsLinks() {
  if (mesh_.node(apex_).element.isNone()) return true;
  mesh_.findBall(apex_, ball_);
  seen_.clear(mesh_.nodes.size());
  for (const TetId id : ball_) {
    if (isTaken(id)) continue;
    for (const NodeId node : mesh_.element(id).nodes) seen_.mark(node.index());
  }
  for (const NewElement& element : made_) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (seen_.has(element.nodes[j].index()) && !edges_(element.nodes[j], apex_).isOld)
        return false;
    }
  }
  return true;
}

/// The starred part of the hull must be a disc, or a sphere if it is the whole hull. The Euler characteristic
/// (nodes - edges + faces) is 1 for a disc and 2 for a sphere.
bool Cavity::isDisc() {
  seen_.clear(mesh_.nodes.size());
  std::size_t nodes = 0;
  for (const NewElement& element : made_) {
    for (std::size_t j = 0; j < 3; ++j) nodes += seen_.mark(element.nodes[j].index()) ? 1 : 0;
  }
  std::size_t edges = 0;
  for (const auto& [low, high, rim] : rims_.entries()) {
    const bool first = hull_[rim.faces[0]].kind == HullKind::kStarred;
    const bool second = rim.count > 1 && hull_[rim.faces[1]].kind == HullKind::kStarred;
    edges += first || second ? 1 : 0;
  }
  const std::size_t characteristic = made_.size() == hull_.size() ? 2 : 1;
  return nodes + made_.size() == edges + characteristic;
}

/// Returns whether a new face of the boundary, over an edge of a replaced one, lies on its patch.
bool Cavity::isNewFaceValid(const HullFace& under, std::size_t corner) const {
  // Counter-clockwise as seen from outside the mesh.
  const NodeId from = under.nodes[(corner + 2) % 3];
  const NodeId to = under.nodes[(corner + 1) % 3];
  const SmoothPatchId patch = under.beyond.patch();
  for (const NodeId node : {from, to, apex_}) {
    if (!guide_.isOnPatch(mesh_.node(node).place, patch)) return false;
  }
  TriangleId hint{};
  for (const NodeId node : {from, to, apex_}) {
    const Place& place = mesh_.node(node).place;
    if (place.kind == PlaceKind::kPatch) hint = place.near;
  }
  return guide_.isFacing({mesh_.point(from), mesh_.point(to), mesh_.point(apex_)}, patch, hint);
}

bool Cavity::isRimValid(const Rim& rim) const {
  const HullFace* first = &hull_[rim.faces[0]];
  if (rim.count == 1)
    return first->kind == HullKind::kUnder ||
           (first->kind == HullKind::kAtApex && !first->beyond.isElement());
  if (rim.count > 2) return false;
  const HullFace* second = &hull_[rim.faces[1]];
  std::size_t corner = rim.corners[1];
  if (first->kind > second->kind) {
    std::swap(first, second);
    corner = rim.corners[0];
  }
  const bool isNewFace = first->kind == HullKind::kStarred ||
                         (first->kind == HullKind::kAtApex && first->beyond.isElement());
  if (isNewFace && second->kind == HullKind::kUnder) return isNewFaceValid(*second, corner);
  // Two faces at the apex would lie on each other.
  return !(first->kind == HullKind::kAtApex && second->kind == HullKind::kAtApex &&
           (first->beyond.isElement() || second->beyond.isElement()));
}

/// Pairs the hull faces at their edges. Edges at the apex are left out. Returns false if a pair is not possible.
bool Cavity::matchRims() {
  rims_.clear();
  for (std::uint32_t i = 0; i < hull_.size(); ++i) {
    const HullFace& face = hull_[i];
    for (std::uint8_t j = 0; j < 3; ++j) {
      if (face.kind == HullKind::kAtApex && face.nodes[j] != apex_) continue;
      Rim& rim = rims_(face.nodes[(j + 1U) % 3], face.nodes[(j + 2U) % 3]);
      if (rim.count < 2) {
        rim.faces[rim.count] = i;
        rim.corners[rim.count] = j;
      }
      ++rim.count;
    }
  }
  return std::ranges::all_of(rims_.entries(),
                             [this](const auto& entry) { return isRimValid(entry.value); });
}

void Cavity::relink(Beyond outside, const NodeTriple& face, Beyond to) {
  if (!outside.isElement()) return;
  AdaptElement& element = mesh_.element(outside.element());
  for (std::size_t k = 0; k < 4; ++k) {
    if (hasNode(face, element.nodes[k])) continue;
    element.beyond[k] = to;
    break;
  }
  for (const NodeId node : face) mesh_.node(node).element = outside.element();
}

void Cavity::makeElements() {
  for (const TetId id : elements) {
    for (const NodeId node : mesh_.element(id).nodes) mesh_.node(node).element = TetId();
  }
  for (const HullFace& face : hull_) {
    if (face.kind != HullKind::kStarred) continue;
    const NewElement& made = made_[face.item];
    const TetId id = ids_[face.item];
    AdaptElement& element = mesh_.element(id);
    element.nodes = made.nodes;
    element.beyond = {Beyond(), Beyond(), Beyond(), face.beyond};
    element.quality = made.quality;
    element.tried = 0;
    relink(face.beyond, face.nodes, Beyond(id));
  }
}

void Cavity::linkRims() {
  for (const auto& [low, high, rim] : rims_.entries()) {
    if (rim.count < 2) continue;
    std::size_t first = 0;
    if (hull_[rim.faces[0]].kind > hull_[rim.faces[1]].kind) first = 1;
    const HullFace& a = hull_[rim.faces[first]];
    const HullFace& b = hull_[rim.faces[1 - first]];
    if (a.kind == HullKind::kStarred) {
      const TetId own = ids_[a.item];
      Beyond& beyond = mesh_.element(own).beyond[rim.corners[first]];
      if (b.kind == HullKind::kStarred) {
        beyond = Beyond(ids_[b.item]);
        mesh_.element(ids_[b.item]).beyond[rim.corners[1 - first]] = Beyond(own);
      } else {
        beyond = b.beyond;
        if (b.kind == HullKind::kAtApex) relink(b.beyond, b.nodes, Beyond(own));
      }
    } else if (a.kind == HullKind::kAtApex && b.kind == HullKind::kUnder) {
      relink(a.beyond, a.nodes, b.beyond);
    }
  }
}

bool Cavity::commit() {
  if (!keepsLinks() || !matchRims() || !isDisc()) return false;
  ids_.clear();
  for (std::size_t i = 0; i < made_.size(); ++i) ids_.push_back(mesh_.addElement());
  makeElements();
  linkRims();
  for (const TetId id : elements) mesh_.removeElement(id);
  for (const TetId id : ids_) {
    for (const NodeId node : mesh_.element(id).nodes) mesh_.node(node).element = id;
  }
  mesh_.touch(ids_);
  return true;
}

}  // namespace tetrafront
