#include "boundary/weld.h"

#include <algorithm>
#include <cmath>

#include "boundary/node_grid.h"

namespace tetrafront {
namespace {

/// Returns the edge of the cells: no smaller than `distance`, and large enough for exact cell coordinates.
double cellEdge(std::span<const double> points, double distance) {
  constexpr double kSmallestShare = 0x1p-50;
  double largest = 0.0;
  for (const double x : points) largest = std::max(largest, std::fabs(x));
  return distance > 0.0 ? std::max(distance, kSmallestShare * largest) : 0.0;
}

double squaredDistance(std::span<const double> points, NodeId a, NodeId b) {
  double squared = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = points[3 * a.index() + k] - points[3 * b.index() + k];
    squared += d * d;
  }
  return squared;
}

}  // namespace

Task<std::vector<NodeId>> findWeldTargets(Work& work, std::span<const double> points,
                                          double distance) {
  NodeGrid grid(points, cellEdge(points, distance));
  work.beginPart(0.4);
  co_await grid.reserveSlots(work);

  std::vector<NodeId> targets(points.size() / 3);
  work.beginPart(1.0);
  co_await work.forEachBlock(targets.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const NodeId node(i);
      targets[i] = grid.lowestNear(node, [&](NodeId kept) {
        return squaredDistance(points, node, kept) <= distance * distance;
      });
      if (targets[i] == node) grid.add(node);
    }
  });
  co_return targets;
}

}  // namespace tetrafront
