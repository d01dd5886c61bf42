#pragma once

/// @file Triangulates one patch (Löhner & Parikh 1988, section 5.2): advances a front in the plane, improves the
/// triangulation, and places its nodes on the surface.

#include <cstdint>

#include "surface/patch_boundary.h"
#include "surface/planar_front.h"
#include "surface/planar_optimizer.h"

namespace tetrafront {

/// Limit of the triangles of one patch. More of them mean that a size was mistyped.
inline constexpr std::size_t kMaxTrianglesPerPatch = 10'000'000;

template <class Trace>
class BasicPatchMesher {
 public:
  /// `boundary` must have simple loops. Surface and field must outlive this.
  BasicPatchMesher(const PatchSurface& surface, const SizeField& field, PatchBoundary boundary,
                   Trace trace = {});
  BasicPatchMesher(const BasicPatchMesher&) = delete;
  BasicPatchMesher& operator=(const BasicPatchMesher&) = delete;

  /// Takes about `budget` edges from the front, or improves as many nodes and triangles; returns true when finished.
  bool advance(std::uint32_t budget);

  /// After advance() has returned true: false if the front did not close (the patch folds over itself in its plane)
  /// or if there are too many triangles.
  [[nodiscard]] bool isComplete() const { return isImproved_; }
  /// Interior nodes follow the boundary's.
  [[nodiscard]] const PlanarMesh& mesh() const { return mesh_; }
  [[nodiscard]] bool hasTooManyTriangles() const {
    return mesh_.triangles.size() > kMaxTrianglesPerPatch;
  }

 private:
  [[nodiscard]] bool isFinished() const;
  void step(std::uint32_t budget);

  PatchMetric metric_;
  PlanarMesh mesh_;
  BasicPlanarFront<Trace> front_;
  PlanarOptimizer optimizer_;
  bool isCovered_ = false;
  bool hasStalled_ = false;
  bool isImproved_ = false;
  [[no_unique_address]] Trace trace_;
};

extern template class BasicPatchMesher<NullSurfaceTrace>;
extern template class BasicPatchMesher<RecordingSurfaceTrace>;

using PatchMesher = BasicPatchMesher<NullSurfaceTrace>;

}  // namespace tetrafront
