#include "surface/patch_mesher.h"

#include <algorithm>
#include <utility>

namespace tetrafront {

PatchMesher::PatchMesher(const PatchSurface& surface, const SizeField& field,
                         PatchBoundary boundary)
    : metric_(surface, field),
      mesh_(std::move(boundary.mesh)),
      front_(metric_, mesh_),
      optimizer_(metric_, mesh_) {}

MeshStatus PatchMesher::advance(std::uint32_t budget) {
  // The front and the optimizer both add triangles: check the limit at short intervals, however long the slice.
  constexpr std::uint32_t kCheckInterval = 4096;
  MeshStatus status = MeshStatus::kRunning;
  for (std::uint32_t left = budget; left > 0 && status == MeshStatus::kRunning;) {
    const std::uint32_t step = std::min(left, kCheckInterval);
    status = hasTooManyTriangles() ? MeshStatus::kStalled : work(step);
    left -= step;
  }
  return status;
}

MeshStatus PatchMesher::work(std::uint32_t budget) {
  if (isCovered_) return optimizer_.advance(budget) ? MeshStatus::kDone : MeshStatus::kRunning;
  const MeshStatus status = front_.advance(budget);
  if (status == MeshStatus::kDone) isCovered_ = true;
  return status == MeshStatus::kStalled ? status : MeshStatus::kRunning;
}

}  // namespace tetrafront
