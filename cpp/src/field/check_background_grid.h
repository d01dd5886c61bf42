#pragma once

/// @file Checks a background grid and its sources before a run uses them.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "search/incidence.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// The part of a background grid that is checked.
enum class GridPart : std::uint8_t { kWhole, kSources };

/// Finds all problems of a background grid and its sources, in slices.
class BackgroundGridCheck {
 public:
  /// `grid` must outlive this.
  explicit BackgroundGridCheck(const BackgroundGrid& grid, GridPart part = GridPart::kWhole)
      : grid_(&grid), part_(part) {}

  /// Checks about `budget` nodes or tetrahedra; returns true when finished. O(n) in total if few tetrahedra share a
  /// node.
  bool advance(std::uint32_t budget);

  /// Returns all diagnostics, once finished; empty if the grid can be used.
  [[nodiscard]] std::vector<Diagnostic> take() { return std::move(found_); }

 private:
  enum class Stage : std::uint8_t {
    kSources,
    kExtent,
    kNodes,
    kTetrahedra,
    kInsert,
    kDuplicates,
    kDone
  };
  struct Entry {
    GridNodeQuad nodes;  ///< ascending
    GridTetId tetrahedron;
  };

  void workOn(std::size_t i);
  void endStage();
  void checkSources();
  void extend(const Vec3& position);
  void checkDuplicatesAt(GridNodeId node);
  [[nodiscard]] GridNodeId listOf(GridNodeId lowestNode) const {
    return std::min(lowestNode, GridNodeId(grid_->nodes.size()));
  }

  const BackgroundGrid* grid_;
  GridPart part_;
  Stage stage_ = Stage::kSources;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::optional<Vec3> low_;
  Vec3 high_{0.0};
  double smallest_ = 0.0;  ///< smallest size permitted
  NodeLists<Entry, GridNodeId>
      entries_;  ///< tetrahedra by their lowest node; the last list holds those of invalid nodes
  std::vector<Diagnostic> found_;
};

/// Checks the whole grid.
[[nodiscard]] std::vector<Diagnostic> checkBackgroundGrid(const BackgroundGrid& grid);

}  // namespace tetrafront
