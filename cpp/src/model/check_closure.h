#pragma once

/// @file Checks whether the patches close a surface, as far as the loops alone show it.

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "model/check_model.h"
#include "tetrafront/model.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// How the patches of a model are connected.
struct Closure {
  std::vector<Diagnostic> diagnostics;
  /// Per patch: the lowest patch of its component (patches connected over lines).
  std::vector<PatchId> component;
  /// Per patch: 1 if its outer loop has the opposite orientation of its component's lowest patch.
  std::vector<std::uint8_t> isReversed;
  /// True if every used line has two patches whose orientations, as above, agree.
  bool isPlain = false;
};

/// Reports every line that only one patch uses (kOpenEdge), and patches without a consistent
/// orientation over a line that exactly two of them share (kInconsistentOrientation). Ignores
/// holes, whose loops may have either orientation, invalid patches, whose loops may use a line in
/// the wrong direction, and references to missing lines. Lines with more patches are where regions
/// touch or interfaces end. O(model).
[[nodiscard]] Closure checkClosure(const Model& model, const CheckedModel& found);

}  // namespace tetrafront
