#pragma once

/// @file Makes invalid curved elements valid, and better those that are nearly invalid.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "curved/curved_mesh.h"
#include "curved/edge_middles.h"
#include "curved/node_step.h"
#include "tetrafront/vec3.h"
#include "topology/node_lists.h"

namespace tetrafront {

class Untangling {
 public:
  /// The middles of all edges of the boundary are known. `elements`: those at each node. `isFixed`: one flag per node.
  Untangling(CurvedMesh& curved, const NodeLists<TetId>& elements,
             std::span<const std::uint8_t> isFixed)
      : curved_(curved), elements_(elements), isFixed_(isFixed) {}

  /// Afterwards, no element is invalid.
  Task<> run(Work& work);

  /// Nodes that were moved, in this order, some of them several times.
  [[nodiscard]] std::span<const NodeId> movedNodes() const { return movedNodes_; }

 private:
  /// What moves: the middle of an edge, or a corner node together with the middles of its edges, each by half.
  struct Movable {
    EdgeEnds edge;
    NodeId corner;
  };

  Task<> improveMiddles(Work& work);
  Task<> moveCorners(Work& work);
  Task<> straighten(Work& work);

  [[nodiscard]] std::vector<TetId> elementsBelow(double limit) const;
  bool improveMiddlesOf(TetId tet);
  bool improveCornersOf(TetId tet);
  bool improve(const Movable& movable);
  void gatherElements(const Movable& movable);
  void gatherCoefficients(const Movable& movable, double unit);
  [[nodiscard]] static QuadraticTet displaced(QuadraticTet tet, const NodeQuad& nodes,
                                              const Movable& movable, const Vec3& step);
  void save(const Movable& movable);
  void move(const Movable& movable, const Vec3& step);
  void restore(const Movable& movable);
  [[nodiscard]] bool areValidWhenStraight() const;
  [[nodiscard]] bool areBetter(double before);
  double measureAround();
  void straightenBestOf(TetId tet, std::vector<TetId>& invalid);
  void straightenFor(const EdgeEnds& edge, std::vector<TetId>& invalid);

  CurvedMesh& curved_;
  const NodeLists<TetId>& elements_;
  std::span<const std::uint8_t> isFixed_;
  std::vector<NodeId> movedNodes_;
  std::vector<TetId> around_;           ///< elements that change with what moves
  std::vector<double> measuredAround_;  ///< their new scaled Jacobians
  std::vector<AffineCoefficient> coefficients_;
  std::vector<MiddleNode> savedMiddles_;  ///< middles that move, as they were
  Vec3 savedCorner_{0.0};
};

}  // namespace tetrafront
