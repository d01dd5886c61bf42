#pragma once

/// @file Points at which the inside hangs together by no face.

#include <cstddef>
#include <span>
#include <vector>

#include "fill/fill_mesh.h"
#include "search/incidence.h"

namespace tetrafront {

/// A point where pieces of the inside meet in an edge or at it alone becomes one point for each.
class SectorSeparation {
 public:
  /// O(tetrahedra). The mesh must outlive this.
  SectorSeparation(FillMesh& mesh, std::span<const NodeId> boundaryPoints);

  [[nodiscard]] bool isDone() const { return next_ == nodes_.size(); }
  /// Looks at one point; returns how many tetrahedra it has.
  std::size_t step();

  /// The points there are now, by those they came from.
  [[nodiscard]] std::span<const NodeId> points() const { return points_; }

 private:
  FillMesh& mesh_;
  std::vector<NodeId> nodes_;
  NodeLists<TetId> tetsAt_;  ///< of nodes_
  std::size_t next_ = 0;
  std::vector<NodeId> points_;
  std::vector<TetId> sector_;
};

}  // namespace tetrafront
