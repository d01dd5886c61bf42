#pragma once

/// @file Limits the growth of the sizes of a background grid: along every edge, by at most `growth`
/// times its length. Elements cannot follow faster growth.

#include <cstddef>
#include <vector>

#include "base/task.h"
#include "field/size_tensor.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

/// Nodes, edges or tetrahedra of a grid per unit of budget: visiting one costs far less than a step
/// of the front.
inline constexpr std::size_t kGridVisitsPerUnit = 8;

/// Lowers sizes until size_i <= size_j + growth |x_i - x_j| along every edge. The result is the
/// largest sizes with this property, exactly, so a second call changes nothing. Nodes that already
/// comply keep their bits. `growth` > 0. O(n log n).
Task<> limitSizes(Work& work, BackgroundGrid& grid, double growth);

/// Limits every axis of stretched nodes: three sweeps of H_i <= H_j + growth |x_i - x_j| I over the
/// edges, in alternating directions, small sizes first. In a grid with second stretchings, the
/// limit is (1 + growth l) H_j instead, where l is the length of the edge in target lengths of node
/// j: directions and ratios are kept, as in metric/mesh_metric.h, so that thin elements stay thin
/// along their layer. A limit then acts over at least three
/// edges, and over any number of edges towards larger sizes. An exact fixpoint is not worth its
/// cost. `growth` > 0.
Task<> limitTensors(Work& work, const BackgroundGrid& grid, double growth,
                    std::vector<SymmetricTensor>& tensors);

}  // namespace tetrafront
