#include "boundary/node_grid.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace tetrafront {
namespace {

/// Nodes per unit of budget: sorting a node into its cell costs less than searching around it.
constexpr std::size_t kNodesPerUnit = 8;

}  // namespace

NodeGrid::NodeGrid(std::span<const double> points, double cellEdge)
    : points_(points), cellEdge_(cellEdge), slots_(points.size() / 3) {}

Task<> NodeGrid::reserveSlots(Work& work) {
  std::vector<Cell> cellOf(slots_.size());
  work.beginPart(0.2);
  co_await work.forEachBlock(
      slots_.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          slots_[i] = NodeId(i);
          cellOf[i] = cellAt(NodeId(i));
        }
      },
      kNodesPerUnit);

  auto byCell = [&cellOf](NodeId a, NodeId b) {
    const Cell& cellOfA = cellOf[a.index()];
    const Cell& cellOfB = cellOf[b.index()];
    return cellOfA != cellOfB ? cellOfA < cellOfB : a < b;
  };
  SlicedSort<NodeId, decltype(byCell)> sort(slots_, byCell);
  work.beginPart(0.8);
  co_await work.finish(sort, kNodesPerUnit);

  work.beginPart(1.0);
  co_await work.forEachBlock(
      slots_.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const Cell& cell = cellOf[slots_[i].index()];
          if (!cells_.empty() && cells_.back() == cell) continue;
          const auto begin = static_cast<std::uint32_t>(i);
          cells_.push_back(cell);
          buckets_.push_back({begin, begin});
        }
      },
      kNodesPerUnit);
}

void NodeGrid::add(NodeId node) { slots_[buckets_[indexOf(cellAt(node))].end++] = node; }

NodeGrid::Cell NodeGrid::cellAt(NodeId node) const {
  Cell cell{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = points_[3 * node.index() + k];
    // Adding zero turns -0 into +0.
    cell[k] = cellEdge_ > 0.0 ? std::floor(x / cellEdge_) : x + 0.0;
  }
  return cell;
}

std::size_t NodeGrid::indexOf(const Cell& cell) const {
  const auto found = std::ranges::lower_bound(cells_, cell);
  const bool isKnown = found != cells_.end() && *found == cell;
  return isKnown ? static_cast<std::size_t>(found - cells_.begin()) : cells_.size();
}

}  // namespace tetrafront
