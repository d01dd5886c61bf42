#pragma once

/// @file Finds all problems of a drawn model at once, before it is meshed.

#include <cstdint>
#include <vector>

#include "base/task.h"
#include "model/duplicates.h"
#include "tetrafront/model.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Returns the problems of each point, line and patch by itself; empty if there are none. Points
/// come first, then lines, then patches, each in the model's order. Accepts any input, even indices
/// out of range. O(model), where each sample of a curved line counts. checkInput() also checks
/// whether the patches close a surface.
[[nodiscard]] std::vector<Diagnostic> diagnoseModel(const Model& model);

/// The problems of a model, and which parts of it can be drawn nevertheless.
struct CheckedModel {
  std::vector<Diagnostic> diagnostics;
  /// Per line: 1 if a curve can be built from it (its points exist, are finite and distinct, and
  /// their number is right), else 0.
  std::vector<std::uint8_t> usableLines;
  /// Per patch: 1 if its surface can be evaluated (usable lines, closed loops, a valid number of
  /// lines for its type, some area), else 0.
  std::vector<std::uint8_t> usablePatches;
  /// Points and lines that were drawn twice.
  Duplicates duplicates;
};
[[nodiscard]] CheckedModel checkModel(const Model& model);

/// Units of the budget for checking or sampling one patch. One unit is a step of the front.
inline constexpr std::uint32_t kUnitsPerPatch = 64;

/// The same in slices. The model must outlive the task.
[[nodiscard]] Task<CheckedModel> checkModel(Work& work, const Model& model);

}  // namespace tetrafront
