#pragma once

/// @file The 2-D advancing front of a patch (Löhner & Parikh 1988, section 5.2): steps F4-F9 of section 2 in
/// the patch's plane, with edges in place of faces and triangles in place of tetrahedra.
///
/// Exact orientations and node indices decide whether edges intersect, never a tolerance. The unmeshed part of
/// the plane is therefore always a polygon with holes whose edges do not cross, and each such polygon can be
/// triangulated without new nodes. If no good triangle completes an edge, the search for candidates is widened,
/// at last to all nodes of the front, where at least one candidate passes. The front therefore always closes.

#include <cstdint>
#include <vector>

#include "search/indexed_heap.h"
#include "search/quadtree.h"
#include "surface/patch_metric.h"
#include "surface/planar_mesh.h"
#include "surface/surface_trace.h"

namespace tetrafront {

template <class Trace>
class BasicPlanarFront {
 public:
  /// `mesh` holds the boundary's nodes and sides. The sides must form simple closed loops with the patch on
  /// their left. The front adds triangles and interior nodes. Metric and mesh must outlive this.
  BasicPlanarFront(const PatchMetric& metric, PlanarMesh& mesh, Trace trace = {});

  /// Takes about `budget` edges from the front; returns true when none is left.
  bool advance(std::uint32_t budget);

  /// After advance() has returned true: true if the patch is not covered because the loops were not simple. The
  /// triangles made so far remain.
  [[nodiscard]] bool hasStalled() const { return freeEdges_.size() < edges_.size(); }

 private:
  /// A directed edge of the front; the unmeshed part of the plane is on its left.
  struct Edge {
    PlanarNodeId from;
    PlanarNodeId to;
    std::uint16_t layer = 0;
    std::uint8_t pass = 0;  ///< number of failed attempts to complete it
  };
  /// A node of the front that may complete the base edge; none for the ideal point.
  struct Candidate {
    double rank;
    PlanarNodeId node;
  };
  /// The base edge and the target triangle on it.
  struct Base {
    std::uint32_t id;
    Edge edge;
    PlaneSample sample;   ///< near the centre of the target triangle
    double length;        ///< of the edge, in the metric
    double targetLength;  ///< of the two new edges, in the metric
    Vec2 middle;
    Vec2 inward;  ///< of length 1 in the metric, normal to the edge, into the unmeshed part
    Vec2 ideal;
  };

  std::uint32_t addEdge(PlanarNodeId from, PlanarNodeId to, std::uint16_t layer);
  void removeEdge(std::uint32_t id);
  [[nodiscard]] std::uint64_t keyOf(const Edge& edge);
  [[nodiscard]] std::uint64_t sizeClassOf(const Edge& edge) const;
  bool completeEdge(std::uint32_t id);
  [[nodiscard]] Base makeBase(std::uint32_t id);
  void gather(const Base& base);
  void rankCandidates(const Base& base);
  bool tryCandidates(const Base& base);
  bool tryNewNode(const Base& base);
  [[nodiscard]] std::uint32_t firstTooClose(const Base& base) const;
  [[nodiscard]] std::uint32_t firstCrossed(const Base& base, PlanarNodeId apex) const;
  [[nodiscard]] bool isBlockedBy(const Edge& edge, PlanarNodeId a, PlanarNodeId b,
                                 PlanarNodeId apex) const;
  void accept(const Base& base, PlanarNodeId apex, bool isNew);
  std::uint32_t closeOrAdd(PlanarNodeId from, PlanarNodeId to, std::uint16_t layer);
  [[nodiscard]] double distance(const Base& base, const Vec2& a, const Vec2& b) const;
  [[nodiscard]] double shape(const Base& base, const Vec2& apex) const;
  void recordBase(const Base& base);

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  IndexedHeap heap_;
  Quadtree tree_;
  PlaneBox region_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> freeEdges_;
  std::uint32_t sequence_ = 0;
  FieldHint hint_;
  // Scratch of the current base edge.
  std::vector<std::uint32_t> nearEdges_;
  std::vector<PlanarNodeId> nearNodes_;
  std::vector<std::uint32_t> stamps_;
  std::uint32_t stamp_ = 0;
  std::vector<Candidate> candidates_;
  [[no_unique_address]] Trace trace_;
};

extern template class BasicPlanarFront<NullSurfaceTrace>;
extern template class BasicPlanarFront<RecordingSurfaceTrace>;

using PlanarFront = BasicPlanarFront<NullSurfaceTrace>;

}  // namespace tetrafront
