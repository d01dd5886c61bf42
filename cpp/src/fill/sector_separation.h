#pragma once

/// @file Splits the points around which the interior is not connected over faces.

#include <cstddef>
#include <span>
#include <vector>

#include "fill/fill_mesh.h"
#include "topology/node_lists.h"

namespace tetrafront {

/// A point where parts of the interior meet only in an edge or in the point itself becomes one
/// point for each part.
class SectorSeparation {
 public:
  /// O(tetrahedra). The mesh must outlive this object.
  SectorSeparation(FillMesh& mesh, std::span<const NodeId> boundaryPoints);

  [[nodiscard]] bool isDone() const { return next_ == nodes_.size(); }
  /// Splits one point if necessary; returns the number of tetrahedra at it.
  std::size_t step();

  /// The points and their copies, ascending by the original point.
  [[nodiscard]] std::span<const NodeId> points() const { return points_; }

 private:
  FillMesh& mesh_;
  std::vector<NodeId> nodes_;
  NodeLists<TetId> tetsAt_;  ///< per point of nodes_
  std::size_t next_ = 0;
  std::vector<NodeId> points_;
  std::vector<TetId> sector_;
};

}  // namespace tetrafront
