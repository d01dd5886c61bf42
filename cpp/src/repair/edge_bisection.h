#pragma once

/// @file Bisects the edges of a surface that are longer than the target size, in all their triangles. Only the longest
/// edge of all its triangles is bisected (Rivara 1984), so angles stay above half of the given ones.

#include <array>
#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "search/indexed_heap.h"
#include "sizing/region_sizes.h"
#include "tetrafront/mesh.h"
#include "topology/edge_table.h"
#include "topology/tracked_surface.h"

namespace tetrafront {

/// Longest permitted edge, in target lengths: the halves are then as much too short as the edge was too long.
inline constexpr double kMaxEdgeLength = 1.4142135623730951;

/// Call measureEdges() for all edges, then measureTriangles() for all triangles, then advance().
class EdgeBisection {
 public:
  /// Everything must outlive this object, which appends midpoints and triangles to the given
  /// surface.
  /// `regions`: those whose sizes apply to the given triangles; an edge has the smallest size of its triangles.
  EdgeBisection(TrackedSurface& surface, const SizeField& field, const RegionSizes& regions,
                FieldHint& hint);

  [[nodiscard]] std::size_t edgeCount() const { return edges_.size(); }
  void measureEdges(std::size_t first, std::size_t last);
  /// Finds edges that are too long inside their triangles, although they are not along themselves.
  void measureTriangles(std::size_t first, std::size_t last);

  /// Returns the largest length measured so far, in target lengths.
  [[nodiscard]] double longest() const { return longest_; }

  /// Bisects about `budget` edges. Returns true when finished, or when the surface has more than `maxTriangles`
  /// triangles.
  bool advance(std::uint32_t budget, double maxTriangles);

  /// Returns whether no edge is too long.
  [[nodiscard]] bool isFinished() const { return waiting_.empty(); }

  [[nodiscard]] std::uint32_t bisectedEdges() const { return bisectedEdges_; }

 private:
  struct Edge {
    NodeId from;
    NodeId to;
    HalfEdgeId first{};                            ///< first half-edge in the list of the edge
    std::uint32_t region = FieldHint::kAnyRegion;  ///< region whose size applies
    double length = 0.0;  ///< in target lengths; 0 if no double lies between the ends
    /// By which the longest edge of a triangle is found: length in space, or `length` in a stretched field.
    double span = 0.0;
    double need = 0.0;  ///< largest length found, in target lengths, while the edge waits
  };

  [[nodiscard]] bool isLonger(EdgeId edge, EdgeId other) const;
  [[nodiscard]] EdgeId longestOf(TriangleId triangle) const;
  [[nodiscard]] EdgeId longestAround(EdgeId edge) const;
  [[nodiscard]] double lengthInside(TriangleId triangle, EdgeId edge);
  [[nodiscard]] double needOf(EdgeId edge);
  void measureEdge(EdgeId edge);
  void measureTriangle(TriangleId triangle);
  void request(EdgeId edge, double length);
  void bisect(EdgeId edge);
  void bisectTriangle(HalfEdgeId halfEdge, EdgeId firstHalf, EdgeId secondHalf);
  EdgeId addEdge(NodeId from, NodeId to, std::uint32_t region);
  void link(EdgeId edge, HalfEdgeId halfEdge);
  void relink(EdgeId edge, HalfEdgeId halfEdge, HalfEdgeId replacement);

  SurfaceMesh& mesh_;
  std::vector<TriangleId>& origin_;
  const SizeField& field_;
  const RegionSizes& regions_;
  FieldHint& hint_;
  std::vector<Edge> edges_;
  std::vector<EdgeId> edgeOf_;          ///< per half-edge
  std::vector<HalfEdgeId> nextOnEdge_;  ///< per half-edge: the next in the list of its edge
  IndexedHeap waiting_;                 ///< edges that may be too long, the longest first
  std::vector<HalfEdgeId> around_;      ///< half-edges of the edge that is bisected
  std::uint32_t bisectedEdges_ = 0;
  double longest_ = 0.0;
};

}  // namespace tetrafront
