#pragma once

/// @file Keeps the sizes of a background grid from growing faster than elements can follow: along
/// every edge of the grid, by no more than `growth` times its length.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "field/size_tensor.h"
#include "search/incidence.h"
#include "search/indexed_heap.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

/// Each edge of a grid once, found in slices: O(n) for grids with few tetrahedra at a node.
class GridEdges {
 public:
  struct Edge {
    std::uint32_t a;
    std::uint32_t b;
    double length;
  };

  /// `grid` must outlive this.
  explicit GridEdges(const BackgroundGrid& grid) : grid_(&grid), others_(grid.nodes.size()) {}

  /// Goes on for about `budget` tetrahedra; true when finished.
  bool advance(std::size_t budget);

  /// By their nodes, the lower first; once, when finished.
  [[nodiscard]] std::vector<Edge> take() { return std::move(edges_); }

 private:
  enum class Stage : std::uint8_t { kCount, kPlace, kCollect, kDone };

  void collectAt(std::uint32_t node);

  const BackgroundGrid* grid_;
  Stage stage_ = Stage::kCount;
  std::size_t next_ = 0;
  NodeLists<std::uint32_t>
      others_;  ///< at the lower node of an edge: the higher, once per tetrahedron
  std::vector<Edge> edges_;
};

/// Lowers sizes until size_i <= size_j + growth |x_i - x_j| along every edge: the largest sizes
/// for which that holds, exactly, so that doing it again changes nothing. Nodes that comply keep
/// their bits. O(n log n).
class SizeLimiter {
 public:
  /// `grid` must outlive this, and stay where it is; `growth` > 0.
  SizeLimiter(BackgroundGrid& grid, double growth) : grid_(&grid), growth_(growth), finder_(grid) {}

  /// Goes on for about `budget` tetrahedra, edges or nodes; true when finished.
  bool advance(std::size_t budget);

 private:
  enum class Stage : std::uint8_t { kEdges, kComply, kCount, kPlace, kQueue, kLower, kDone };
  struct Spoke {
    std::uint32_t node;
    double length;
  };

  void workOn(std::size_t position);
  void endStage();
  void lowerAround(std::uint32_t node);

  BackgroundGrid* grid_;
  double growth_;
  GridEdges finder_;
  Stage stage_ = Stage::kEdges;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  bool complies_ = true;
  std::vector<GridEdges::Edge> edges_;
  NodeLists<Spoke> spokes_;
  IndexedHeap waiting_;
};

/// The same for every axis of stretched nodes: three sweeps of H_i <= H_j + growth |x_i - x_j| I
/// over the edges, to and fro, small sizes first. A limit has then travelled at least three edges,
/// and as far as it likes towards larger sizes; what is left beyond is not worth an exact fixpoint.
class TensorLimiter {
 public:
  /// `grid` and `tensors` must outlive this, and stay where they are; `growth` > 0.
  TensorLimiter(const BackgroundGrid& grid, double growth, std::vector<SymmetricTensor>& tensors)
      : grid_(&grid), growth_(growth), tensors_(&tensors), finder_(grid) {}

  /// Goes on for about `budget` tetrahedra or edges; true when finished.
  bool advance(std::size_t budget);

 private:
  struct Smaller {
    const BackgroundGrid* grid;
    [[nodiscard]] double sizeOf(const GridEdges::Edge& edge) const {
      return std::min(grid->nodes[edge.a].size, grid->nodes[edge.b].size);
    }
    bool operator()(const GridEdges::Edge& x, const GridEdges::Edge& y) const {
      return sizeOf(x) < sizeOf(y);
    }
  };

  void limit(const GridEdges::Edge& edge);

  const BackgroundGrid* grid_;
  double growth_;
  std::vector<SymmetricTensor>* tensors_;
  GridEdges finder_;
  std::vector<GridEdges::Edge> edges_;
  std::optional<SlicedSort<GridEdges::Edge, Smaller>> sort_;
  bool isSorted_ = false;
  int sweep_ = 0;
  std::size_t next_ = 0;  ///< of the sweep
};

/// All at once.
void limitSizes(BackgroundGrid& grid, double growth);
void limitTensors(const BackgroundGrid& grid, double growth, std::vector<SymmetricTensor>& tensors);

}  // namespace tetrafront
