#pragma once

/// @file Finds the background tetrahedron of a place and interpolates there: a visibility walk
/// through face neighbours from the last tetrahedron hit (Löhner & Parikh 1988, section 6 (d)),
/// with a search over all of them where the walk fails.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "field/size_tensor.h"
#include "search/box_tree.h"
#include "search/incidence.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/status.h"

namespace tetrafront {

class GridLocator {
 public:
  struct Location {
    std::uint32_t tetrahedron = 0;
    std::array<double, 4> weights{};  ///< of the four nodes; sum 1, all >= 0
    bool inside = false;  ///< false if outside by more than rounding and the grid's coverageMargin
    std::uint32_t steps = 0;  ///< of the walk, from one tetrahedron to the next
  };

  /// `grid` must have passed checkBackgroundGrid(); its sources are not looked at. `growth` > 0
  /// limits the sizes of its nodes (grid_gradation.h). O(n log n), all at once.
  explicit GridLocator(BackgroundGrid grid, double growth = 0.0);

  /// The tetrahedron that holds `place`, or the nearest one with the weights of its nearest point.
  /// A few steps from a near start; O(n^(1/3)) from a far one; O(log n) after a failed walk.
  [[nodiscard]] Location locate(const Vec3& place, std::uint32_t startTetrahedron) const;

  /// Linear interpolation of the nodes' sizes: the wanted edge length where nothing is stretched.
  [[nodiscard]] double sizeAt(const Location& location) const;

  /// Linear interpolation of the nodes' size tensors H.
  [[nodiscard]] SymmetricTensor tensorAt(const Location& location) const;

  /// Whether any node asks for a stretching other than 1.
  [[nodiscard]] bool isStretched() const { return !tensors_.empty(); }

  [[nodiscard]] const BackgroundGrid& grid() const { return grid_; }

 private:
  /// What a walk needs of a tetrahedron, side by side in memory: the linear functions that are the
  /// weights of nodes 1, 2, 3, which vanish at node 0; what is across the face opposite to node i.
  struct Frame {
    Vec3 origin;
    std::array<Vec3, 3> gradients;
    std::array<std::uint32_t, 4> neighbours;
  };

  friend class GridLocatorBuilder;
  GridLocator() = default;

  [[nodiscard]] std::array<double, 4> weightsAt(std::uint32_t tetrahedron, const Vec3& place) const;
  [[nodiscard]] Location nearest(const Vec3& place, std::uint32_t guess) const;
  [[nodiscard]] double allowanceAt(std::uint32_t tetrahedron) const;

  BackgroundGrid grid_;
  std::vector<SymmetricTensor> tensors_;  ///< per node; empty where nothing is stretched
  std::vector<Frame> frames_;
  std::vector<double> sizes_;  ///< per node, close together
  BoxTree tree_;
  std::uint32_t maxSteps_ = 0;
  double slack_ = 0.0;  ///< how far outside counts as rounding
};

/// Builds a locator in slices.
class GridLocatorBuilder {
 public:
  /// As of GridLocator.
  explicit GridLocatorBuilder(BackgroundGrid grid, double growth = 0.0);
  GridLocatorBuilder(GridLocatorBuilder&&) noexcept;
  GridLocatorBuilder& operator=(GridLocatorBuilder&&) noexcept;
  ~GridLocatorBuilder();

  /// Goes on for about `budget` tetrahedra, which are come to some tens of times; true when finished.
  bool advance(std::uint32_t budget);

  /// Once, when finished.
  [[nodiscard]] GridLocator take();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What is looked at.
enum class GridPart : std::uint8_t { kWhole, kSources };

/// Looks for everything wrong with a grid itself and its sources, in slices.
class BackgroundGridCheck {
 public:
  /// `grid` must outlive this.
  explicit BackgroundGridCheck(const BackgroundGrid& grid, GridPart part = GridPart::kWhole)
      : grid_(&grid), part_(part) {}

  /// Goes on for about `budget` nodes or tetrahedra; true when finished. O(n) in all for grids with few
  /// tetrahedra at a node.
  bool advance(std::uint32_t budget);

  /// All of it, when finished; empty if the grid can be used.
  [[nodiscard]] std::vector<Diagnostic> take() { return std::move(found_); }

 private:
  enum class Stage : std::uint8_t {
    kSources,
    kExtent,
    kNodes,
    kTetrahedra,
    kPlace,
    kRepeated,
    kDone
  };
  struct Entry {
    std::array<std::uint32_t, 4> nodes;  ///< ascending
    std::uint32_t tetrahedron;
  };

  void workOn(std::uint32_t i);
  void endStage();
  void checkSources();
  void extend(const Vec3& place);
  void checkRepeatedAt(std::uint32_t node);
  [[nodiscard]] std::uint32_t listOf(std::uint32_t lowestNode) const {
    return std::min(lowestNode, static_cast<std::uint32_t>(grid_->nodes.size()));
  }

  const BackgroundGrid* grid_;
  GridPart part_;
  Stage stage_ = Stage::kSources;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::optional<Vec3> low_;
  Vec3 high_{0.0};
  double smallest_ = 0.0;     ///< size that the grid may ask for
  NodeLists<Entry> entries_;  ///< tetrahedra at their lowest nodes, the last list for what are none
  std::vector<Diagnostic> found_;
};

/// All at once.
[[nodiscard]] std::vector<Diagnostic> checkBackgroundGrid(const BackgroundGrid& grid);

}  // namespace tetrafront
