#pragma once

/// @file Layers of stretched elements along walls: thin across the wall, as long as the mesh is coarse along it.

#include <cstdint>
#include <vector>

#include "tetrafront/mesh_adaptation.h"
#include "tetrafront/sliced_tool.h"

namespace tetrafront {

/// The layers of one patch. Layer k, counted from 0 at the wall, is firstHeight growth^k high.
struct PatchLayers {
  std::uint32_t patch = 0;
  double firstHeight = 0.0;  ///< > 0
  double growth = 1.2;       ///< height of a layer / height of the one below, >= 1
  std::uint32_t count = 10;  ///< number of layers, >= 1
};

/// Limits of the sizes, and of the work.
struct LayerOptions {
  double maxAspect = 1000.0;  ///< largest size along a wall / size across it, from 1 to 1e6
  /// Growth of all sizes per unit of distance, > 0. If layers grow faster, their growth is that of all sizes.
  double growth = 0.5;
  /// Cycles of metric and adaptation at most; they end earlier when the number of elements settles.
  std::uint32_t cycles = 8;
};

/// What was made along one patch.
struct PatchLayersMade {
  std::uint32_t patch = 0;
  std::uint32_t triangles = 0;   ///< of the patch, without those between regions
  double meanFirstHeight = 0.0;  ///< mean height of the elements above these triangles
  double thickness = 0.0;        ///< of all layers that were asked for
};

/// Result of LayerMaker. If `adaptation` is not readable or has a diagnostic of severity kError, nothing else is set.
struct LayeredMesh {
  MeshAdaptation adaptation;           ///< of the last cycle; `before` belongs to the given mesh
  std::vector<PatchLayersMade> walls;  ///< in the order of the given ones
  std::uint32_t cycles = 0;            ///< number of adaptations
  /// Largest ratio of the axes of the ellipsoid through the corners of an element.
  double largestAspect = 0.0;
};

/// Makes layers along patches of the boundary of a mesh, in cycles: a metric at the nodes of the mesh, then the adaptation
/// to it. At a distance d from a wall, the size across it is that of the layer that contains d. Sizes along the wall
/// are those of `background`, or of the mesh if it has no nodes; they are smaller where the wall bends. Where the
/// layers of several walls meet, sizes are small in the directions of all of them. A unit of work is about one element. After
/// stop(), the result is the mesh as it then was, which is valid, too.
class LayerMaker : public SlicedTool<LayeredMesh> {
 public:
  /// Triangles of walls are part of `mesh`; those inside, between regions, have no layers.
  /// `walls`: at least one, at most one per patch.
  LayerMaker(AdaptInput mesh, MetricMesh background, const AdaptOptions& adaptation,
             std::vector<PatchLayers> walls, const LayerOptions& options);
};

}  // namespace tetrafront
