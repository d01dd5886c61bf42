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

bool PatchMesher::advance(std::uint32_t budget) {
  // The front and the optimizer both add triangles: check the limit at short intervals, however long the slice.
  constexpr std::uint32_t kCheckInterval = 4096;
  for (std::uint32_t left = budget; left > 0 && !isFinished();) {
    const std::uint32_t units = std::min(left, kCheckInterval);
    step(units);
    left -= units;
  }
  return isFinished();
}

bool PatchMesher::isFinished() const { return isImproved_ || hasStalled_ || hasTooManyTriangles(); }

void PatchMesher::step(std::uint32_t budget) {
  if (isCovered_) {
    isImproved_ = optimizer_.advance(budget);
  } else if (front_.advance(budget)) {
    hasStalled_ = front_.hasStalled();
    isCovered_ = !hasStalled_;
  }
}

}  // namespace tetrafront
