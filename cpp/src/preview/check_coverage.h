#pragma once

/// @file Checks before meshing whether the background grid covers a drawn model (step F1).

#include <vector>

#include "field/size_field.h"
#include "tetrafront/preview.h"

namespace tetrafront {

/// Returns one diagnostic for each point of a line, and for each line and patch, that the field does not cover; lines
/// and patches only if none of their points and lines is reported. Its position lies outside, and its value is the
/// number of samples outside. `preview` holds the samples; skips what could not be sampled.
[[nodiscard]] std::vector<Diagnostic> checkCoverage(const Model& model, const ModelPreview& preview,
                                                    const SizeField& field);

/// Samples the model and checks it. Takes milliseconds for typical models.
[[nodiscard]] std::vector<Diagnostic> checkCoverage(const Model& model, const SizeField& field);

}  // namespace tetrafront
