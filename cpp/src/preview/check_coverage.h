#pragma once

/// @file Does the background grid cover what is drawn (step F1)? Asked before anything is meshed.

#include <vector>

#include "field/size_field.h"
#include "tetrafront/mesher.h"

namespace tetrafront {

/// What of the model the field does not cover: points that lines use; lines and patches of whose
/// points and lines nothing was said yet. One diagnostic each, with a place outside and, as its
/// value, how many places of the line or patch were found outside. `preview` as previewModel()
/// samples the model; what it could not sample is passed over.
[[nodiscard]] std::vector<Diagnostic> checkCoverage(const Model& model, const ModelPreview& preview,
                                                    const SizeField& field);

/// The same, sampling the model itself. Milliseconds for the models people draw.
[[nodiscard]] std::vector<Diagnostic> checkCoverage(const Model& model, const SizeField& field);

}  // namespace tetrafront
