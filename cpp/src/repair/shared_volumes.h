#pragma once

/// @file Volumes that overlapping regions share, summed up by pairs of regions.

#include <span>
#include <vector>

#include "arrangement/part_shells.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// Returns what pairs of regions share, in the order of the regions. A volume in several regions counts for each pair of the
/// first of them, which gets it, with another one. Depth and position are those of the pair's largest volume.
/// O(n log n) for n cells.
std::vector<SharedVolume> findSharedVolumes(std::span<const SharedCell> cells);

}  // namespace tetrafront
