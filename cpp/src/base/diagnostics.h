#pragma once

/// @file Questions about lists of diagnostics.

#include <algorithm>
#include <span>

#include "tetrafront/status.h"

namespace tetrafront {

/// True if at least one of the diagnostics is an error, not a warning.
[[nodiscard]] inline bool anyError(std::span<const Diagnostic> diagnostics) {
  return std::ranges::any_of(diagnostics, [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::kError;
  });
}

}  // namespace tetrafront
