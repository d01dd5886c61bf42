#pragma once

/// @file In which regions the components of a surface lie.

#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/cell_regions.h"
#include "base/ids.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Returns how often the regions of other components wind around each component. `mesh`: with triangleRegions. `componentOf`: one
/// component per triangle; kNoIndex if the triangle bounds nothing, kInPart if only a part of it does. Triangles of different
/// components have at most single points in common. Exact. O(n log n) for n triangles, and O(triangles near a ray) per component.
[[nodiscard]] std::vector<RegionWindings> findRegionsAround(
    const SurfaceMesh& mesh, std::span<const std::uint32_t> componentOf, std::uint32_t components);

inline constexpr std::uint32_t kInPart = kNoIndex - 1;

}  // namespace tetrafront
