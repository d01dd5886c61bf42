#include "quality/boundary_limits.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/sort.h"
#include "geom/measure.h"
#include "quality/metrics.h"

namespace tetrafront {
namespace {

constexpr double kMinCosine = 0.8660254037844387;        // cosine of 30 degrees
constexpr double kTwiceLeastCosine = 0.5;                // cosine of 60 degrees
constexpr double kGreatestCosine = -0.7071067811865476;  // cosine of 135 degrees
/// Radius ratio below which a triangle counts as a needle. No triangle forbids good angles by
/// itself, but around a needle few elements can have them. On five graded bodies with a few
/// needles, 26 of the 101 elements at an edge of one missed their angles after all improvements,
/// and 5 of the 48 846 others.
constexpr double kNeedle = 0.3;
/// In target lengths: in a narrower gap, every node between the sheets would be too close to one of
/// them.
constexpr double kNear = 0.6;

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
  return measures.volume == 0.0 || measures.largestCosine > kMinCosine ||
         measures.smallestCosine < kGreatestCosine;
}

}  // namespace

/// Returns whether the boundary's edges divide the corners into two groups that are close to each
/// other.
bool joinsNearSheets(const std::array<Vec3, 4>& seen, const std::array<bool, 6>& joined) {
  constexpr double kSquare = kNear * kNear;
  // Edge e on one sheet, the opposite edge 5 - e on the other.
  for (std::size_t e = 0; e < 3; ++e) {
    const auto& [a, b, c, d] = kElementEdges[e];
    bool apart = joined[e] && joined[5 - e];
    for (std::size_t other = 0; other < kElementEdges.size(); ++other) {
      apart = apart && (other == e || other == 5 - e || !joined[other]);
    }
    if (apart && squaredDistanceOfLines(seen[a], seen[b], seen[c], seen[d]) < kSquare) {
      return true;
    }
  }
  // One node on one sheet, three on the other.
  for (std::size_t k = 0; k < 4; ++k) {
    bool apart = true;
    for (std::size_t e = 0; e < kElementEdges.size(); ++e) {
      apart = apart && (!joined[e] || (kElementEdges[e][0] != k && kElementEdges[e][1] != k));
    }
    if (apart && squaredDistanceToTriangle(seen[k], seen[(k + 1) % 4], seen[(k + 2) % 4],
                                           seen[(k + 3) % 4]) < kSquare) {
      return true;
    }
  }
  return false;
}

void BoundaryLimits::add(std::span<const std::uint32_t, 3> triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = triangle[k];
    const std::uint32_t b = triangle[(k + 1) % 3];
    edges_.push_back({std::min(a, b), std::max(a, b), triangle[(k + 2) % 3]});
    isOnBoundary_[a] = 1;
  }
}

void BoundaryLimits::finish() {
  stableSort(edges_, [](const Edge& p, const Edge& q) {
    return std::tie(p.lower, p.upper, p.third) < std::tie(q.lower, q.upper, q.third);
  });
}

std::span<const BoundaryLimits::Edge> BoundaryLimits::edgesBetween(std::uint32_t a,
                                                                   std::uint32_t b) const {
  const Edge wanted{std::min(a, b), std::max(a, b), 0};
  const auto [first, last] =
      std::equal_range(edges_.begin(), edges_.end(), wanted, [](const Edge& p, const Edge& q) {
        return std::tie(p.lower, p.upper) < std::tie(q.lower, q.upper);
      });
  return {first, last};
}

Vec3 BoundaryLimits::seen(std::uint32_t node, const ElementView& view) const {
  const double* at = &points_[3 * std::size_t{node}];
  return view(Vec3(at[0], at[1], at[2]));
}

/// The triangles at edge a b divide its surroundings into sectors. An element a b c d lies in one
/// of them, which ends at the next triangle beyond c and beyond d. If the sector is smaller than 30
/// degrees, so is the element's angle. If it is smaller than 60, either one element fills it, or
/// some element in it has less than 30 degrees. If that element misses its angles, the edge forces
/// it, or one of the others.
bool BoundaryLimits::isForcedByEdge(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                    std::uint32_t d, const ElementView& view) const {
  const std::span<const Edge> around = edgesBetween(a, b);
  if (around.size() < 2) return false;
  const Vec3 origin = seen(a, view);
  const Vec3 along = seen(b, view) - origin;
  const auto directionOf = [&](std::uint32_t third) { return seen(third, view) - origin; };
  const auto normalOf = [&](std::uint32_t third) {
    return glm::normalize(glm::cross(along, directionOf(third)));
  };
  const Vec3 start = normalOf(c);
  const bool isLeft = glm::dot(start, directionOf(d)) > 0.0;
  struct End {
    std::uint32_t third = 0;
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
  if (space > kMinCosine) return true;
  const bool isTheOne = beyondC.third == c && beyondD.third == d;
  return space > kTwiceLeastCosine && (isTheOne || glm::dot(start, normalOf(d)) > kMinCosine) &&
         misses(Vec3(0.0), along, directionOf(beyondC.third), directionOf(beyondD.third));
}

bool BoundaryLimits::hasEdgeOfNeedle(std::span<const std::uint32_t, 4> nodes,
                                     const ElementView& view) const {
  for (const auto& [a, b, c, d] : kElementEdges) {
    const Vec3 from = seen(nodes[a], view);
    const Vec3 to = seen(nodes[b], view);
    for (const Edge& edge : edgesBetween(nodes[a], nodes[b])) {
      if (triangleRadiusRatio(from, to, seen(edge.third, view)) < kNeedle) return true;
    }
  }
  return false;
}

bool BoundaryLimits::liesBetweenNearSheets(std::span<const std::uint32_t, 4> nodes,
                                           const ElementView& view) const {
  if (std::ranges::any_of(nodes, [&](std::uint32_t node) { return isOnBoundary_[node] == 0; })) {
    return false;
  }
  std::array<Vec3, 4> corners;
  std::array<bool, 6> joined{};
  for (std::size_t k = 0; k < 4; ++k) corners[k] = seen(nodes[k], view);
  for (std::size_t e = 0; e < kElementEdges.size(); ++e) {
    joined[e] = !edgesBetween(nodes[kElementEdges[e][0]], nodes[kElementEdges[e][1]]).empty();
  }
  return joinsNearSheets(corners, joined);
}

BoundaryLimit BoundaryLimits::limitOf(std::span<const std::uint32_t, 4> nodes,
                                      const ElementView& view) const {
  for (const auto& [a, b, c, d] : kElementEdges) {
    if (isForcedByEdge(nodes[a], nodes[b], nodes[c], nodes[d], view)) {
      return BoundaryLimit::kSharpEdge;
    }
  }
  if (hasEdgeOfNeedle(nodes, view)) return BoundaryLimit::kNeedle;
  return liesBetweenNearSheets(nodes, view) ? BoundaryLimit::kNearSheets : BoundaryLimit::kNone;
}

}  // namespace tetrafront
