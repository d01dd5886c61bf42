#pragma once

/// @file Checks the options of a run before they are used.

#include <span>
#include <vector>

#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

struct OptionValue {
  CheckedOption option;
  double value;
  bool isInRange;
};

/// Returns a kOptionOutOfRange for each value that is out of range.
[[nodiscard]] std::vector<Diagnostic> optionsOutOfRange(std::span<const OptionValue> values);

/// Returns a kOptionOutOfRange for each option that is out of range.
[[nodiscard]] std::vector<Diagnostic> checkOptions(const MeshOptions& options);

}  // namespace tetrafront
