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
  if (covered_) return optimizer_.advance(budget) ? MeshStatus::kDone : MeshStatus::kRunning;
  const MeshStatus status = front_.advance(budget);
  if (status == MeshStatus::kDone) covered_ = true;
  if (status == MeshStatus::kStalled || tooMany()) return MeshStatus::kStalled;
  return MeshStatus::kRunning;
}

}  // namespace tetrafront
