#include "surface/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace tetrafront {
namespace {

using Cell = std::array<double, 3>;

/// The edge of the cells, no smaller than `distance`, such that all cells can be counted.
double cellEdge(std::span<const double> points, double distance) {
  constexpr double kFinest = 0x1p-50;
  double largest = 0.0;
  for (const double x : points) largest = std::max(largest, std::fabs(x));
  return distance > 0.0 ? std::max(distance, kFinest * largest) : 0.0;
}

/// Nodes by the cubic cell of a lattice they lie in; with an edge of 0, by their place.
class NodeLattice {
 public:
  NodeLattice(std::span<const double> points, double edge)
      : points_(points), edge_(edge), cells_(points.size() / 3), order_(points.size() / 3) {
    for (std::uint32_t i = 0; i < cells_.size(); ++i) cells_[i] = cellAt(i);
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(), [this](std::uint32_t a, std::uint32_t b) {
      return cells_[a] != cells_[b] ? cells_[a] < cells_[b] : a < b;
    });
  }

  /// The lowest node below `node` with `accepts` in the cells that touch its own.
  template <class Accepts>
  [[nodiscard]] std::uint32_t lowestNear(std::uint32_t node, const Accepts& accepts) const {
    std::uint32_t lowest = node;
    const int reach = edge_ > 0.0 ? 1 : 0;
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z) {
          const Cell& own = cells_[node];
          const Cell cell{own[0] + x, own[1] + y, own[2] + z};
          for (auto at = firstOf(cell); at != order_.end() && cells_[*at] == cell; ++at) {
            if (*at >= lowest) break;
            if (accepts(*at)) lowest = *at;
          }
        }
      }
    }
    return lowest;
  }

 private:
  [[nodiscard]] Cell cellAt(std::uint32_t node) const {
    Cell cell{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = points_[3 * std::size_t{node} + k];
      // Adding zero makes one of the two zeros, whose bits would tell them apart.
      cell[k] = edge_ > 0.0 ? std::floor(x / edge_) : x + 0.0;
    }
    return cell;
  }

  [[nodiscard]] std::vector<std::uint32_t>::const_iterator firstOf(const Cell& cell) const {
    return std::lower_bound(
        order_.begin(), order_.end(), cell,
        [this](std::uint32_t node, const Cell& value) { return cells_[node] < value; });
  }

  std::span<const double> points_;
  double edge_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

std::vector<std::uint32_t> weldedNodes(std::span<const double> points, double distance) {
  std::vector<std::uint32_t> target(points.size() / 3);
  std::iota(target.begin(), target.end(), 0U);
  const NodeLattice lattice(points, cellEdge(points, distance));
  for (std::uint32_t i = 0; i < target.size(); ++i) {
    target[i] = lattice.lowestNear(i, [&](std::uint32_t other) {
      if (target[other] != other) return false;
      double squared = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = points[3 * std::size_t{i} + k] - points[3 * std::size_t{other} + k];
        squared += d * d;
      }
      return squared <= distance * distance;
    });
  }
  return target;
}

}  // namespace tetrafront
