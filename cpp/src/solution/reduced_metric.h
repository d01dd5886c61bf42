#pragma once

#include <span>

#include "tetrafront/solution.h"

namespace tetrafront {

/// Reduces valid metrics in one call. O(nodes).
[[nodiscard]] ReducedMetric reducedMetric(std::span<const double> metrics);

}  // namespace tetrafront
