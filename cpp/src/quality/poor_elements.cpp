#include "quality/poor_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "base/sort.h"
#include "geom/box.h"
#include "geom/measure.h"
#include "quality/boundary_limits.h"
#include "quality/metrics.h"
#include "topology/mesh_access.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

constexpr double kWedgeAngleCosine = 0.8660254037844387;  // cosine of 30 degrees
/// Angle of a wedge / angle of an element up to which the wedge explains the element.
constexpr double kAnglePerElement = 3.0;
/// The same for the smallest angle of a triangle: the elements around a needle are worse than the needle.
constexpr double kNeedlePerElement = 10.0;
/// Largest smallest angle of a needle, in degrees.
constexpr double kNeedleAngle = 10.0;
/// Width of a gap / distance from an edge times the tangent of its angle, between which the gap belongs to the wedge.
constexpr double kMinWedgeShare = 0.35;
constexpr double kMaxWedgeShare = 2.0;
/// Width of a gap / longest edge above which the gap is not the reason.
constexpr double kWidthPerEdge = 0.6;
/// Cosine of the largest turn of the straight part of an edge, about 3 degrees.
constexpr double kStraightCosine = 0.9986;
/// Size / thickness of one good layer; and its number of elements x thickness^3 / volume: three per prism between
/// equilateral triangles of that size.
constexpr double kGoodSizePerThickness = 4.25;
constexpr double kGoodElements =
    3.0 / (0.4330127018922193 * kGoodSizePerThickness * kGoodSizePerThickness);

/// Of more poor elements, a sample with this many stands for all: in a mesh whose elements overlap, each is near very many edges.
constexpr std::size_t kMaxExplained = 1000;

double tangentOf(double cosine) { return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / cosine; }

double smallestAngleOf(const std::array<Vec3, 3>& corners) {
  double largest = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 u = corners[(k + 1) % 3] - corners[k];
    const Vec3 v = corners[(k + 2) % 3] - corners[k];
    const double lengths = glm::length(u) * glm::length(v);
    largest = std::max(largest, lengths > 0.0 ? glm::dot(u, v) / lengths : 1.0);
  }
  return degreesOf(largest);
}

}  // namespace

PoorElementAnalysis::PoorElementAnalysis(const MeshView& mesh, const SurfaceMesh& surface)
    : mesh_(mesh), surface_(surface), isOnBoundary_(countNodes(mesh), 0) {}

Task<PoorElements> PoorElementAnalysis::analyse(Work& work, std::span<const TetId> elements) {
  PoorElements poor;
  poor.count = static_cast<std::uint32_t>(elements.size());
  if (elements.empty()) co_return poor;
  work.beginPart(0.4);
  findEdges();
  co_await work.yield();
  findWedges();
  co_await work.yield();
  work.beginPart(1.0);
  poor.goodTetrahedra = static_cast<double>(countTetrahedra(mesh_));
  const std::size_t every = (elements.size() + kMaxExplained - 1) / kMaxExplained;
  const auto weight = static_cast<std::uint32_t>(every);
  const std::size_t explained = (elements.size() + every - 1) / every;
  co_await work.forEachBlock(explained, [&](std::size_t first, std::size_t last) {
    for (std::size_t sample = first; sample < last; ++sample) {
      const std::size_t i = sample * every;
      const Reason reason = reasonOf(elements[i]);
      poor.inWedges += reason.reason == PoorReason::kWedge ? weight : 0;
      poor.atNeedles += reason.reason == PoorReason::kTriangle ? weight : 0;
      if (reason.reason == PoorReason::kThickness) {
        poor.inThinPlaces += weight;
        const double volume = measureTetrahedron(cornersOf(mesh_, elements[i])).volume;
        const double cube = reason.value * reason.value * reason.value;
        poor.goodTetrahedra += weight * std::max(0.0, kGoodElements * volume / cube - 1.0);
      }
      if (i == 0) describe(elements[i], reason, poor);
    }
  });
  co_return poor;
}

void PoorElementAnalysis::findEdges() {
  for (const TriangleId t : IdRange<TriangleId>(surface_.triangles.size() / 3)) {
    const NodeTriple nodes = nodesOf(surface_, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [lower, upper] = std::minmax(nodes[k], nodes[(k + 1) % 3]);
      edges_.push_back({lower, upper, t});
      isOnBoundary_[nodes[k].index()] = 1;
    }
  }
  stableSort(edges_, [](const Edge& p, const Edge& q) {
    return std::tie(p.lower, p.upper) < std::tie(q.lower, q.upper);
  });
}

void PoorElementAnalysis::findWedges() {
  for (std::size_t i = 0; i < edges_.size();) {
    std::size_t end = i + 1;
    while (end < edges_.size() && edges_[end].lower == edges_[i].lower &&
           edges_[end].upper == edges_[i].upper)
      ++end;
    for (std::size_t a = i; a < end; ++a) {
      for (std::size_t b = a + 1; b < end; ++b) addWedge(edges_[a], edges_[b], end == i + 2);
    }
    i = end;
  }
  if (wedges_.empty()) return;
  std::vector<Box> boxes;
  smallestTangent_ = std::numeric_limits<double>::infinity();
  for (const Wedge& wedge : wedges_) {
    const Vec3 from = pointOf(mesh_, wedge.from);
    boxes.push_back(Box::of(from, pointOf(mesh_, wedge.to), from));
    smallestTangent_ = std::min(smallestTangent_, tangentOf(wedge.cosine));
    ends_.push_back({wedge.from, wedge.to});
    ends_.push_back({wedge.to, wedge.from});
  }
  wedgeTree_ = BoxTree(std::span<const Box>(boxes));
  stableSort(ends_, [](const WedgeEnd& p, const WedgeEnd& q) {
    return std::tie(p.node, p.other) < std::tie(q.node, q.other);
  });
}

/// Returns the unit vector in the plane of a triangle that leaves its edge at a right angle.
Vec3 PoorElementAnalysis::inwardOf(const Edge& edge, const Vec3& along) const {
  const Vec3 offset = pointOf(mesh_, thirdOf(edge)) - pointOf(mesh_, edge.lower);
  const Vec3 across = offset - along * glm::dot(offset, along);
  const double length = glm::length(across);
  return length > 0.0 ? across / length : Vec3(0.0);
}

NodeId PoorElementAnalysis::thirdOf(const Edge& edge) const {
  for (const NodeId node : nodesOf(surface_, edge.triangle)) {
    if (node != edge.lower && node != edge.upper) return node;
  }
  return edge.lower;
}

/// If only two triangles meet at the edge, the region must be between them: the second one is below the first.
void PoorElementAnalysis::addWedge(const Edge& a, const Edge& b, bool areAlone) {
  const Vec3 edge = pointOf(mesh_, a.upper) - pointOf(mesh_, a.lower);
  const double length = glm::length(edge);
  if (!(length > 0.0)) return;
  const Vec3 ofB = inwardOf(b, edge / length);
  const double cosine = std::min(glm::dot(inwardOf(a, edge / length), ofB), 1.0);
  if (!(cosine > kWedgeAngleCosine)) return;
  const auto [p, q, r] = nodesOf(surface_, a.triangle);
  const Vec3 origin = pointOf(mesh_, p);
  const Vec3 normal = glm::cross(pointOf(mesh_, q) - origin, pointOf(mesh_, r) - origin);
  if (areAlone && glm::dot(ofB, normal) > 0.0) return;
  wedges_.push_back({a.lower, a.upper, cosine});
}

std::span<const PoorElementAnalysis::Edge> PoorElementAnalysis::edgesBetween(NodeId a,
                                                                             NodeId b) const {
  const auto [lower, upper] = std::minmax(a, b);
  const auto [first, last] =
      std::equal_range(edges_.begin(), edges_.end(), Edge{lower, upper, TriangleId()},
                       [](const Edge& p, const Edge& q) {
                         return std::tie(p.lower, p.upper) < std::tie(q.lower, q.upper);
                       });
  return {first, last};
}

PoorElementAnalysis::Reason PoorElementAnalysis::reasonOf(TetId element) const {
  const NodeQuad nodes = nodesOf(mesh_, element);
  const double smallest = degreesOf(measureTetrahedron(cornersOf(mesh_, element)).largestCosine);
  if (const auto wedge = wedgeAt(nodes, smallest)) return *wedge;
  const std::optional<Reason> gap = gapAt(nodes);
  if (const auto needle = needleAt(nodes, smallest)) {
    // The faces at the ends of a wedge have triangles of its angle.
    const bool isOfWedge =
        gap && gap->reason == PoorReason::kWedge && gap->value < kAnglePerElement * needle->value;
    return isOfWedge ? *gap : *needle;
  }
  return gap.value_or(Reason{});
}

/// Returns the sharpest wedge at an edge of the element.
std::optional<PoorElementAnalysis::Reason> PoorElementAnalysis::wedgeAt(const NodeQuad& nodes,
                                                                        double smallest) const {
  std::optional<Reason> found;
  for (const TetEdge& edge : kTetEdges) {
    const Vec3 middle = 0.5 * (pointOf(mesh_, nodes[edge.from]) + pointOf(mesh_, nodes[edge.to]));
    double nearest = std::numeric_limits<double>::min();
    const auto [lower, upper] = std::minmax(nodes[edge.from], nodes[edge.to]);
    if (edgesBetween(lower, upper).empty()) continue;
    wedgeTree_.visitNear(middle, nearest, [&](std::uint32_t item) {
      const Wedge& wedge = wedges_[item];
      if (wedge.from != lower || wedge.to != upper) return;
      const double angle = degreesOf(wedge.cosine);
      if (angle > kAnglePerElement * smallest) return;
      if (!found || angle < found->value) found = Reason{PoorReason::kWedge, angle, item};
    });
  }
  return found;
}

/// Returns the triangle with the smallest angle of those with an edge of the element.
std::optional<PoorElementAnalysis::Reason> PoorElementAnalysis::needleAt(const NodeQuad& nodes,
                                                                         double smallest) const {
  std::optional<Reason> found;
  for (const TetEdge& ends : kTetEdges) {
    for (const Edge& edge : edgesBetween(nodes[ends.from], nodes[ends.to])) {
      const NodeTriple corners = nodesOf(surface_, edge.triangle);
      const double angle = smallestAngleOf(
          {pointOf(mesh_, corners[0]), pointOf(mesh_, corners[1]), pointOf(mesh_, corners[2])});
      if (angle > std::min(kNeedleAngle, kNeedlePerElement * smallest)) continue;
      if (!found || angle < found->value) {
        found = Reason{PoorReason::kTriangle, angle, 0};
      }
    }
  }
  return found;
}

/// Returns the reason between two pieces of the boundary: a wedge, where they come together nearby, or thickness.
std::optional<PoorElementAnalysis::Reason> PoorElementAnalysis::gapAt(const NodeQuad& nodes) const {
  std::array<Vec3, 4> corners;
  std::array<bool, 6> isBoundaryEdge{};
  double longest = 0.0;
  std::size_t onBoundary = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    onBoundary += isOnBoundary_[nodes[k].index()];
    corners[k] = pointOf(mesh_, nodes[k]);
  }
  if (onBoundary < 3) return {};
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    const TetEdge& edge = kTetEdges[e];
    isBoundaryEdge[e] = !edgesBetween(nodes[edge.from], nodes[edge.to]).empty();
    longest = std::max(longest, glm::length(corners[edge.to] - corners[edge.from]));
  }
  const double width = onBoundary == 4 ? std::sqrt(squaredGapWidth(corners, isBoundaryEdge))
                                       : std::numeric_limits<double>::infinity();
  const Vec3 centroid = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  if (const auto wedge = wedgeNear(centroid, width, longest)) return wedge;
  if (!(width > 0.0 && width < kWidthPerEdge * longest)) return {};
  return Reason{PoorReason::kThickness, width, 0};
}

/// Returns the wedge around a position, if its faces are nearer to each other there than the element is long. `width`: distance
/// of the faces, if known; otherwise infinity.
std::optional<PoorElementAnalysis::Reason> PoorElementAnalysis::wedgeNear(const Vec3& position,
                                                                          double width,
                                                                          double longest) const {
  if (wedges_.empty()) return {};
  const double reach = kWidthPerEdge * longest / smallestTangent_;
  double nearest = reach * reach;
  std::optional<std::uint32_t> found;
  wedgeTree_.visitNear(position, nearest, [&](std::uint32_t item) {
    const Wedge& wedge = wedges_[item];
    const Vec3 point =
        nearestPointOfSegment(position, pointOf(mesh_, wedge.from), pointOf(mesh_, wedge.to));
    const double square = glm::dot(point - position, point - position);
    if (square >= nearest) return;
    nearest = square;
    found = item;
  });
  if (!found) return {};
  const double cosine = wedges_[*found].cosine;
  const double expected = std::sqrt(nearest) * tangentOf(cosine);
  if (expected > kWidthPerEdge * longest || width < kMinWedgeShare * expected) return {};
  if (std::isfinite(width) && width > kMaxWedgeShare * expected) return {};
  return Reason{PoorReason::kWedge, degreesOf(cosine), *found};
}

/// Returns the position farthest along edges of wedges that continue in a direction.
Vec3 PoorElementAnalysis::farthestAlong(NodeId start, const Vec3& direction) const {
  NodeId node = start;
  for (std::size_t steps = 0; steps < ends_.size(); ++steps) {
    const auto [first, last] =
        std::equal_range(ends_.begin(), ends_.end(), WedgeEnd{node, NodeId()},
                         [](const WedgeEnd& p, const WedgeEnd& q) { return p.node < q.node; });
    const auto next = std::find_if(first, last, [&](const WedgeEnd& end) {
      const Vec3 edge = pointOf(mesh_, end.other) - pointOf(mesh_, node);
      return glm::dot(edge, direction) > kStraightCosine * glm::length(edge);
    });
    if (next == last) break;
    node = next->other;
  }
  return pointOf(mesh_, node);
}

std::array<Vec3, 2> PoorElementAnalysis::straightPart(const Wedge& wedge) const {
  const Vec3 direction = glm::normalize(pointOf(mesh_, wedge.to) - pointOf(mesh_, wedge.from));
  return {farthestAlong(wedge.from, -direction), farthestAlong(wedge.to, direction)};
}

void PoorElementAnalysis::describe(TetId element, const Reason& reason, PoorElements& poor) const {
  const std::array<Vec3, 4> corners = cornersOf(mesh_, element);
  const TetrahedronMeasures measures = measureTetrahedron(corners);
  poor.worst.tetrahedron = element.value;
  poor.worst.centroid = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  poor.worst.volume = measures.volume;
  poor.worst.smallestDihedral = degreesOf(measures.largestCosine);
  poor.worst.largestDihedral = degreesOf(measures.smallestCosine);
  poor.worst.radiusRatio = measures.radiusRatio;
  poor.reason = reason.reason;
  poor.value = reason.value;
  if (reason.reason == PoorReason::kThickness) poor.goodSize = kGoodSizePerThickness * reason.value;
  if (reason.reason != PoorReason::kWedge) return;
  const Wedge& wedge = wedges_[reason.item];
  const std::array<Vec3, 2> ends = straightPart(wedge);
  poor.edgeFrom = ends[0];
  poor.edgeTo = ends[1];
}

}  // namespace tetrafront
