#pragma once

/// @file The last few bad elements, one by one, worst first: swaps, moves, collapses, insertion of
/// a node into a cavity, and compound changes that may get worse before they get better. Each is
/// kept only if the worst element concerned gets better.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "optimize/density.h"
#include "optimize/edge_removal.h"
#include "optimize/element_cost.h"
#include "optimize/node_moves.h"
#include "optimize/tet_complex.h"

namespace tetrafront {

class ElementRepair {
 public:
  ElementRepair(TetComplex& complex, EdgeRemoval& removal, EdgeSplitter& splitter,
                NodeCollapser& collapser, NodeMover& mover)
      : complex_(complex),
        removal_(removal),
        splitter_(splitter),
        collapser_(collapser),
        mover_(mover) {}

  /// Tries everything on one element. `cost` must be a dihedral one. Returns whether it is gone or
  /// good enough (cost at most 1).
  bool repair(TetId tet, const ElementCost& cost);

 private:
  [[nodiscard]] bool stillBad(TetId tet, const Corners& nodes) const;
  bool swapAround(TetId tet, const ElementCost& cost);
  bool moveCorners(const Corners& nodes, const ElementCost& cost);
  bool collapseCorner(const Corners& nodes, const ElementCost& cost);
  bool insertNode(TetId tet, const ElementCost& cost);
  bool insertAt(std::span<const TetId> seeds, const Vec3& start, double size,
                const ElementCost& cost);
  bool growCavity(const Vec3& place, const ElementCost& cost, double limit);
  void hollowOut();
  bool fillCavity(const Vec3& place, double size, const ElementCost& cost);
  bool compound(TetId tet, const ElementCost& cost);
  bool tryCompound(TetId tet, NodeId a, NodeId b, bool split, const ElementCost& cost);
  void settle(std::span<const NodeId> nodes, const ElementCost& cost);

  TetComplex& complex_;
  EdgeRemoval& removal_;
  EdgeSplitter& splitter_;
  NodeCollapser& collapser_;
  NodeMover& mover_;
  Hollow hollow_;
  std::vector<TetId> cavity_;
  std::vector<std::uint32_t> inCavity_;
  std::uint32_t cavityStamp_ = 0;
  std::vector<NewElement> fresh_;
};

}  // namespace tetrafront
