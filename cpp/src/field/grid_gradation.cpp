#include "field/grid_gradation.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "base/free_memory.h"
#include "base/ids.h"
#include "base/sort.h"
#include "field/grid_access.h"
#include "field/tensor_limits.h"
#include "search/indexed_heap.h"
#include "topology/node_lists.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

constexpr int kSweeps = 3;

struct GridEdge {
  GridNodeId a;
  GridNodeId b;
  double length;
};

/// An edge, as one of its nodes sees it.
struct Spoke {
  GridNodeId node;
  double length;
};

/// `co_await` it: calls visit(low, high) with the nodes of every edge of every tetrahedron.
template <class Visit>
auto forEachTetEdge(Work& work, const BackgroundGrid& grid, Visit visit) {
  const auto visitTet = [&grid, visit](GridTetId tet) {
    const GridNodeQuad nodes = nodesOf(grid, tet);
    for (const TetEdge& edge : kTetEdges) {
      const auto [low, high] = std::minmax(nodes[edge.from], nodes[edge.to]);
      visit(low, high);
    }
  };
  return work.forEachId<GridTetId>(grid.tetrahedra.size(), visitTet, kGridVisitsPerUnit);
}

/// `co_await` it: calls visit(edge) for every edge.
template <class Visit>
auto forEachEdge(Work& work, std::span<const GridEdge> edges, Visit visit) {
  const auto visitIndex = [edges, visit](std::size_t i) { visit(edges[i]); };
  return work.forEachId<std::size_t>(edges.size(), visitIndex, kGridVisitsPerUnit);
}

/// Returns each edge once, ordered by their nodes, the lower node first. O(n) if few tetrahedra share a node.
Task<std::vector<GridEdge>> findEdges(Work& work, const BackgroundGrid& grid) {
  // Per node: the higher nodes of its edges, once per tetrahedron.
  NodeLists<GridNodeId, GridNodeId> higher(grid.nodes.size());
  work.beginPart(0.3);
  co_await forEachTetEdge(work, grid, [&](GridNodeId low, GridNodeId) { higher.count(low); });
  higher.endCounting();
  work.beginPart(0.6);
  co_await forEachTetEdge(work, grid,
                          [&](GridNodeId low, GridNodeId high) { higher.add(low, high); });
  std::vector<GridEdge> edges;
  const auto collectAt = [&](GridNodeId node) {
    const std::span<GridNodeId> others = higher.at(node);
    sortFew(others);
    for (std::size_t i = 0; i < others.size(); ++i) {
      if (i > 0 && others[i] == others[i - 1]) continue;
      const Vec3 along = positionOf(grid, node) - positionOf(grid, others[i]);
      edges.push_back({node, others[i], glm::length(along)});
    }
  };
  work.beginPart(1.0);
  co_await work.forEachId<GridNodeId>(grid.nodes.size(), collectAt, kGridVisitsPerUnit);
  co_return edges;
}

double smallerSizeOf(const BackgroundGrid& grid, const GridEdge& edge) {
  return std::min(nodeOf(grid, edge.a).size, nodeOf(grid, edge.b).size);
}

/// Nodes that may lower the sizes of others, the smallest size first.
class WaitingNodes {
 public:
  WaitingNodes(BackgroundGrid& grid, double growth) : grid_(grid), growth_(growth) {
    heap_.reserveIds(grid.nodes.size());
  }

  void push(GridNodeId node) {
    // Positive doubles have the same order as their bit patterns.
    heap_.push(node.value, std::bit_cast<std::uint64_t>(nodeOf(grid_, node).size));
  }
  [[nodiscard]] bool isEmpty() const { return heap_.empty(); }

  /// No other node can lower the size of the first one further.
  void lowerAroundFirst(const NodeLists<Spoke, GridNodeId>& spokes) {
    const GridNodeId node(heap_.pop());
    for (const auto& [other, length] : spokes.at(node)) {
      const double limit = nodeOf(grid_, node).size + growth_ * length;
      double& size = nodeOf(grid_, other).size;
      if (size <= limit) continue;
      size = limit;
      heap_.remove(other.value);
      push(other);
    }
  }

 private:
  BackgroundGrid& grid_;
  double growth_;
  IndexedHeap heap_;
};

/// Returns the largest tensor beside one at the other end of an edge.
SymmetricTensor grownUniformly(const SymmetricTensor& tensor, double growth) {
  SymmetricTensor largest = tensor;
  largest.accumulate(SymmetricTensor::isotropic(growth), 1.0);
  return largest;
}

/// Returns the largest tensor with the directions and ratios of one at the other end of an edge.
SymmetricTensor grownInRatio(const SymmetricTensor& tensor, const Vec3& along, double growth) {
  return tensor.scaledBy(1.0 + growth * glm::length(tensor.inverse() * along));
}

void limitAlong(const BackgroundGrid& grid, const GridEdge& edge, double growth,
                std::vector<SymmetricTensor>& tensors) {
  const bool keepsRatios = !grid.secondStretchings.empty();
  const Vec3 along = positionOf(grid, edge.b) - positionOf(grid, edge.a);
  const auto lower = [&](GridNodeId node, GridNodeId by) {
    const SymmetricTensor& other = tensors[by.index()];
    tensors[node.index()] =
        limitedBy(tensors[node.index()], keepsRatios ? grownInRatio(other, along, growth)
                                                     : grownUniformly(other, growth * edge.length));
  };
  lower(edge.a, edge.b);
  lower(edge.b, edge.a);
}

}  // namespace

Task<> limitSizes(Work& work, BackgroundGrid& grid, double growth) {
  work.beginPart(0.4);
  std::vector<GridEdge> edges = co_await findEdges(work, grid);
  bool comply = true;
  work.beginPart(0.5);
  co_await forEachEdge(work, edges, [&](const GridEdge& edge) {
    const auto [smaller, larger] =
        std::minmax(nodeOf(grid, edge.a).size, nodeOf(grid, edge.b).size);
    comply = comply && larger <= smaller + growth * edge.length;
  });
  if (comply) co_return;

  NodeLists<Spoke, GridNodeId> spokes(grid.nodes.size());
  work.beginPart(0.6);
  co_await forEachEdge(work, edges, [&](const GridEdge& edge) {
    spokes.count(edge.a);
    spokes.count(edge.b);
  });
  spokes.endCounting();
  work.beginPart(0.7);
  co_await forEachEdge(work, edges, [&](const GridEdge& edge) {
    spokes.add(edge.a, {edge.b, edge.length});
    spokes.add(edge.b, {edge.a, edge.length});
  });
  freeMemory(edges);

  WaitingNodes waiting(grid, growth);
  work.beginPart(0.8);
  co_await work.forEachId<GridNodeId>(
      grid.nodes.size(), [&](GridNodeId node) { waiting.push(node); }, kGridVisitsPerUnit);
  work.beginPart(1.0);
  while (!waiting.isEmpty()) {
    for (std::size_t i = 0; i < kGridVisitsPerUnit && !waiting.isEmpty(); ++i)
      waiting.lowerAroundFirst(spokes);
    co_await work.spend(1);
  }
}

Task<> limitTensors(Work& work, const BackgroundGrid& grid, double growth,
                    std::vector<SymmetricTensor>& tensors) {
  work.beginPart(0.4);
  std::vector<GridEdge> edges = co_await findEdges(work, grid);
  SlicedSort sort(std::span{edges}, [&grid](const GridEdge& x, const GridEdge& y) {
    return smallerSizeOf(grid, x) < smallerSizeOf(grid, y);
  });
  work.beginPart(0.6);
  co_await work.finish(sort, kGridVisitsPerUnit);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    work.beginPart(0.6 + 0.4 * (sweep + 1) / kSweeps);
    co_await forEachEdge(work, edges,
                         [&](const GridEdge& edge) { limitAlong(grid, edge, growth, tensors); });
    std::ranges::reverse(edges);
  }
}

}  // namespace tetrafront
