#pragma once

/// @file Meshes to be improved, their improvement, and slow measures of their elements.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/mesh_improvement.h"
#include "tetrafront/options.h"

namespace tetrafront::testing {

/// Fills a surface; expects success.
VolumeMesh meshed(const SurfaceMesh& surface, const MeshOptions& options);

/// The mesh of the front: none of its elements was improved.
VolumeMesh meshOfFront(const SurfaceMesh& surface);

/// A mesh with few nodes and elements of almost no volume.
VolumeMesh poorMesh(const SurfaceMesh& surface);

MeshImprovement improved(const VolumeMesh& mesh, const std::vector<std::uint32_t>& kept = {},
                         const ImproveOptions& options = {});

using Position = std::array<double, 3>;
Position positionOf(const std::vector<double>& points, std::uint32_t node);

/// What an improvement may not make worse, by formulas of solid geometry that the engine does not use. Angles in degrees.
struct SlowShapes {
  double leastAngle = 180.0;
  double greatestAngle = 0.0;
  double leastRatio = 1.0;
  double meanRatio = 0.0;
  double shareOutside = 0.0;  ///< of elements with an angle outside 30 to 135 degrees
};
SlowShapes slowShapesOf(const std::vector<double>& points,
                        const std::vector<std::uint32_t>& tetrahedra);

}  // namespace tetrafront::testing
