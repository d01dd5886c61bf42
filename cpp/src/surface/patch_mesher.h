#pragma once

/// @file Triangulates one patch (Löhner & Parikh 1988, section 5.2): front in the plane,
/// improvement, nodes on the surface.

#include <cstdint>

#include "surface/patch_boundary.h"
#include "surface/planar_front.h"
#include "surface/planar_optimizer.h"

namespace tetrafront {

/// A patch with more triangles than this is a slip in a size, not a wish.
inline constexpr std::size_t kMaxTrianglesPerPatch = 10'000'000;

class PatchMesher {
 public:
  /// `boundary` must have simple loops. Surface and field must outlive this.
  PatchMesher(const PatchSurface& surface, const SizeField& field, PatchBoundary boundary);
  PatchMesher(const PatchMesher&) = delete;
  PatchMesher& operator=(const PatchMesher&) = delete;

  /// Works on; `budget` counts sides taken from the front, or nodes and triangles improved.
  /// kDone, or kStalled if the front did not close (a fold in the patch's plane).
  MeshStatus advance(std::uint32_t budget);

  /// Complete after kDone. Interior nodes follow the boundary's.
  [[nodiscard]] const PlanarMesh& mesh() const { return mesh_; }
  [[nodiscard]] bool tooMany() const { return mesh_.triangles.size() / 3 > kMaxTrianglesPerPatch; }

 private:
  MeshStatus work(std::uint32_t budget);

  PatchMetric metric_;
  PlanarMesh mesh_;
  PlanarFront front_;
  PlanarOptimizer optimizer_;
  bool covered_ = false;
};

}  // namespace tetrafront
