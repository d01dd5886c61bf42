#include "adapt/boundary_guide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/sort.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

bool contains(std::span<const std::uint32_t> values, std::uint32_t value) {
  return std::ranges::find(values, value) != values.end();
}

bool bounds(const FeatureLine& line, SmoothPatchId patch) {
  return contains(line.patches, patch.value);
}

/// Returns the index of the segment of a line at an arc.
std::size_t segmentAt(const FeatureLine& line, double arc) {
  const std::vector<double>& arcs = line.arcs();
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(arcs, arc) - arcs.begin());
  return std::min(arcs.size() - 2, std::max<std::size_t>(above, 1) - 1);
}

/// Returns the item lists of nodes as offsets and items, from pairs of node and item in ascending order.
template <class Pair, class Visit>
std::vector<std::uint32_t> listBegins(const std::vector<Pair>& pairs, std::size_t count,
                                      Visit keyOf) {
  std::vector<std::uint32_t> begins(count + 1, 0);
  for (const Pair& pair : pairs) ++begins[keyOf(pair) + 1];
  for (std::size_t i = 0; i < count; ++i) begins[i + 1] += begins[i];
  return begins;
}

/// Returns the position of the plane nearest to another; exact if the plane is normal to an axis.
Vec3 projectedOn(const Vec3& origin, const Vec3& normal, Vec3 position) {
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(normal[k]) != 1.0) continue;
    position[k] = origin[k];
    return position;
  }
  return position - normal * glm::dot(position - origin, normal);
}

}  // namespace

BoundaryGuide::BoundaryGuide(const ReferenceSurface& reference,
                             std::span<const std::uint8_t> isFixed, const TrueBoundary* truth)
    : reference_(reference), truth_(truth), places_(countNodes(reference.mesh())) {
  findFixed(isFixed);
  findLineNodes();
  findNormals();
}

void BoundaryGuide::findFixed(std::span<const std::uint8_t> isFixed) {
  const SurfaceMesh& mesh = reference_.mesh();
  std::uint32_t count = 0;
  for (const NodeId node : IdRange<NodeId>(places_.size())) {
    if (!reference_.isCorner(node) && (isFixed.empty() || isFixed[node.index()] == 0)) continue;
    places_[node.index()] = {.kind = PlaceKind::kFixed, .entity = count++};
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    for (const NodeId node : nodesOf(mesh, t)) {
      Place& place = places_[node.index()];
      if (place.kind == PlaceKind::kFixed) {
        pairs.emplace_back(place.entity, reference_.patchOf(t).value);
      } else if (!place.isOnBoundary()) {
        place = {.kind = PlaceKind::kPatch, .entity = reference_.patchOf(t).value, .near = t};
      }
    }
  }
  sortUnique(pairs);
  patchBegins_ = listBegins(pairs, count, [](const auto& pair) { return pair.first; });
  for (const auto& [fixed, patch] : pairs) fixedPatches_.push_back(patch);
}

void BoundaryGuide::findLineNodes() {
  for (const FeatureLineId id : IdRange<FeatureLineId>(reference_.lines().size())) {
    const FeatureLine& line = reference_.line(id);
    for (std::size_t i = 0; i < line.nodes().size(); ++i) {
      Place& place = places_[line.nodes()[i].index()];
      if (place.kind == PlaceKind::kFixed) {
        lineEnds_.push_back({place.entity, id, line.arcs()[i]});
      } else if (place.kind == PlaceKind::kPatch) {
        place = {.kind = PlaceKind::kLine, .entity = id.value, .arc = line.arcs()[i]};
      }
    }
  }
  stableSort(lineEnds_, [](const LineEnd& a, const LineEnd& b) {
    return std::tie(a.fixed, a.line, a.arc) < std::tie(b.fixed, b.line, b.arc);
  });
  endBegins_ =
      listBegins(lineEnds_, patchBegins_.size() - 1, [](const LineEnd& end) { return end.fixed; });
}

void BoundaryGuide::findNormals() {
  const SurfaceMesh& mesh = reference_.mesh();
  const std::size_t corners = mesh.triangles.size();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> atNode;
  atNode.reserve(corners);
  for (std::uint32_t c = 0; c < corners; ++c) atNode.emplace_back(mesh.triangles[c], c);
  stableSort(atNode);
  normals_.assign(corners, Vec3(0.0));
  const auto begins =
      listBegins(atNode, countNodes(mesh), [](const auto& pair) { return pair.first; });
  for (std::size_t node = 0; node + 1 < begins.size(); ++node) {
    for (std::uint32_t i = begins[node]; i < begins[node + 1]; ++i) {
      const TriangleId own(atNode[i].second / 3);
      for (std::uint32_t k = begins[node]; k < begins[node + 1]; ++k) {
        const TriangleId other(atNode[k].second / 3);
        if (reference_.patchOf(other) != reference_.patchOf(own)) continue;
        const auto [a, b, c] = cornersOf(mesh, other);
        normals_[atNode[i].second] +=
            reference_.normalOf(other) * glm::length(glm::cross(b - a, c - a));
      }
    }
  }
}

bool BoundaryGuide::isOnPatch(const Place& place, SmoothPatchId patch) const {
  switch (place.kind) {
    case PlaceKind::kInside:
      return false;
    case PlaceKind::kPatch:
      return place.entity == patch.value;
    case PlaceKind::kLine:
      return bounds(reference_.line(FeatureLineId(place.entity)), patch);
    case PlaceKind::kFixed:
      return contains(patchesOf(place.entity), patch.value);
  }
  return false;
}

bool BoundaryGuide::isOnLine(const Place& place, FeatureLineId line) const {
  if (place.kind == PlaceKind::kLine) return place.entity == line.value;
  if (place.kind != PlaceKind::kFixed) return false;
  for (std::uint32_t i = endBegins_[place.entity]; i < endBegins_[place.entity + 1]; ++i) {
    if (lineEnds_[i].line == line) return true;
  }
  return false;
}

FeatureLineId BoundaryGuide::commonLine(const Place& a, const Place& b, SmoothPatchId one,
                                        SmoothPatchId other, const Vec3& middle) const {
  if (a.kind != PlaceKind::kFixed && a.kind != PlaceKind::kLine) return {};
  if (a.kind == PlaceKind::kFixed && b.kind == PlaceKind::kLine)
    return commonLine(b, a, one, other, middle);
  const auto fits = [&](FeatureLineId line) {
    return isOnLine(b, line) && bounds(reference_.line(line), one) &&
           bounds(reference_.line(line), other);
  };
  if (a.kind == PlaceKind::kLine) {
    const FeatureLineId line(a.entity);
    return fits(line) ? line : FeatureLineId{};
  }
  FeatureLineId best{};
  double least = std::numeric_limits<double>::max();
  for (std::uint32_t i = endBegins_[a.entity]; i < endBegins_[a.entity + 1]; ++i) {
    const FeatureLineId line = lineEnds_[i].line;
    if (!fits(line)) continue;
    Vec3 at(0.0);
    static_cast<void>(onLine(line, a, b, 0.5, at));
    const double squared = glm::dot(at - middle, at - middle);
    if (squared >= least) continue;
    least = squared;
    best = line;
  }
  return best;
}

double BoundaryGuide::arcOn(FeatureLineId line, const Place& place, double near) const {
  if (place.kind == PlaceKind::kLine) return place.arc;
  double best = near;
  double least = std::numeric_limits<double>::max();
  for (std::uint32_t i = endBegins_[place.entity]; i < endBegins_[place.entity + 1]; ++i) {
    if (lineEnds_[i].line != line) continue;
    const double distance = std::fabs(lineEnds_[i].arc - near);
    if (distance >= least) continue;
    least = distance;
    best = lineEnds_[i].arc;
  }
  return best;
}

Vec3 BoundaryGuide::onTrueLine(FeatureLineId id, double arc, const Vec3& position) const {
  const FeatureLine& line = reference_.line(id);
  const Vec3 foot = line.at(arc);
  return truth_ == nullptr ? foot : truth_->onLine(id, segmentAt(line, arc), foot, position);
}

double BoundaryGuide::sag() const { return truth_ == nullptr ? 0.0 : truth_->sag(); }

Place BoundaryGuide::onLine(FeatureLineId id, const Place& a, const Place& b, double part,
                            Vec3& position) const {
  const FeatureLine& line = reference_.line(id);
  // A fixed node can be both ends of a line.
  const bool isFirstKnown = a.kind == PlaceKind::kLine;
  const double second = arcOn(id, b, isFirstKnown ? a.arc : line.length());
  const double first = arcOn(id, a,
                             isFirstKnown                 ? a.arc
                             : b.kind == PlaceKind::kLine ? b.arc
                                                          : 0.0);
  double way = second - first;
  if (line.isClosed()) {
    if (way > 0.5 * line.length()) way -= line.length();
    if (way < -0.5 * line.length()) way += line.length();
  }
  double arc = first + part * way;
  if (line.isClosed() && arc < 0.0) arc += line.length();
  if (line.isClosed() && arc >= line.length()) arc -= line.length();
  position = onTrueLine(id, arc, line.at(arc));
  return {.kind = PlaceKind::kLine, .entity = id.value, .arc = arc};
}

Place BoundaryGuide::onPatch(SmoothPatchId patch, const Place& hint, Vec3& position) const {
  Place place{.kind = PlaceKind::kPatch, .entity = patch.value, .near = hint.near};
  const bool isHint = !hint.near.isNone() && reference_.patchOf(hint.near) == patch;
  const NearestPoint found =
      reference_.nearest(position, patch, reference_.diagonal(), isHint ? hint.near : TriangleId{});
  if (!found.triangle.isNone()) place.near = found.triangle;
  const SmoothPatch& smooth = reference_.patch(patch);
  if (smooth.isPlanar) {
    position = projectedOn(cornersOf(reference_.mesh(), place.near)[0], smooth.normal, position);
  } else {
    position = truth_ == nullptr ? found.position
                                 : truth_->onPatch(patch, place.near, found.position, position);
  }
  return place;
}

double BoundaryGuide::nearestArc(const FeatureLine& line, const Vec3& position,
                                 double start) const {
  const std::vector<double>& arcs = line.arcs();
  const std::size_t segments = arcs.size() - 1;
  const auto footOn = [&](std::size_t s) {
    const Vec3& a = line.points()[s];
    const Vec3 along = line.points()[s + 1] - a;
    const double t = std::clamp(glm::dot(position - a, along) / glm::dot(along, along), 0.0, 1.0);
    const Vec3 off = a + t * along - position;
    return std::pair(glm::dot(off, off), arcs[s] + t * (arcs[s + 1] - arcs[s]));
  };
  std::size_t at = segmentAt(line, start);
  auto best = footOn(at);
  for (bool goesOn = true; goesOn;) {
    goesOn = false;
    for (const bool isForward : {true, false}) {
      if (!line.isClosed() && at == (isForward ? segments - 1 : 0)) continue;
      const std::size_t next = isForward ? (at + 1) % segments : (at + segments - 1) % segments;
      const auto foot = footOn(next);
      if (foot.first >= best.first) continue;
      best = foot;
      at = next;
      goesOn = true;
    }
  }
  return best.second;
}

bool BoundaryGuide::follow(Place& place, Vec3& position) const {
  if (place.kind == PlaceKind::kInside) return true;
  if (place.kind == PlaceKind::kFixed) return false;
  if (place.kind == PlaceKind::kPatch) {
    place = onPatch(SmoothPatchId(place.entity), place, position);
    return true;
  }
  const FeatureLine& line = reference_.line(FeatureLineId(place.entity));
  place.arc = nearestArc(line, position, place.arc);
  position = onTrueLine(FeatureLineId(place.entity), place.arc, position);
  return line.isClosed() || (place.arc > 0.0 && place.arc < line.length());
}

double BoundaryGuide::cosineToPatch(const std::array<Vec3, 3>& corners, SmoothPatchId patch,
                                    TriangleId hint) const {
  const auto& [a, b, c] = corners;
  const Vec3 normal = glm::cross(b - a, c - a);
  const SmoothPatch& smooth = reference_.patch(patch);
  if (smooth.isPlanar) return glm::dot(normal, smooth.normal) > 0.0 ? 1.0 : -1.0;
  const Vec3 centre = (a + b + c) / 3.0;
  const NearestPoint found = reference_.nearest(centre, patch, reference_.diagonal(), hint);
  const TriangleId t = found.triangle;
  if (t.isNone()) return -1.0;
  const auto [p, q, r] = cornersOf(reference_.mesh(), t);
  const Vec3& own = reference_.normalOf(t);
  const Vec3& at = found.position;
  const auto weight = [&](const Vec3& from, const Vec3& to) {
    return std::max(0.0, glm::dot(glm::cross(from - at, to - at), own));
  };
  const Vec3* const normals = &normals_[3 * t.index()];
  const Vec3 wanted = weight(q, r) * glm::normalize(normals[0]) +
                      weight(r, p) * glm::normalize(normals[1]) +
                      weight(p, q) * glm::normalize(normals[2]);
  const double scale = glm::length(normal) * glm::length(wanted);
  return scale > 0.0 ? glm::dot(normal, wanted) / scale : -1.0;
}

}  // namespace tetrafront
