#include "volume/recorded_front.h"

namespace tetrafront {

std::uint64_t RecordingTrace::searchLinearly(const Front& front, const Box& box) const {
  if (!experiment_.linearSearch) return 0;
  std::uint64_t count = 0;
  for (const FaceId face : IdRange<FaceId>(front.slotCount())) {
    if (!front.face(face).active) continue;
    const Box own = front.boxOf(face);
    bool overlaps = true;
    for (int axis = 0; axis < 3; ++axis) {
      overlaps = overlaps && own.low[axis] <= box.high[axis] && box.low[axis] <= own.high[axis];
    }
    count += overlaps ? 1 : 0;
  }
  return count;
}

std::unique_ptr<FrontAdvance> RecordingFrontMaker::make(Front& front, Elements& elements,
                                                        const SizeField& field,
                                                        bool filters) const {
  return std::make_unique<TracedFrontAdvance<RecordingTrace>>(
      front, elements, field, filters, RecordingTrace(recorder_, experiment_));
}

}  // namespace tetrafront
