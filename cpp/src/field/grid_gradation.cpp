#include "field/grid_gradation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "base/sort.h"
#include "field/tensor_limits.h"
#include "search/indexed_heap.h"

namespace tetrafront {
namespace {

constexpr int kSweeps = 3;

struct Edge {
  std::uint32_t a;
  std::uint32_t b;
  double length;
};

constexpr std::array<std::pair<std::size_t, std::size_t>, 6> kTetrahedronEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Each edge once, by its nodes.
std::vector<Edge> edgesOf(const BackgroundGrid& grid) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  pairs.reserve(6 * grid.tetrahedra.size());
  for (const auto& tet : grid.tetrahedra) {
    for (const auto& [i, j] : kTetrahedronEdges) pairs.push_back(std::minmax({tet[i], tet[j]}));
  }
  sortUnique(pairs);
  std::vector<Edge> edges;
  edges.reserve(pairs.size());
  for (const auto& [a, b] : pairs) {
    edges.push_back({a, b, glm::length(grid.nodes[a].position - grid.nodes[b].position)});
  }
  return edges;
}

bool complies(const BackgroundGrid& grid, const std::vector<Edge>& edges, double growth) {
  return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
    const double a = grid.nodes[edge.a].size;
    const double b = grid.nodes[edge.b].size;
    return std::max(a, b) <= std::min(a, b) + growth * edge.length;
  });
}

/// The edges at each node.
struct Spokes {
  struct Spoke {
    std::uint32_t node;
    double length;
  };
  std::vector<std::uint32_t> first;
  std::vector<Spoke> spokes;

  Spokes(std::size_t nodes, const std::vector<Edge>& edges)
      : first(nodes + 1, 0), spokes(2 * edges.size()) {
    for (const Edge& edge : edges) {
      ++first[edge.a + 1];
      ++first[edge.b + 1];
    }
    for (std::size_t i = 0; i < nodes; ++i) first[i + 1] += first[i];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const Edge& edge : edges) {
      spokes[next[edge.a]++] = {edge.b, edge.length};
      spokes[next[edge.b]++] = {edge.a, edge.length};
    }
  }
};

/// Positive doubles are ordered as their bits are.
std::uint64_t keyOf(double size) { return std::bit_cast<std::uint64_t>(size); }

}  // namespace

void limitSizes(BackgroundGrid& grid, double growth) {
  const std::vector<Edge> edges = edgesOf(grid);
  if (complies(grid, edges, growth)) return;
  const Spokes at(grid.nodes.size(), edges);
  IndexedHeap waiting;
  waiting.reserveIds(grid.nodes.size());
  for (std::uint32_t i = 0; i < grid.nodes.size(); ++i) waiting.push(i, keyOf(grid.nodes[i].size));
  while (!waiting.empty()) {
    // The least of all that wait: nobody can lower it any more.
    const std::uint32_t node = waiting.pop();
    for (std::uint32_t s = at.first[node]; s < at.first[node + 1]; ++s) {
      const auto& [other, length] = at.spokes[s];
      const double limit = grid.nodes[node].size + growth * length;
      if (grid.nodes[other].size <= limit) continue;
      grid.nodes[other].size = limit;
      waiting.remove(other);
      waiting.push(other, keyOf(limit));
    }
  }
}

void limitTensors(const BackgroundGrid& grid, double growth,
                  std::vector<SymmetricTensor>& tensors) {
  std::vector<Edge> edges = edgesOf(grid);
  const auto smaller = [&grid](const Edge& edge) {
    return std::min(grid.nodes[edge.a].size, grid.nodes[edge.b].size);
  };
  stableSort(edges, [&](const Edge& x, const Edge& y) { return smaller(x) < smaller(y); });
  const auto limit = [&](const Edge& edge) {
    const SymmetricTensor grown = SymmetricTensor::isotropic(growth * edge.length);
    const auto lower = [&](std::uint32_t node, std::uint32_t by) {
      SymmetricTensor most = tensors[by];
      most.accumulate(grown, 1.0);
      tensors[node] = limitedBy(tensors[node], most);
    };
    lower(edge.a, edge.b);
    lower(edge.b, edge.a);
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    std::for_each(edges.begin(), edges.end(), limit);
    std::reverse(edges.begin(), edges.end());
  }
}

}  // namespace tetrafront
