#pragma once

/// @file Keeps the sizes of a background grid from growing faster than elements can follow: along
/// every edge of the grid, by no more than `growth` times its length.

#include <vector>

#include "field/size_tensor.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

/// Lowers sizes until size_i <= size_j + growth |x_i - x_j| along every edge: the largest sizes
/// for which that holds, exactly, so that doing it again changes nothing. Nodes that comply keep
/// their bits. `growth` > 0. O(n log n).
void limitSizes(BackgroundGrid& grid, double growth);

/// The same for every axis of stretched nodes: three sweeps of H_i <= H_j + growth |x_i - x_j| I
/// over the edges, to and fro, small sizes first. A limit has then travelled at least three edges,
/// and as far as it likes towards larger sizes; what is left beyond is not worth an exact fixpoint.
void limitTensors(const BackgroundGrid& grid, double growth, std::vector<SymmetricTensor>& tensors);

}  // namespace tetrafront
