#pragma once

/// @file The metric of layers along walls, at any position.

#include <cstdint>
#include <span>
#include <vector>

#include "layers/wall_surface.h"
#include "metric/symmetric_tensor.h"
#include "tetrafront/mesh.h"
#include "tetrafront/wall_layers.h"

namespace tetrafront {

/// Sizes across the layers of one patch.
class LayerSizes {
 public:
  LayerSizes(const PatchLayers& layers, double growthBeyond);

  /// Thickness of all layers.
  [[nodiscard]] double thickness() const { return thickness_; }
  /// Returns the length of an edge across the layers at a distance from the wall.
  [[nodiscard]] double at(double distance) const;
  /// Returns the distance from which on sizes are at least `size`.
  [[nodiscard]] double reach(double size) const;

 private:
  double first_;
  double growth_;        ///< per unit of distance in the layers
  double growthBeyond_;  ///< the same beyond them
  double thickness_ = 0.0;
  double last_;  ///< height at the thickness
  double edgePerHeight_;
};

class LayerMetric {
 public:
  /// `boundary` must outlive this. `maxSize`: largest size of the mesh without layers.
  LayerMetric(const SurfaceMesh& boundary, std::span<const PatchLayers> walls,
              const LayerOptions& options, double maxSize);

  /// Returns the metric at a position: `base`, intersected with those of the walls. `current`: the metric of the mesh that the
  /// position belongs to. Sizes across walls do not fall below a fraction of its sizes, so a coarse mesh is approached in steps;
  /// `isLimited` becomes true if that counted.
  [[nodiscard]] SymmetricTensor at(const Vec3& position, const SymmetricTensor& base,
                                   const SymmetricTensor& current, bool& isLimited) const;

 private:
  [[nodiscard]] SymmetricTensor ofWall(const WallPoint& wall, const Vec3& position,
                                       const SymmetricTensor& current, bool& isLimited) const;

  double maxAspect_;
  std::vector<LayerSizes> sizes_;       ///< per given patch
  std::vector<std::uint32_t> sizesOf_;  ///< per triangle of the boundary
  double reach_ = 0.0;
  WallSurface walls_;
};

}  // namespace tetrafront
