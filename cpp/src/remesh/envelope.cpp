#include "remesh/envelope.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

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
/// A part counts as beyond an edge only if it extends beyond it by more than this fraction of the
/// distance from the edge to its centroid; less is rounding.
constexpr double kReach = 1e-6;
/// A part is cut only if it extends to both sides of the edge by more than this, relative to the
/// tolerance; less is rounding.
constexpr double kLeastCut = 1e-9;

/// Area / area of the triangle from which a facet is tried before its triangles: only a facet can say that the triangle
/// lies over it as a whole.
constexpr double kWideFacet = 2.0;

struct Part {
  Corners corners;
  TriangleId hint;
};

/// Tries to prove one part by one facet.
class FacetProof {
 public:
  FacetProof(const ReferenceSurface& reference, const Corners& corners, double tolerance)
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
  const Corners& corners_;
  double tolerance_;
  bool isInside_ = true;
  std::optional<Cut> cut_;
};

bool FacetProof::prove(const Facet& facet, const Vec3& centroid, const Vec3& nearest) {
  if (!isNearFacet(facet, corners_, tolerance_)) return false;
  // The centroid must lie over the facet.
  const Vec3 offset = nearest - centroid;
  const Vec3 sideways = offset - facet.normal * glm::dot(offset, facet.normal);
  if (glm::length(sideways) > facet.flatness + kReach * tolerance_) return false;
  const auto& [a, b, c] = corners_;
  const Vec3 low = glm::min(glm::min(a, b), c) - tolerance_;
  const Vec3 high = glm::max(glm::max(a, b), c) + tolerance_;
  const Box box = Box::of(low, high, low);
  return reference_.visitFacetEdges(facet, box, [&](const Vec3& from, const Vec3& to) {
    return staysNear(facet, centroid, from, to);
  });
}

/// Returns false if the part extends beyond the edge of the facet and, there, too far from the
/// edge. The points beyond the edge are in the convex polygon that the line through the edge cuts
/// off.
bool FacetProof::staysNear(const Facet& facet, const Vec3& centroid, const Vec3& from,
                           const Vec3& to) {
  const Vec3 edge = to - from;
  const double length = glm::length(edge);
  const Vec3 outward = glm::cross(edge, facet.normal) / length;
  const double inside = -glm::dot(centroid - from, outward);
  const std::array<double, 3> depth = Cut{from, outward}.depthsOf(corners_);
  const double deepest = std::max({depth[0], depth[1], depth[2]});
  if (deepest <= kReach * inside) return true;
  if (std::min({depth[0], depth[1], depth[2]}) > 0.0) return true;

  double squared = 0.0;
  // Range of the line that the part covers, along the edge.
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
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
  if (squared <= tolerance_ * tolerance_) return true;
  if (std::min(inside, deepest) > kLeastCut * tolerance_) cut_ = Cut{from, outward};
  return false;
}

bool isNear(const ReferenceSurface& reference, const Corners& corners, TriangleId triangle,
            double squaredTolerance) {
  return std::ranges::all_of(corners, [&](const Vec3& corner) {
    return reference.squaredDistance(corner, triangle) <= squaredTolerance;
  });
}

/// The parts that are not proven yet.
class WaitingParts {
 public:
  [[nodiscard]] bool isEmpty() const { return count_ == 0; }
  [[nodiscard]] bool isFull() const { return count_ + 3 > kMaxWaiting; }
  Part pop() { return parts_[--count_]; }
  /// Divides a part at the cut, or else into halves.
  void pushPartsOf(const Part& part, const std::optional<Cut>& cut) {
    if (cut) {
      for (const Corners& piece : divide(part.corners, *cut)) parts_[count_++] = {piece, part.hint};
    } else {
      for (const Corners& half : halvesOf(part.corners)) parts_[count_++] = {half, part.hint};
    }
  }

 private:
  std::array<Part, kMaxWaiting> parts_;
  std::size_t count_ = 0;
};

}  // namespace

bool isNearFacet(const Facet& facet, const Corners& corners, double tolerance) {
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
  Part part{corners, below.triangle};
  NearestPoint nearest = below;
  for (int parts = 0;; ++parts) {
    const Vec3 centroid = (part.corners[0] + part.corners[1] + part.corners[2]) / 3.0;
    if (parts > 0) nearest = reference.nearest(centroid, patch, tolerance, part.hint);
    if (nearest.triangle.isNone()) return {};
    part.hint = nearest.triangle;
    const PatchFacetId id = reference.facetOf(nearest.triangle);
    const Facet& facet = reference.facet(id);
    FacetProof proof(reference, part.corners, tolerance);
    const auto isOver = [&] { return proof.prove(facet, centroid, nearest.position); };
    const auto isNearTriangle = [&] {
      return isNear(reference, part.corners, nearest.triangle, tolerance * tolerance);
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
