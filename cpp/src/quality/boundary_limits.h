#pragma once

/// @file Finds elements whose angles the boundary limits, and how.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Limits in the order in which they are tested; QualityStatistics describes them.
enum class BoundaryLimit : std::uint8_t { kNone, kSharpEdge, kNeedle, kNearSheets };

/// The metric space of an element, in which its target edge length is 1.
struct ElementView {
  SymmetricTensor toUnit;
  Vec3 origin;
  [[nodiscard]] Vec3 operator()(const Vec3& place) const { return toUnit * (place - origin); }
};

/// The edges of an element; edges e and 5 - e are opposite.
inline constexpr std::array<std::array<std::size_t, 4>, 6> kElementEdges{
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

/// Returns whether an element with all corners on the boundary connects two sheets that are too
/// close for a node between them. `seen` holds the corners in the element's metric space, `joined`
/// whether each of kElementEdges is an edge of the boundary.
[[nodiscard]] bool joinsNearSheets(const std::array<Vec3, 4>& seen,
                                   const std::array<bool, 6>& joined);

class BoundaryLimits {
 public:
  /// `points` holds x y z of the mesh's nodes.
  explicit BoundaryLimits(std::span<const double> points)
      : points_(points), isOnBoundary_(points.size() / 3, 0) {}

  /// Adds a triangle of the boundary or an interface, in either orientation. Triangles without a
  /// node of a tested element may be omitted.
  void add(std::span<const std::uint32_t, 3> triangle);
  /// Call this after the last triangle. O(n log n).
  void finish();

  /// Returns the first limit that applies to an element. O(log n + k) for k triangles at its edges.
  [[nodiscard]] BoundaryLimit limitOf(std::span<const std::uint32_t, 4> nodes,
                                      const ElementView& view) const;

 private:
  /// A triangle's edge, stored with its lower node.
  struct Edge {
    std::uint32_t lower;
    std::uint32_t upper;
    std::uint32_t third;
  };
  [[nodiscard]] std::span<const Edge> edgesBetween(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] Vec3 seen(std::uint32_t node, const ElementView& view) const;
  [[nodiscard]] bool isForcedByEdge(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                    std::uint32_t d, const ElementView& view) const;
  [[nodiscard]] bool hasEdgeOfNeedle(std::span<const std::uint32_t, 4> nodes,
                                     const ElementView& view) const;
  [[nodiscard]] bool liesBetweenNearSheets(std::span<const std::uint32_t, 4> nodes,
                                           const ElementView& view) const;

  std::span<const double> points_;
  std::vector<std::uint8_t> isOnBoundary_;  ///< per node
  std::vector<Edge> edges_;
};

}  // namespace tetrafront
