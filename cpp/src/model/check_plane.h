#pragma once

/// @file Finds the points that keep a planar patch from being planar.

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "tetrafront/model.h"

namespace tetrafront {

/// Largest distance of a planar patch's lines from its plane, relative to the patch's extent:
/// coordinates typed with four digits pass. Nodes on such a line stay on the line, so the surface
/// remains closed.
inline constexpr double kPlaneTolerance = 1e-4;

/// Points off the plane that most points of a patch's lines share.
struct MovedPoints {
  std::vector<PointId> points;  ///< farthest first; empty if most points share no plane
  double distance = 0.0;        ///< distance of the first point from that plane
};

class MovedPointFinder {
 public:
  /// The model must outlive this.
  explicit MovedPointFinder(const Model& model) : model_(&model) {}

  /// If several planes have equally many points, as with any four points, prefers the one whose
  /// points off it belong to the most non-planar patches, then one along the axes. `patch` must
  /// refer to existing points; other patches need not. `extent` is its size. The first call takes
  /// O(n log n) in the model, later ones depend on the points of the patch.
  [[nodiscard]] MovedPoints find(PatchId patch, double extent);

 private:
  void countBentPatches();

  const Model* model_;
  /// Per point: number of its planar patches whose points share no plane. Empty until needed.
  std::vector<std::uint32_t> bentPatches_;
};

}  // namespace tetrafront
