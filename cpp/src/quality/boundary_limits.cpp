#include "quality/boundary_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/sort.h"
#include "geom/measure.h"
#include "quality/metrics.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

constexpr double kMinAngleCosine = 0.8660254037844387;   // cosine of 30 degrees
constexpr double kTwiceMinAngleCosine = 0.5;             // cosine of 60 degrees
constexpr double kMaxAngleCosine = -0.7071067811865476;  // cosine of 135 degrees
/// Radius ratio below which a triangle counts as a needle. No triangle forbids good angles by
/// itself, but around a needle few elements can have them. On five graded shapes with a few
/// needles, 26 of the 101 elements at an edge of one had angles out of range after all
/// improvements, and 5 of the 48 846 others.
constexpr double kNeedle = 0.3;
/// Width of a gap / target length below which every node inside it would be too close to one of its
/// walls.
constexpr double kNarrow = 0.6;

/// Returns the squared distance between the lines a b and c d.
double squaredDistanceOfLines(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 across = glm::cross(b - a, d - c);
  const double square = glm::dot(across, across);
  if (!(square > 0.0)) return 0.0;
  const double along = glm::dot(across, c - a);
  return along * along / square;
}

/// Returns whether a tetrahedron, in either orientation, has an angle below 30 or above 135
/// degrees.
bool misses(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const TetrahedronMeasures measures = measureTetrahedron(a, b, c, d);
  return measures.volume == 0.0 || measures.largestCosine > kMinAngleCosine ||
         measures.smallestCosine < kMaxAngleCosine;
}

}  // namespace

double squaredGapWidth(const std::array<Vec3, 4>& corners,
                       const std::array<bool, 6>& isBoundaryEdge) {
  double least = std::numeric_limits<double>::infinity();
  // Edge e on one side of the gap, the opposite edge 5 - e on the other.
  for (std::size_t e = 0; e < 3; ++e) {
    const TetEdge& one = kTetEdges[e];
    const TetEdge& other = kTetEdges[5 - e];
    bool apart = isBoundaryEdge[e] && isBoundaryEdge[5 - e];
    for (std::size_t i = 0; i < kTetEdges.size(); ++i) {
      apart = apart && (i == e || i == 5 - e || !isBoundaryEdge[i]);
    }
    if (!apart) continue;
    least = std::min(least, squaredDistanceOfLines(corners[one.from], corners[one.to],
                                                   corners[other.from], corners[other.to]));
  }
  // One node on one side of the gap, three on the other.
  for (std::size_t k = 0; k < 4; ++k) {
    bool apart = true;
    for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
      apart = apart && (!isBoundaryEdge[e] || (kTetEdges[e].from != k && kTetEdges[e].to != k));
    }
    if (!apart) continue;
    least = std::min(least, squaredDistanceToTriangle(corners[k], corners[(k + 1) % 4],
                                                      corners[(k + 2) % 4], corners[(k + 3) % 4]));
  }
  return least;
}

bool spansNarrowGap(const std::array<Vec3, 4>& corners, const std::array<bool, 6>& isBoundaryEdge) {
  return squaredGapWidth(corners, isBoundaryEdge) < kNarrow * kNarrow;
}

void BoundaryLimits::add(const NodeTriple& triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    const NodeId a = triangle[k];
    const NodeId b = triangle[(k + 1) % 3];
    edges_.push_back({std::min(a, b), std::max(a, b), triangle[(k + 2) % 3]});
    isOnBoundary_[a.index()] = 1;
  }
}

void BoundaryLimits::finish() {
  stableSort(edges_, [](const Edge& p, const Edge& q) {
    return std::tie(p.lower, p.upper, p.third) < std::tie(q.lower, q.upper, q.third);
  });
}

std::span<const BoundaryLimits::Edge> BoundaryLimits::edgesBetween(NodeId a, NodeId b) const {
  const Edge key{std::min(a, b), std::max(a, b), NodeId()};
  const auto [first, last] =
      std::equal_range(edges_.begin(), edges_.end(), key, [](const Edge& p, const Edge& q) {
        return std::tie(p.lower, p.upper) < std::tie(q.lower, q.upper);
      });
  return {first, last};
}

Vec3 BoundaryLimits::positionIn(const ElementView& view, NodeId node) const {
  return view(mesh_.pointOf(node));
}

/// The triangles at edge a b divide its surroundings into sectors. An element a b c d lies in one
/// of them, which ends at the next triangle beyond c and beyond d. If the sector is smaller than 30
/// degrees, so is the element's angle. If it is smaller than 60, either one element fills it, or
/// some element in it has less than 30 degrees. If that element misses its angles, the edge forces
/// it, or one of the others.
bool BoundaryLimits::isForcedByEdge(NodeId a, NodeId b, NodeId c, NodeId d,
                                    const ElementView& view) const {
  const std::span<const Edge> around = edgesBetween(a, b);
  if (around.size() < 2) return false;
  const Vec3 origin = positionIn(view, a);
  const Vec3 along = positionIn(view, b) - origin;
  const auto directionOf = [&](NodeId third) { return positionIn(view, third) - origin; };
  const auto normalOf = [&](NodeId third) {
    return glm::normalize(glm::cross(along, directionOf(third)));
  };
  const Vec3 start = normalOf(c);
  const bool isLeft = glm::dot(start, directionOf(d)) > 0.0;
  struct End {
    NodeId third{0U};
    Vec3 normal{0.0};
    double cosine =
        0.0;  ///< cosine of the angle from c; a sharp sector has both ends within a right angle
  };
  End beyondC;
  End beyondD;
  for (const Edge& edge : around) {
    const Vec3 normal = normalOf(edge.third);
    const bool isBeyondD =
        edge.third == d ||
        (edge.third != c && (glm::dot(start, directionOf(edge.third)) > 0.0) == isLeft);
    End& end = isBeyondD ? beyondD : beyondC;
    const double cosine = glm::dot(start, normal);
    if (cosine > end.cosine) end = {edge.third, normal, cosine};
  }
  const double space = glm::dot(beyondC.normal, beyondD.normal);
  if (space > kMinAngleCosine) return true;
  const bool isTheOne = beyondC.third == c && beyondD.third == d;
  return space > kTwiceMinAngleCosine &&
         (isTheOne || glm::dot(start, normalOf(d)) > kMinAngleCosine) &&
         misses(Vec3(0.0), along, directionOf(beyondC.third), directionOf(beyondD.third));
}

bool BoundaryLimits::hasEdgeOfNeedle(const NodeQuad& nodes, const ElementView& view) const {
  for (const TetEdge& ends : kTetEdges) {
    const Vec3 from = positionIn(view, nodes[ends.from]);
    const Vec3 to = positionIn(view, nodes[ends.to]);
    for (const Edge& edge : edgesBetween(nodes[ends.from], nodes[ends.to])) {
      if (triangleRadiusRatio(from, to, positionIn(view, edge.third)) < kNeedle) return true;
    }
  }
  return false;
}

bool BoundaryLimits::liesInNarrowGap(const NodeQuad& nodes, const ElementView& view) const {
  if (std::ranges::any_of(nodes, [&](NodeId node) { return isOnBoundary_[node.index()] == 0; })) {
    return false;
  }
  std::array<Vec3, 4> corners;
  std::array<bool, 6> isBoundaryEdge{};
  for (std::size_t k = 0; k < 4; ++k) corners[k] = positionIn(view, nodes[k]);
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    isBoundaryEdge[e] = !edgesBetween(nodes[kTetEdges[e].from], nodes[kTetEdges[e].to]).empty();
  }
  return spansNarrowGap(corners, isBoundaryEdge);
}

BoundaryLimit BoundaryLimits::limitOf(const NodeQuad& nodes, const ElementView& view) const {
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    const TetEdge& one = kTetEdges[e];
    const TetEdge& other = kTetEdges[5 - e];
    if (isForcedByEdge(nodes[one.from], nodes[one.to], nodes[other.from], nodes[other.to], view)) {
      return BoundaryLimit::kSharpEdge;
    }
  }
  if (hasEdgeOfNeedle(nodes, view)) return BoundaryLimit::kNeedle;
  return liesInNarrowGap(nodes, view) ? BoundaryLimit::kNarrowGap : BoundaryLimit::kNone;
}

}  // namespace tetrafront
