#pragma once

/// @file Makes one sweep after the other, in slices: which elements or nodes it visits, what it
/// does to them, and how many changes that made.

#include <array>
#include <cstddef>
#include <cstdint>

#include "optimize/density.h"
#include "optimize/edge_removal.h"
#include "optimize/element_cost.h"
#include "optimize/improvement_queue.h"
#include "optimize/mesh_score.h"
#include "optimize/node_moves.h"
#include "optimize/schedule.h"
#include "optimize/tet_complex.h"

namespace tetrafront {

template <class Space = PlainSpace>
class Sweeps {
 public:
  explicit Sweeps(TetComplex& complex)
      : complex_(complex),
        removal_(complex),
        mover_(complex),
        splitter_(complex),
        collapser_(complex),
        improvements_(complex, removal_, splitter_, collapser_, mover_) {}

  /// From the next sweep on, uses this cost, which the elements' stored costs must match. The first
  /// sweep of each kind visits what has changed since that pass.
  void measureBy(const ElementCost<Space>& cost, std::uint32_t since);

  /// Elements that the sweep appends belong to the next sweep. The end is fixed when the sweep
  /// begins; if it were read again in each slice, it would depend on where slices end.
  void begin(Sweep sweep);
  /// Visits about `budget` elements or nodes and returns how many it visited.
  std::size_t advance(std::uint32_t budget);
  [[nodiscard]] bool isDone() const { return next_ == end_; }
  /// Part of the sweep that is made, 0 to 1.
  [[nodiscard]] double fraction() const {
    return isDone() ? 1.0 : static_cast<double>(next_) / static_cast<double>(end_);
  }

  /// Returns the number of changes since the last call.
  std::size_t takeChanges();

  [[nodiscard]] const ElementCost<Space>& cost() const { return cost_; }
  [[nodiscard]] EdgeSplitter<Space>& splitter() { return splitter_; }
  [[nodiscard]] NodeCollapser<Space>& collapser() { return collapser_; }
  [[nodiscard]] ImprovementQueue<Space>& improvements() { return improvements_; }
  /// Score of the last scoring sweep.
  [[nodiscard]] const MeshScore& score() const { return score_; }

 private:
  [[nodiscard]] std::size_t size() const;
  void work(std::size_t first, std::size_t last);
  void end();
  void swap(std::size_t first, std::size_t last);
  bool swapOneEdgeOf(TetId tet);
  void move(std::size_t first, std::size_t last, MoveKind kind);
  void addToScore(std::size_t first, std::size_t last);
  std::size_t tryLastResort();

  TetComplex& complex_;
  EdgeRemoval<Space> removal_;
  NodeMover<Space> mover_;
  EdgeSplitter<Space> splitter_;
  NodeCollapser<Space> collapser_;
  ImprovementQueue<Space> improvements_;
  MeshScore score_;
  ElementCost<Space> cost_{Measure::kBulk};
  Sweep sweep_ = Sweep::kSwap;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  std::uint32_t since_ = 0;  ///< pass; what has not changed since is not visited
  std::array<std::uint32_t, kSweepKinds> lastRun_{};
  std::size_t changes_ = 0;
};

}  // namespace tetrafront
