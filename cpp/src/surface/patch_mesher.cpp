#include "surface/patch_mesher.h"

#include <utility>

namespace tetrafront {

PatchMesher::PatchMesher(const PatchSurface& surface, const SizeField& field,
                         PatchBoundary boundary)
    : metric_(surface, field),
      mesh_(std::move(boundary.mesh)),
      front_(metric_, mesh_),
      optimizer_(metric_, mesh_) {}

MeshStatus PatchMesher::advance(std::uint32_t budget) {
  // The front makes triangles, and so does the optimizer where it divides sides.
  if (tooMany()) return MeshStatus::kStalled;
  if (covered_) return optimizer_.advance(budget) ? MeshStatus::kDone : MeshStatus::kRunning;
  const MeshStatus status = front_.advance(budget);
  if (status == MeshStatus::kDone) covered_ = true;
  return status == MeshStatus::kStalled ? status : MeshStatus::kRunning;
}

}  // namespace tetrafront
