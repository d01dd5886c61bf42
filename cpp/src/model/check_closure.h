#pragma once

/// @file Do the patches close a surface, as far as the loops alone can tell?

#include <cstdint>
#include <vector>

#include "model/check_model.h"
#include "tetrafront/model.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// How the patches of a model hang together.
struct Closure {
  std::vector<Diagnostic> diagnostics;
  /// Per patch: the lowest patch that it is connected with over lines.
  std::vector<std::uint32_t> component;
  /// Per patch: 1 if its outer loop runs against the turning of its component's lowest patch.
  std::vector<std::uint8_t> isTurned;
  /// Every used line has two patches, and the turning above holds over every line.
  bool isPlain = false;
};

/// Reports every line that only one patch uses (kOpenEdge), and patches that no turning makes agree
/// over a line that just two of them share (kInconsistentOrientation); of holes, whose loops may turn
/// either way, nothing is said, nor of patches that are not sound, whose loops may have a line the
/// wrong way round. Lines with more patches are where bodies touch or walls end. References to lines
/// that do not exist are passed over. O(model).
[[nodiscard]] Closure checkClosure(const Model& model, const CheckedModel& found);

}  // namespace tetrafront
