#include "field/grid_gradation.h"

#include <bit>
#include <limits>

#include "base/free_memory.h"
#include "field/tensor_limits.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

constexpr int kSweeps = 3;

/// Positive doubles have the same order as their bit patterns.
std::uint64_t keyOf(double size) { return std::bit_cast<std::uint64_t>(size); }

template <class Limiter>
void finish(Limiter limiter) {
  while (!limiter.advance(std::numeric_limits<std::size_t>::max())) {
  }
}

}  // namespace

bool GridEdges::advance(std::size_t budget) {
  if (stage_ == Stage::kDone) return true;
  const std::size_t end =
      stage_ == Stage::kCollect ? grid_->nodes.size() : grid_->tetrahedra.size();
  const std::size_t last = next_ + std::min(budget, end - next_);
  for (; next_ < last; ++next_) {
    if (stage_ == Stage::kCollect) {
      collectAt(GridNodeId(next_));
      continue;
    }
    const GridNodeQuad nodes = nodesOf(*grid_, GridTetId(next_));
    for (const TetEdge& edge : kTetEdges) {
      const auto [low, high] = std::minmax(nodes[edge.from], nodes[edge.to]);
      if (stage_ == Stage::kCount) {
        others_.count(low);
      } else {
        others_.add(low, high);
      }
    }
  }
  if (next_ < end) return false;
  next_ = 0;
  if (stage_ == Stage::kCount) others_.endCounting();
  stage_ = static_cast<Stage>(static_cast<std::uint8_t>(stage_) + 1);
  if (stage_ == Stage::kDone) others_ = {};
  return stage_ == Stage::kDone;
}

void GridEdges::collectAt(GridNodeId node) {
  const std::span<GridNodeId> others = others_.at(node);
  sortFew(others);
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (i > 0 && others[i] == others[i - 1]) continue;
    const Vec3 along = positionOf(*grid_, node) - positionOf(*grid_, others[i]);
    edges_.push_back({node, others[i], glm::length(along)});
  }
}

bool SizeLimiter::advance(std::size_t budget) {
  if (stage_ == Stage::kDone) return true;
  if (stage_ == Stage::kEdges) {
    if (finder_.advance(budget)) endStage();
    return false;
  }
  if (stage_ == Stage::kLower) {
    for (; budget > 0 && !waiting_.empty(); --budget) lowerAround(GridNodeId(waiting_.pop()));
    if (waiting_.empty()) stage_ = Stage::kDone;
    return stage_ == Stage::kDone;
  }
  const std::size_t last = next_ + std::min(budget, end_ - next_);
  for (; next_ < last; ++next_) workOn(next_);
  if (next_ == end_) endStage();
  return stage_ == Stage::kDone;
}

void SizeLimiter::workOn(std::size_t index) {
  if (stage_ == Stage::kQueue) {
    const GridNodeId node(index);
    waiting_.push(node.value, keyOf(nodeOf(*grid_, node).size));
    return;
  }
  const GridEdges::Edge& edge = edges_[index];
  if (stage_ == Stage::kComply) {
    const auto [smaller, larger] =
        std::minmax(nodeOf(*grid_, edge.a).size, nodeOf(*grid_, edge.b).size);
    complies_ = complies_ && larger <= smaller + growth_ * edge.length;
  } else if (stage_ == Stage::kCount) {
    spokes_.count(edge.a);
    spokes_.count(edge.b);
  } else if (stage_ == Stage::kInsert) {
    spokes_.add(edge.a, {edge.b, edge.length});
    spokes_.add(edge.b, {edge.a, edge.length});
  }
}

void SizeLimiter::endStage() {
  next_ = 0;
  if (stage_ == Stage::kEdges) {
    edges_ = finder_.take();
    end_ = edges_.size();
  } else if (stage_ == Stage::kComply) {
    if (complies_) {
      stage_ = Stage::kDone;
      return;
    }
    spokes_ = NodeLists<Spoke, GridNodeId>(grid_->nodes.size());
  } else if (stage_ == Stage::kCount) {
    spokes_.endCounting();
  } else if (stage_ == Stage::kInsert) {
    freeMemory(edges_);
    waiting_.reserveIds(grid_->nodes.size());
    end_ = grid_->nodes.size();
  }
  stage_ = static_cast<Stage>(static_cast<std::uint8_t>(stage_) + 1);
}

/// `node` has the smallest size of all waiting nodes, so no other node can lower it further.
void SizeLimiter::lowerAround(GridNodeId node) {
  for (const auto& [other, length] : std::as_const(spokes_).at(node)) {
    const double limit = nodeOf(*grid_, node).size + growth_ * length;
    double& size = nodeOf(*grid_, other).size;
    if (size <= limit) continue;
    size = limit;
    waiting_.remove(other.value);
    waiting_.push(other.value, keyOf(limit));
  }
}

bool TensorLimiter::advance(std::size_t budget) {
  if (!sort_) {
    if (!finder_.advance(budget)) return false;
    edges_ = finder_.take();
    sort_.emplace(std::span(edges_), Smaller{grid_});
  } else if (!isSorted_) {
    isSorted_ = sort_->advance(budget);
  } else if (sweep_ < kSweeps) {
    const std::size_t last = next_ + std::min(budget, edges_.size() - next_);
    for (; next_ < last; ++next_) {
      limit(edges_[sweep_ % 2 == 0 ? next_ : edges_.size() - 1 - next_]);
    }
    if (next_ == edges_.size()) {
      next_ = 0;
      ++sweep_;
    }
  }
  return sweep_ == kSweeps;
}

void TensorLimiter::limit(const GridEdges::Edge& edge) {
  const SymmetricTensor grown = SymmetricTensor::isotropic(growth_ * edge.length);
  std::vector<SymmetricTensor>& tensors = *tensors_;
  const auto lower = [&](GridNodeId node, GridNodeId by) {
    SymmetricTensor largest = tensors[by.index()];
    largest.accumulate(grown, 1.0);
    tensors[node.index()] = limitedBy(tensors[node.index()], largest);
  };
  lower(edge.a, edge.b);
  lower(edge.b, edge.a);
}

void limitSizes(BackgroundGrid& grid, double growth) { finish(SizeLimiter(grid, growth)); }

void limitTensors(const BackgroundGrid& grid, double growth,
                  std::vector<SymmetricTensor>& tensors) {
  finish(TensorLimiter(grid, growth, tensors));
}

}  // namespace tetrafront
