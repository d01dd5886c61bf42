#pragma once

/// @file Volumes that overlapping regions share, added up for each pair of regions.

#include <span>
#include <vector>

#include "arrangement/part_shells.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// Returns the volume that each pair of regions shares, in the order of the regions. A cell in several regions counts for each
/// pair of the first of them, which gets it, with another one. Depth and position are those of the pair's largest cell.
/// O(n log n) for n cells.
[[nodiscard]] std::vector<SharedVolume> findSharedVolumes(std::span<const SharedCell> cells);

}  // namespace tetrafront
