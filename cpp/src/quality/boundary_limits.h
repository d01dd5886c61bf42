#pragma once

/// @file Finds elements whose angles the boundary limits, and how.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "field/size_tensor.h"
#include "tetrafront/vec3.h"
#include "topology/mesh_view.h"

namespace tetrafront {

/// Limits in the order in which they are tested; QualityStatistics describes them.
enum class BoundaryLimit : std::uint8_t { kNone, kSharpEdge, kNeedle, kNarrowGap };

/// The metric space of an element, in which its target edge length is 1.
struct ElementView {
  SymmetricTensor toUnit;
  Vec3 origin;
  [[nodiscard]] Vec3 operator()(const Vec3& position) const { return toUnit * (position - origin); }
};

/// Returns the squared width of the gap that an element with all corners on the boundary spans, if it connects two pieces of the
/// boundary that share none of its edges; otherwise infinity. `isBoundaryEdge` says which of kTetEdges are edges of the boundary.
[[nodiscard]] double squaredGapWidth(const std::array<Vec3, 4>& corners,
                                     const std::array<bool, 6>& isBoundaryEdge);

/// Returns whether an element with all corners on the boundary connects two pieces of it that are
/// too close for a node between them. `corners` are positions in the element's metric space.
[[nodiscard]] bool spansNarrowGap(const std::array<Vec3, 4>& corners,
                                  const std::array<bool, 6>& isBoundaryEdge);

class BoundaryLimits {
 public:
  explicit BoundaryLimits(const MeshView& mesh) : mesh_(mesh), isOnBoundary_(mesh.nodeCount(), 0) {}

  /// Adds a triangle of the boundary or an interface, in either orientation. Triangles without a
  /// node of a tested element may be omitted.
  void add(const NodeTriple& triangle);
  /// Call this after the last triangle. O(n log n).
  void finish();

  /// Returns the first limit that applies to an element. O(log n + k) for k triangles at its edges.
  [[nodiscard]] BoundaryLimit limitOf(const NodeQuad& nodes, const ElementView& view) const;

 private:
  /// A triangle's edge, stored with its lower node.
  struct Edge {
    NodeId lower;
    NodeId upper;
    NodeId third;
  };
  [[nodiscard]] std::span<const Edge> edgesBetween(NodeId a, NodeId b) const;
  [[nodiscard]] Vec3 positionIn(const ElementView& view, NodeId node) const;
  [[nodiscard]] bool isForcedByEdge(NodeId a, NodeId b, NodeId c, NodeId d,
                                    const ElementView& view) const;
  [[nodiscard]] bool hasEdgeOfNeedle(const NodeQuad& nodes, const ElementView& view) const;
  [[nodiscard]] bool liesInNarrowGap(const NodeQuad& nodes, const ElementView& view) const;

  MeshView mesh_;
  std::vector<std::uint8_t> isOnBoundary_;  ///< per node
  std::vector<Edge> edges_;
};

}  // namespace tetrafront
