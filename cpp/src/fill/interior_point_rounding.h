#pragma once

/// @file Removes the interior points or moves them to positions that doubles can hold.

#include <cstdint>
#include <span>
#include <vector>

#include "fill/cone.h"
#include "fill/fill_mesh.h"
#include "fill/sliver_removal.h"

namespace tetrafront {

class InteriorPointRounding {
 public:
  InteriorPointRounding(FillMesh& mesh, std::span<const NodeId> interiorPoints);

  /// Works on one point. kFailed: some points cannot be rounded.
  FillState step();

  /// Estimated progress, 0 to 1, as if all sweeps were needed.
  [[nodiscard]] double fraction() const;

  /// The points that are left. When the state is kDone, doubles hold all of them.
  [[nodiscard]] const std::vector<NodeId>& points() const { return points_; }

 private:
  bool removePoint(NodeId node);
  NodeId movePoint(NodeId node);
  NodeId moveWithin(NodeId node, std::size_t growth);
  [[nodiscard]] double minShapeAround() const;
  [[nodiscard]] bool allAreDoubles() const;

  FillMesh& mesh_;
  ConstraintEdges none_;
  Cone cone_;
  SliverRemoval slivers_;
  std::vector<NodeId> points_;
  std::size_t next_ = 0;
  int sweep_ = 0;
  bool changed_ = false;
  std::vector<TetId> star_;
};

}  // namespace tetrafront
