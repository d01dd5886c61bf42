#include "surface/patch_mesher.h"

#include <algorithm>
#include <utility>

namespace tetrafront {

template <class Trace>
BasicPatchMesher<Trace>::BasicPatchMesher(const PatchSurface& surface, const SizeField& field,
                                          PatchBoundary boundary, Trace trace)
    : metric_(surface, field),
      mesh_(std::move(boundary.mesh)),
      front_(metric_, mesh_, trace),
      optimizer_(metric_, mesh_),
      trace_(trace) {}

template <class Trace>
bool BasicPatchMesher<Trace>::advance(std::uint32_t budget) {
  // The front and the optimizer both add triangles: check the limit at short intervals, however long the slice.
  constexpr std::uint32_t kCheckInterval = 4096;
  for (std::uint32_t left = budget; left > 0 && !isFinished();) {
    const std::uint32_t units = std::min(left, kCheckInterval);
    step(units);
    left -= units;
  }
  return isFinished();
}

template <class Trace>
bool BasicPatchMesher<Trace>::isFinished() const {
  return isImproved_ || hasStalled_ || hasTooManyTriangles();
}

template <class Trace>
void BasicPatchMesher<Trace>::step(std::uint32_t budget) {
  if (isCovered_) {
    isImproved_ = optimizer_.advance(budget);
    if (isImproved_) trace_->improved(mesh_);
  } else if (front_.advance(budget)) {
    hasStalled_ = front_.hasStalled();
    isCovered_ = !hasStalled_;
    trace_->ended(mesh_, hasStalled_ ? PlanarFrontEnd::kStalled : PlanarFrontEnd::kCovered);
  }
}

template class BasicPatchMesher<NullSurfaceTrace>;
template class BasicPatchMesher<RecordingSurfaceTrace>;

}  // namespace tetrafront
