#pragma once

/// @file Which points keep a planar patch from being one.

#include <cstdint>
#include <vector>

#include "tetrafront/model.h"

namespace tetrafront {

/// Lines of a planar patch may leave its plane by this share of the patch's extent: coordinates
/// typed with four digits pass. Nodes on such a line stay on the line, so nothing opens.
inline constexpr double kPlaneTolerance = 1e-4;

/// Points off the plane that most points of a patch's lines agree on.
struct MovedPoints {
  std::vector<std::uint32_t> points;  ///< the farthest first; empty if most agree on no plane
  double distance = 0.0;              ///< of the first, from that plane
};

class MovedPointFinder {
 public:
  /// The model must outlive this.
  explicit MovedPointFinder(const Model& model) : model_(&model) {}

  /// Of several planes as good, as four points always have, one is taken whose points belong to most
  /// patches that are not plane, then one along the axes. `patch` must refer to points that exist,
  /// other patches need not; `extent` is its size. The first call takes O(n log n) in the model,
  /// others in the points of the patch.
  [[nodiscard]] MovedPoints find(std::uint32_t patch, double extent);

 private:
  void countBentPatches();

  const Model* model_;
  /// Per point: planar patches it belongs to whose points lie in no one plane. Empty until wanted.
  std::vector<std::uint32_t> bentPatches_;
};

}  // namespace tetrafront
