#pragma once

/// @file The 2-D advancing front of a patch (Löhner & Parikh 1988, section 5.2): steps F4-F9 of
/// section 2 with sides for faces and triangles for tetrahedra, in the patch's plane.
///
/// What may meet is decided by exact turns and shared node numbers, never by a tolerance, so the
/// unmeshed part of the plane is always a polygon with holes whose sides do not cross. Every such
/// polygon can be triangulated without new nodes: for a side that no good triangle completes,
/// candidates are sought ever farther away, at last among all nodes of the front, where one must
/// pass. The front therefore always closes.

#include <cstdint>
#include <vector>

#include "search/indexed_heap.h"
#include "search/quadtree.h"
#include "surface/patch_metric.h"
#include "surface/planar_mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

class PlanarFront {
 public:
  /// `mesh` holds the boundary's nodes and sides, which must form simple closed loops with the
  /// patch on their left; triangles and interior nodes are added to it. Both must outlive this.
  PlanarFront(const PatchMetric& metric, PlanarMesh& mesh);

  /// Takes about `budget` sides from the front. kDone: the patch is covered. kStalled: the loops
  /// were not simple after all; what exists is kept.
  MeshStatus advance(std::uint32_t budget);

  /// Sides still on the front.
  [[nodiscard]] std::size_t size() const { return heap_.size(); }

 private:
  /// One directed side; the unmeshed part of the plane is on its left.
  struct Side {
    std::uint32_t from;
    std::uint32_t to;
    std::uint16_t layer;
    std::uint8_t pass;  ///< how often it was put back
  };
  /// A place offered to complete the base side; a node of the front or the ideal point.
  struct Candidate {
    double rank;
    std::uint32_t node;
  };
  /// The base side and what is known around it.
  struct Base {
    std::uint32_t id;
    Side side;
    PlaneSample sample;  ///< near the centre of the triangle to be
    double length;       ///< in the metric
    double wanted;       ///< length of the two new sides, in the metric
    Vec2 middle;
    Vec2 inward;  ///< one unit of the metric, across the side into the unmeshed part
    Vec2 ideal;
  };

  void addSide(std::uint32_t from, std::uint32_t to, std::uint16_t layer);
  void removeSide(std::uint32_t id);
  [[nodiscard]] std::uint64_t keyOf(const Side& side, double size);
  bool completeSide(std::uint32_t id);
  [[nodiscard]] Base examine(std::uint32_t id);
  void placeIdealPoint(Base& base, double height) const;
  void gather(const Base& base);
  void rankCandidates(const Base& base);
  bool tryCandidates(const Base& base);
  bool tryNewNode(const Base& base);
  [[nodiscard]] bool tooClose(const Base& base) const;
  [[nodiscard]] bool crossesFront(const Base& base, std::uint32_t apex) const;
  [[nodiscard]] bool sideBlocks(std::uint32_t a, std::uint32_t b, std::uint32_t apex,
                                const Side& side) const;
  void accept(const Base& base, std::uint32_t apex);
  void closeOrAdd(std::uint32_t from, std::uint32_t to, std::uint16_t layer);
  [[nodiscard]] double distance(const Base& base, const Vec2& a, const Vec2& b) const;
  [[nodiscard]] double shape(const Base& base, const Vec2& apex) const;

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  IndexedHeap heap_;
  Quadtree tree_;
  PlaneBox region_;
  std::vector<Side> sides_;
  std::vector<std::uint32_t> freeSides_;
  std::uint32_t sequence_ = 0;
  FieldHint hint_;
  bool stalled_ = false;
  // Scratch of the current base side.
  std::vector<std::uint32_t> near_;
  std::vector<std::uint32_t> nearNodes_;
  std::vector<std::uint32_t> stamps_;
  std::uint32_t stamp_ = 0;
  std::vector<Candidate> candidates_;
};

}  // namespace tetrafront
