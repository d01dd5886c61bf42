#pragma once

/// @file Checks the options of a run before they are used.

#include <vector>

#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Returns a kOptionOutOfRange for each option that is out of range.
[[nodiscard]] std::vector<Diagnostic> checkOptions(const MeshOptions& options);

}  // namespace tetrafront
