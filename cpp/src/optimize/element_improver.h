#pragma once

/// @file Improves the few elements that miss their target angles, one by one, worst first: by
/// swaps, moves, collapses, insertion of a node into a cavity, and compound changes that may get
/// worse before they get better. A change is kept only if the poor elements that it touched improve
/// together, so the mesh never ends worse than it began.

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

/// What must fall for a change to be kept, over the poor elements that it touched.
enum class ImprovementGoal : std::uint8_t {
  kFewer,     ///< the sum of their costs: fewer elements, however poor the remaining ones
  kLessPoor,  ///< the sum of the fourth powers of their costs: the worst elements count
};

template <class Space = PlainSpace>
class ElementImprover {
 public:
  ElementImprover(TetComplex& complex, EdgeRemoval<Space>& removal, EdgeSplitter<Space>& splitter,
                  NodeCollapser<Space>& collapser, NodeMover<Space>& mover)
      : complex_(complex),
        removal_(removal),
        splitter_(splitter),
        collapser_(collapser),
        mover_(mover) {}

  /// Tries all changes on one element. `cost` must use a dihedral measure. Returns whether the
  /// element is gone or meets its targets (cost at most 1).
  bool improve(TetId tet, const ElementCost<Space>& cost);

  void aimAt(ImprovementGoal aim) { aim_ = aim; }

  /// Elements of a higher cost count when a change is weighed; at most 1.
  void countAbove(double cost) { counted_ = cost; }

  /// Moves the nodes, then improves the few worst elements that the current trial has touched, a
  /// few times. Each step lowers the worst cost of what it touches.
  void settle(std::span<const NodeId> nodes, const ElementCost<Space>& cost);

  /// Sets how many compound changes may still be tried. They improve the last few elements but take
  /// long; without a limit, elements that nothing can improve would take all the time.
  void allowCompounds(std::size_t count) { compounds_ = count; }

 private:
  using Target = typename Space::Target;

  [[nodiscard]] typename Space::Frame coneFrame(const Target& apex, const Corners& nodes,
                                                std::size_t side) const;
  [[nodiscard]] bool stillPoor(TetId tet, const Corners& nodes) const;
  template <class Change>
  bool attempt(double gain, const ElementCost<Space>& cost, Change change);
  bool swapAround(TetId tet, const ElementCost<Space>& cost);
  bool moveCorners(const Corners& nodes, const ElementCost<Space>& cost);
  bool collapseCorner(const Corners& nodes, const ElementCost<Space>& cost);
  [[nodiscard]] Vec3 besideShortestEdge(const Corners& nodes, const Vec3& centroid) const;
  bool insertNode(TetId tet, const ElementCost<Space>& cost);
  bool insertBeside(TetId tet, const Target& target, const ElementCost<Space>& cost);
  bool insertAt(std::span<const TetId> seeds, const Vec3& start, const Target& target,
                const ElementCost<Space>& cost);
  bool growCavity(const Vec3& position, const Target& target, const ElementCost<Space>& cost,
                  double limit);
  [[nodiscard]] bool isInCavity(ElementFace across) const;
  template <class Visitor>
  bool visitCavityFaces(Visitor visit) const;
  void hollowOut(const Target& target);
  bool fillCavity(const Vec3& position, const Target& target, const ElementCost<Space>& cost);
  bool compound(TetId tet, const ElementCost<Space>& cost);
  bool detour(TetId tet, const ElementCost<Space>& cost);
  bool tryCompound(TetId tet, NodeId a, NodeId b, bool split, const ElementCost<Space>& cost);
  bool settleOne(const ElementCost<Space>& cost);

  TetComplex& complex_;
  EdgeRemoval<Space>& removal_;
  EdgeSplitter<Space>& splitter_;
  NodeCollapser<Space>& collapser_;
  NodeMover<Space>& mover_;
  Hollow<Space> hollow_;
  std::vector<TetId> cavity_;
  std::vector<std::uint32_t> inCavity_;
  std::uint32_t cavityStamp_ = 0;
  std::vector<NewElement> fresh_;
  std::size_t compounds_ = 0;
  ImprovementGoal aim_ = ImprovementGoal::kFewer;
  double counted_ = 1.0;  ///< cost
};

}  // namespace tetrafront
