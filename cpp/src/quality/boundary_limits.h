#pragma once

/// @file Which elements the boundary keeps from having the angles wanted, and by what.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// In the order in which they are looked for; see QualityStatistics for what they mean.
enum class BoundaryLimit : std::uint8_t { kNone, kSharpEdge, kNeedle, kNearSheets };

/// Space as an element sees it: where it wants edges to have length 1.
struct ElementView {
  SymmetricTensor toUnit;
  Vec3 origin;
  [[nodiscard]] Vec3 operator()(const Vec3& place) const { return toUnit * (place - origin); }
};

/// The edges of an element; edge e and edge 5 - e lie opposite each other.
inline constexpr std::array<std::array<std::size_t, 4>, 6> kElementEdges{
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

/// Whether an element with all its corners on the boundary joins two sheets of it that are too near
/// each other for a node between them. `seen`: the corners, where wanted edges have length 1;
/// `joined`: whether each of kElementEdges is an edge of the boundary.
[[nodiscard]] bool joinsNearSheets(const std::array<Vec3, 4>& seen,
                                   const std::array<bool, 6>& joined);

class BoundaryLimits {
 public:
  /// `points`: x y z of the mesh's nodes.
  explicit BoundaryLimits(std::span<const double> points)
      : points_(points), isOnBoundary_(points.size() / 3, 0) {}

  /// A triangle of the boundary, or a wall, turned either way. Those without a node of an element
  /// that is asked for need not be added.
  void add(std::span<const std::uint32_t, 3> triangle);
  /// After the last triangle. O(n log n).
  void finish();

  /// The first limit that applies to an element. O(log n + k) for k triangles at its edges.
  [[nodiscard]] BoundaryLimit limitOf(std::span<const std::uint32_t, 4> nodes,
                                      const ElementView& view) const;

 private:
  /// A triangle's edge, by its lower node.
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
