#pragma once

/// @file Rules of a 2-D front that a recorded front may change, to show what each of them is good for.

#include <cstdint>

#include "tetrafront/experiment.h"
#include "tetrafront/options.h"

namespace tetrafront {

/// By default, the rules are those of every patch.
struct PlanarRules {
  FrontOrder order = FrontOrder::kLayered;
  std::uint32_t seed = 0;  ///< of the random order
  double height = 1.0;     ///< factor of the height of the ideal point, > 0
  FrontExperiment experiment{};
};

}  // namespace tetrafront
