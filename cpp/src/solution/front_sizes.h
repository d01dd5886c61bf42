#pragma once

#include <span>

#include "tetrafront/solution.h"

namespace tetrafront {

/// Returns the sizes of valid metrics in one call. O(nodes).
[[nodiscard]] FrontSizes frontSizesOf(std::span<const double> metrics);

}  // namespace tetrafront
