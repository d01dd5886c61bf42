#pragma once

/// @file The exact fill: tetrahedra for any closed, embedded, consistently oriented set of triangles. New
/// points are in the interior only. All signs are exact, so the only step that can fail is the last one,
/// which rounds interior points to doubles. If it fails, the volume around these points is left open and
/// everything else is filled.
///
/// 1. Insert the nodes into a nearly Delaunay mesh (PointInsertion).
/// 2. Recover the edges, then the triangles, by swaps and by points on the boundary (BoundaryRecovery).
/// 3. Drop the exterior tetrahedra (OutsideRemoval).
/// 4. Replace the points on the boundary by interior ones (SectorSeparation, BoundaryPointRemoval).
/// 5. Remove interior points or round them to doubles (InteriorPointRounding); most are not needed.

#include <cstdint>
#include <limits>
#include <optional>

#include "fill/boundary_point_removal.h"
#include "fill/boundary_recovery.h"
#include "fill/fill_mesh.h"
#include "fill/fill_result.h"
#include "fill/interior_point_rounding.h"
#include "fill/outside_removal.h"
#include "fill/point_insertion.h"
#include "fill/sector_separation.h"

namespace tetrafront {

class ExactFill {
 public:
  /// Number of orders in which nodes can be inserted and edges recovered. If an interior point cannot be
  /// rounded to doubles after one order, it mostly can after another.
  static constexpr unsigned kOrders = 6;

  static constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

  /// Fails after `limit` units of the budget of advance().
  explicit ExactFill(FillTask task, unsigned order = 0, std::uint64_t limit = kNoLimit);
  ExactFill(const ExactFill&) = delete;
  ExactFill& operator=(const ExactFill&) = delete;

  enum class State : std::uint8_t {
    kRunning,
    kDone,
    kPartial,  ///< the volume around interior points that doubles cannot hold is left open
    kFailed    ///< the triangles are not a closed boundary, or the limit is reached; no result
  };
  /// Does about `budget` x 2 microseconds of work. The outcome does not depend on the budget.
  State advance(std::uint32_t budget);

  /// Work done so far, in units of the budget of advance().
  [[nodiscard]] std::uint64_t cost() const;

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Empty until the state is kDone or kPartial.
  [[nodiscard]] const FillResult& result() const { return result_; }

 private:
  enum class Stage : std::uint8_t {
    kBegin,
    kInsert,
    kEdges,
    kTriangles,
    kDropOutside,
    kSeparate,
    kRemoveBoundaryPoints,
    kRoundInteriorPoints,
    kDone,
    kFailed
  };

  [[nodiscard]] std::uint64_t signs() const;
  void step();
  void beginStage(Stage stage);
  void failUnless(bool isGood);
  void begin();
  void beginRecovery();
  void recoverEdges();
  void beginDropping();
  void dropOutside();
  void separate();
  void removeBoundaryPoints();
  void roundInteriorPoints();

  FillTask task_;
  unsigned order_;
  std::uint64_t limit_;
  FillMesh mesh_;
  FillResult result_;
  Stage stage_ = Stage::kBegin;
  std::size_t next_ = 0;       ///< node or triangle of the stage
  std::uint64_t touched_ = 0;  ///< tetrahedra visited without computing a sign
  // One of these works at a time; the next one takes over what it needs.
  std::optional<PointInsertion> insertion_;
  std::optional<BoundaryRecovery> recovery_;
  std::optional<OutsideRemoval> outside_;
  std::optional<SectorSeparation> separation_;
  std::optional<BoundaryPointRemoval> removal_;
  std::optional<InteriorPointRounding> rounding_;
};

}  // namespace tetrafront
