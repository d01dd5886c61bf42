#pragma once

/// @file The result of an adaptation as flat arrays, with its statistics.

#include <cstdint>
#include <vector>

#include "adapt/adapt_start.h"
#include "base/task.h"
#include "tetrafront/mesh.h"
#include "tetrafront/mesh_adaptation.h"

namespace tetrafront {

/// Measures lengths and qualities in the metrics of the nodes.
Task<MetricStatistics> measureInMetric(Work& work, const AdaptMesh& mesh);

/// An adapted mesh of parts, with its boundary and the kept triangles.
struct AdaptedMesh {
  VolumeMesh mesh;      ///< with the part of each element; nodes of the surface first
  SurfaceMesh surface;  ///< with parts as regions
  std::vector<double> metrics;
};

/// Returns the mesh. `start.mesh` is the adapted mesh; nodes of one origin become one again.
[[nodiscard]] AdaptedMesh takeAdapted(const AdaptStart& start, const GivenMesh& given,
                                      const BoundaryGuide& guide,
                                      std::span<const std::uint32_t> keptPatches);

}  // namespace tetrafront
