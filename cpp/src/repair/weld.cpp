#include "repair/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/budget.h"
#include "base/sort.h"

namespace tetrafront {
namespace {

using Cell = std::array<double, 3>;

/// To sort a node in costs less than to look around it.
constexpr std::size_t kPreparedPerBudget = 8;

/// The edge of the cells, no smaller than `distance`, such that all cells can be counted.
double cellEdge(std::span<const double> points, double distance) {
  constexpr double kFinest = 0x1p-50;
  double largest = 0.0;
  for (const double x : points) largest = std::max(largest, std::fabs(x));
  return distance > 0.0 ? std::max(distance, kFinest * largest) : 0.0;
}

}  // namespace

/// The nodes that stay what they are, by the cubic cell of a lattice they lie in; with an edge of 0, by
/// their place. To be added in ascending order.
class NodeWelder::NodeGrid {
 public:
  NodeGrid(std::span<const double> points, double edge)
      : points_(points), edge_(edge), cellOf_(points.size() / 3), nodes_(points.size() / 3) {
    std::iota(nodes_.begin(), nodes_.end(), 0U);
  }

  /// Makes room for all nodes, about `budget` at a time; true when finished, and before add().
  bool prepare(std::size_t budget) {
    if (stage_ == Stage::kReady) return true;
    if (stage_ == Stage::kSort) {
      if (sort_->advance(budget)) stage_ = Stage::kBuckets;
      return false;
    }
    const std::size_t last = next_ + std::min(budget, nodes_.size() - next_);
    for (; next_ < last; ++next_) {
      if (stage_ == Stage::kCells) {
        cellOf_[next_] = cellAt(static_cast<std::uint32_t>(next_));
      } else {
        addBucket(static_cast<std::uint32_t>(next_));
      }
    }
    if (next_ < nodes_.size()) return false;
    next_ = 0;
    if (stage_ == Stage::kCells) {
      sort_.emplace(std::span(nodes_), ByCell{cellOf_.data()});
      stage_ = Stage::kSort;
      return false;
    }
    sort_.reset();
    cellOf_ = {};
    stage_ = Stage::kReady;
    return true;
  }

  void add(std::uint32_t node) { nodes_[buckets_[bucketOf(cellAt(node))].end++] = node; }

  /// The lowest node that was added with `accepts` in the cells that touch the one of `node`; `node`
  /// itself if there is none.
  template <class Accepts>
  [[nodiscard]] std::uint32_t lowestNear(std::uint32_t node, const Accepts& accepts) const {
    std::uint32_t lowest = node;
    const int reach = edge_ > 0.0 ? 1 : 0;
    const Cell own = cellAt(node);
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z) {
          const std::size_t at = bucketOf({own[0] + x, own[1] + y, own[2] + z});
          if (at == cells_.size()) continue;
          for (std::uint32_t i = buckets_[at].begin; i < buckets_[at].end; ++i) {
            if (nodes_[i] >= lowest) break;
            if (accepts(nodes_[i])) lowest = nodes_[i];
          }
        }
      }
    }
    return lowest;
  }

 private:
  enum class Stage : std::uint8_t { kCells, kSort, kBuckets, kReady };

  struct ByCell {
    const Cell* cellOf;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      return cellOf[a] != cellOf[b] ? cellOf[a] < cellOf[b] : a < b;
    }
  };

  /// For the node at `position` of those sorted, in the room of its cell.
  void addBucket(std::uint32_t position) {
    const Cell& cell = cellOf_[nodes_[position]];
    if (!cells_.empty() && cells_.back() == cell) return;
    cells_.push_back(cell);
    buckets_.push_back({position, position});
  }

  /// Of the nodes added in one cell: positions in nodes_, which has a place for all that lie there.
  struct Bucket {
    std::uint32_t begin;
    std::uint32_t end;
  };

  [[nodiscard]] Cell cellAt(std::uint32_t node) const {
    Cell cell{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = points_[3 * std::size_t{node} + k];
      // Adding zero makes one of the two zeros, whose bits would tell them apart.
      cell[k] = edge_ > 0.0 ? std::floor(x / edge_) : x + 0.0;
    }
    return cell;
  }

  /// Position among the cells that have nodes, or their number.
  [[nodiscard]] std::size_t bucketOf(const Cell& cell) const {
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), cell);
    return at != cells_.end() && *at == cell ? static_cast<std::size_t>(at - cells_.begin())
                                             : cells_.size();
  }

  std::span<const double> points_;
  double edge_;
  Stage stage_ = Stage::kCells;
  std::size_t next_ = 0;
  std::vector<Cell> cellOf_;  ///< per node, until there is room
  std::optional<SlicedSort<std::uint32_t, ByCell>> sort_;
  std::vector<Cell> cells_;      ///< ascending
  std::vector<Bucket> buckets_;  ///< per cell
  std::vector<std::uint32_t> nodes_;
};

NodeWelder::NodeWelder(std::span<const double> points, double distance)
    : points_(points), distance_(distance) {}
NodeWelder::NodeWelder(NodeWelder&&) noexcept = default;
NodeWelder& NodeWelder::operator=(NodeWelder&&) noexcept = default;
NodeWelder::~NodeWelder() = default;

bool NodeWelder::advance(std::uint32_t budget) {
  const std::size_t count = points_.size() / 3;
  if (!grid_) {
    grid_ = std::make_unique<NodeGrid>(points_, cellEdge(points_, distance_));
    targets_.reserve(count);
  }
  if (!grid_->prepare(scaledBudget(budget, kPreparedPerBudget))) return false;
  const std::size_t last = targets_.size() + std::min<std::size_t>(count - targets_.size(), budget);
  while (targets_.size() < last) {
    const auto node = static_cast<std::uint32_t>(targets_.size());
    targets_.push_back(targetOf(node));
    if (targets_.back() == node) grid_->add(node);
  }
  return last == count;
}

std::uint32_t NodeWelder::targetOf(std::uint32_t node) const {
  return grid_->lowestNear(node, [&](std::uint32_t other) {
    double squared = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = points_[3 * std::size_t{node} + k] - points_[3 * std::size_t{other} + k];
      squared += d * d;
    }
    return squared <= distance_ * distance_;
  });
}

}  // namespace tetrafront
