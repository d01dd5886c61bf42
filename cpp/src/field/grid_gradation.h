#pragma once

/// @file Limits the growth of the sizes of a background grid: along every edge, by at most `growth`
/// times its length. Elements cannot follow faster growth.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/sort.h"
#include "field/grid_access.h"
#include "field/size_tensor.h"
#include "search/indexed_heap.h"
#include "tetrafront/background_grid.h"
#include "topology/node_lists.h"

namespace tetrafront {

/// Finds each edge of a grid once, in slices. O(n) if few tetrahedra share a node.
class GridEdges {
 public:
  struct Edge {
    GridNodeId a;
    GridNodeId b;
    double length;
  };

  /// `grid` must outlive this.
  explicit GridEdges(const BackgroundGrid& grid) : grid_(&grid), others_(grid.nodes.size()) {}

  /// Visits about `budget` tetrahedra; returns true when finished.
  bool advance(std::size_t budget);

  /// Returns the edges, once finished, ordered by their nodes, the lower node first.
  [[nodiscard]] std::vector<Edge> take() { return std::move(edges_); }

 private:
  enum class Stage : std::uint8_t { kCount, kInsert, kCollect, kDone };

  void collectAt(GridNodeId node);

  const BackgroundGrid* grid_;
  Stage stage_ = Stage::kCount;
  std::size_t next_ = 0;
  NodeLists<GridNodeId, GridNodeId>
      others_;  ///< per node: the higher nodes of its edges, once per tetrahedron
  std::vector<Edge> edges_;
};

/// Lowers sizes until size_i <= size_j + growth |x_i - x_j| along every edge. The result is the
/// largest sizes with this property, exactly, so a second call changes nothing. Nodes that already
/// comply keep their bits. O(n log n).
class SizeLimiter {
 public:
  /// `grid` must outlive this and must not move; `growth` > 0.
  SizeLimiter(BackgroundGrid& grid, double growth) : grid_(&grid), growth_(growth), finder_(grid) {}

  /// Visits about `budget` tetrahedra, edges or nodes; returns true when finished.
  bool advance(std::size_t budget);

 private:
  enum class Stage : std::uint8_t { kEdges, kComply, kCount, kInsert, kQueue, kLower, kDone };
  struct Spoke {
    GridNodeId node;
    double length;
  };

  void workOn(std::size_t index);
  void endStage();
  void lowerAround(GridNodeId node);

  BackgroundGrid* grid_;
  double growth_;
  GridEdges finder_;
  Stage stage_ = Stage::kEdges;
  std::size_t next_ = 0;
  std::size_t end_ = 0;
  bool complies_ = true;
  std::vector<GridEdges::Edge> edges_;
  NodeLists<Spoke, GridNodeId> spokes_;
  IndexedHeap waiting_;
};

/// Limits every axis of stretched nodes: three sweeps of H_i <= H_j + growth |x_i - x_j| I over the
/// edges, in alternating directions, small sizes first. A limit then acts over at least three
/// edges, and over any number of edges towards larger sizes. An exact fixpoint is not worth its
/// cost.
class TensorLimiter {
 public:
  /// `grid` and `tensors` must outlive this and must not move; `growth` > 0.
  TensorLimiter(const BackgroundGrid& grid, double growth, std::vector<SymmetricTensor>& tensors)
      : grid_(&grid), growth_(growth), tensors_(&tensors), finder_(grid) {}

  /// Visits about `budget` tetrahedra or edges; returns true when finished.
  bool advance(std::size_t budget);

 private:
  struct Smaller {
    const BackgroundGrid* grid;
    [[nodiscard]] double sizeOf(const GridEdges::Edge& edge) const {
      return std::min(nodeOf(*grid, edge.a).size, nodeOf(*grid, edge.b).size);
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
  std::size_t next_ = 0;  ///< next edge of the sweep
};

/// Do the whole work in one call.
void limitSizes(BackgroundGrid& grid, double growth);
void limitTensors(const BackgroundGrid& grid, double growth, std::vector<SymmetricTensor>& tensors);

}  // namespace tetrafront
