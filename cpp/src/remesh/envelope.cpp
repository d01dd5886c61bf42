#include "remesh/envelope.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "geom/box.h"
#include "geom/measure.h"
#include "remesh/triangle_parts.h"

namespace tetrafront {
namespace {

using Corners = TriangleCorners;

/// Largest number of parts of one triangle. A triangle that needs more is nearly out of tolerance,
/// or covers very many facets.
constexpr int kMaxParts = 300;
constexpr std::size_t kMaxWaiting = 64;
/// Every cut adds one corner to a part. A part that would have more is divided into halves.
constexpr std::size_t kMaxCorners = 8;
/// A part counts as beyond an edge only if it extends beyond it by more than this fraction of the
/// distance from the edge to its centroid; less is rounding.
constexpr double kReach = 1e-6;
/// A part is cut only if it extends to both sides of the edge by more than this, relative to the
/// tolerance; less is rounding.
constexpr double kMinCut = 1e-9;

/// Area / area of the triangle from which a facet is tried before its triangles: only a facet can say that the triangle
/// lies over it as a whole.
constexpr double kWideFacet = 2.0;

/// A convex part of the triangle, and a given triangle that may be near.
struct Part {
  std::array<Vec3, kMaxCorners> corners;
  std::size_t count;
  TriangleId hint;

  [[nodiscard]] std::span<const Vec3> polygon() const { return {corners.data(), count}; }
};

/// Writes the depths of the corners beyond a plane to `depth`; returns the least and the largest one.
std::pair<double, double> depthsOf(std::span<const Vec3> corners, const Cut& cut,
                                   std::array<double, kMaxCorners>& depth) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    depth[k] = glm::dot(corners[k] - cut.origin, cut.outward);
    least = std::min(least, depth[k]);
    most = std::max(most, depth[k]);
  }
  return {least, most};
}

/// Tries to prove one part by one facet.
class FacetProof {
 public:
  FacetProof(const ReferenceSurface& reference, std::span<const Vec3> corners, double tolerance)
      : reference_(reference), corners_(corners), tolerance_(tolerance) {}

  /// Returns true if the part is proven. Otherwise, cut() may say where to divide it.
  bool prove(const Facet& facet, const Vec3& centroid, const Vec3& nearest);
  /// After success: true if no point of the part is beyond an edge of the facet.
  [[nodiscard]] bool isInside() const { return isInside_; }
  /// The edge at which the part leaves the facet, if it is worth dividing there.
  [[nodiscard]] const std::optional<Cut>& cut() const { return cut_; }

 private:
  [[nodiscard]] bool staysNear(const Facet& facet, const Vec3& centroid, const Vec3& from,
                               const Vec3& to);

  const ReferenceSurface& reference_;
  std::span<const Vec3> corners_;
  double tolerance_;
  bool isNear_ = false;
  bool isInside_ = true;
  std::optional<Cut> cut_;
  double deepestCut_ = 0.0;
};

bool FacetProof::prove(const Facet& facet, const Vec3& centroid, const Vec3& nearest) {
  isNear_ = isNearFacet(facet, corners_, tolerance_);
  // The centroid must lie over the facet.
  const Vec3 offset = nearest - centroid;
  const Vec3 sideways = offset - facet.normal * glm::dot(offset, facet.normal);
  if (glm::length(sideways) > facet.flatness + kReach * tolerance_) return false;
  Vec3 low = corners_[0];
  Vec3 high = corners_[0];
  for (const Vec3& corner : corners_) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  low -= tolerance_;
  const Box box = Box::of(low, high + tolerance_, low);
  const bool staysNearEdges = reference_.visitFacetEdges(
      facet, box,
      [&](const Vec3& from, const Vec3& to) { return staysNear(facet, centroid, from, to); });
  return staysNearEdges && isNear_;
}

/// Returns false if the part extends beyond the edge of the facet and, there, too far from the edge. If the part is too far
/// from the plane of the facet, only looks for the best cut. The points beyond the edge are in the convex polygon that the
/// line through the edge cuts off.
bool FacetProof::staysNear(const Facet& facet, const Vec3& centroid, const Vec3& from,
                           const Vec3& to) {
  const Vec3 edge = to - from;
  const double length = glm::length(edge);
  const Vec3 outward = glm::cross(edge, facet.normal) / length;
  const double inside = -glm::dot(centroid - from, outward);
  std::array<double, kMaxCorners> depth;
  const auto [least, deepest] = depthsOf(corners_, {from, outward}, depth);
  if (deepest <= kReach * inside) return true;
  if (least > 0.0) return true;

  double squared = 0.0;
  // Range of the line that the part covers, along the edge.
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const std::size_t l = k + 1 < corners_.size() ? k + 1 : 0;
    if (depth[k] > 0.0) {
      squared = std::max(squared, squaredDistanceToSegment(corners_[k], from, to));
    }
    if ((depth[k] > 0.0) == (depth[l] > 0.0)) continue;
    const Vec3 crossing =
        corners_[k] + (corners_[l] - corners_[k]) * (depth[k] / (depth[k] - depth[l]));
    squared = std::max(squared, squaredDistanceToSegment(crossing, from, to));
    const double along = glm::dot(crossing - from, edge) / length;
    first = std::min(first, along);
    last = std::max(last, along);
  }
  if (last < 0.0 || first > length) return true;
  isInside_ = false;
  // If the centroid is beyond the line, paths from it through the edge enter the facet.
  if (inside <= 0.0) return true;
  if (isNear_ && squared <= tolerance_ * tolerance_) return true;
  if (std::min(inside, deepest) > kMinCut * tolerance_ && deepest > deepestCut_) {
    cut_ = Cut{from, outward};
    deepestCut_ = deepest;
  }
  return !isNear_;
}

Vec3 meanOf(std::span<const Vec3> corners) {
  Vec3 sum(0.0);
  for (const Vec3& corner : corners) sum += corner;
  return sum / static_cast<double>(corners.size());
}

bool isNear(const ReferenceSurface& reference, std::span<const Vec3> corners, TriangleId triangle,
            double squaredTolerance) {
  return std::ranges::all_of(corners, [&](const Vec3& corner) {
    return reference.squaredDistance(corner, triangle) <= squaredTolerance;
  });
}

/// The parts that are not proven yet.
class WaitingParts {
 public:
  [[nodiscard]] bool isEmpty() const { return count_ == 0; }
  [[nodiscard]] bool isFull() const { return count_ + 2 > kMaxWaiting; }
  [[nodiscard]] Part pop() {
    const Polygon& last = polygons_[--count_];
    return {last.corners, last.count, TriangleId(last.hint)};
  }
  /// Divides a part at the cut, or else into halves.
  void pushPartsOf(const Part& part, const std::optional<Cut>& cut) {
    std::array<double, kMaxCorners> depth;
    if (cut) depthsOf(part.polygon(), *cut, depth);
    if (cut && part.count < kMaxCorners && countCrossings(part, depth) == 2) {
      pushSides(part, depth);
    } else {
      pushHalves(part);
    }
  }

 private:
  /// A Part without default values: writing them would take longer than most proofs.
  struct Polygon {
    std::array<Vec3, kMaxCorners> corners;
    std::size_t count;
    std::uint32_t hint;
  };

  Polygon& push(TriangleId hint) {
    Polygon& polygon = polygons_[count_++];
    polygon.count = 0;
    polygon.hint = hint.value;
    return polygon;
  }
  static void add(Polygon& polygon, const Vec3& corner) {
    polygon.corners[polygon.count++] = corner;
  }

  /// Returns how many edges of the part cross the cut: two, unless corners that nearly coincide lie on the wrong side of
  /// the cut by rounding.
  static std::size_t countCrossings(const Part& part,
                                    const std::array<double, kMaxCorners>& depth) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < part.count; ++k) {
      if ((depth[k] > 0.0) != (depth[(k + 1) % part.count] > 0.0)) ++count;
    }
    return count;
  }

  /// Each side has at most one corner more than the part.
  void pushSides(const Part& part, const std::array<double, kMaxCorners>& depth) {
    Polygon& inside = push(part.hint);
    Polygon& beyond = push(part.hint);
    for (std::size_t k = 0; k < part.count; ++k) {
      const std::size_t l = k + 1 < part.count ? k + 1 : 0;
      const bool isBeyond = depth[k] > 0.0;
      add(isBeyond ? beyond : inside, part.corners[k]);
      if (isBeyond == (depth[l] > 0.0)) continue;
      const Vec3 crossing = part.corners[k] + (part.corners[l] - part.corners[k]) *
                                                  (depth[k] / (depth[k] - depth[l]));
      add(inside, crossing);
      add(beyond, crossing);
    }
  }

  void pushHalves(const Part& part) {
    if (part.count == 3) {
      for (const Corners& half : halvesOf({part.corners[0], part.corners[1], part.corners[2]})) {
        Polygon& polygon = push(part.hint);
        for (const Vec3& corner : half) add(polygon, corner);
      }
      return;
    }
    // Two parts with about the same number of corners.
    const std::size_t middle = part.count / 2;
    Polygon& first = push(part.hint);
    for (std::size_t k = 0; k <= middle; ++k) add(first, part.corners[k]);
    Polygon& second = push(part.hint);
    for (std::size_t k = middle; k < part.count; ++k) add(second, part.corners[k]);
    add(second, part.corners[0]);
  }

  std::array<Polygon, kMaxWaiting> polygons_;
  std::size_t count_ = 0;
};

}  // namespace

bool isNearFacet(const Facet& facet, std::span<const Vec3> corners, double tolerance) {
  // The normal of a sliver may be unknown.
  if (facet.normal == Vec3(0.0)) return false;
  return std::ranges::all_of(corners, [&](const Vec3& corner) {
    const double height = std::fabs(glm::dot(corner - facet.origin, facet.normal));
    return height + facet.flatness <= tolerance;
  });
}

EnvelopeProof proveWithin(const ReferenceSurface& reference, const Corners& corners,
                          SmoothPatchId patch, double tolerance, const NearestPoint& below) {
  WaitingParts waiting;
  Part part{{corners[0], corners[1], corners[2]}, 3, below.triangle};
  NearestPoint nearest = below;
  for (int parts = 0;; ++parts) {
    const Vec3 centroid = meanOf(part.polygon());
    if (parts > 0) nearest = reference.nearest(centroid, patch, tolerance, part.hint);
    if (nearest.triangle.isNone()) return {};
    part.hint = nearest.triangle;
    const PatchFacetId id = reference.facetOf(nearest.triangle);
    const Facet& facet = reference.facet(id);
    FacetProof proof(reference, part.polygon(), tolerance);
    const auto isOver = [&] { return proof.prove(facet, centroid, nearest.position); };
    const auto isNearTriangle = [&] {
      return isNear(reference, part.polygon(), nearest.triangle, tolerance * tolerance);
    };
    if (parts == 0 && facet.area > kWideFacet * areaOf(corners)) {
      if (isOver()) return {true, proof.isInside() ? id : PatchFacetId{}};
      if (isNearTriangle()) return {true, {}};
      waiting.pushPartsOf(part, proof.cut());
    } else if (!isNearTriangle() && !isOver()) {
      if (parts >= kMaxParts || waiting.isFull()) return {};
      waiting.pushPartsOf(part, proof.cut());
    }
    if (waiting.isEmpty()) return {true, {}};
    part = waiting.pop();
  }
}

}  // namespace tetrafront
