#pragma once

/// @file A model as the preview samples it, without further checks: for its bounds and its shape.

#include <optional>

#include "base/task.h"
#include "model/check_model.h"
#include "tetrafront/preview.h"
#include "topology/surface_access.h"

namespace tetrafront {

/// previewModel() with the diagnostics of checkModel() alone. The model must outlive the task.
[[nodiscard]] Task<ModelPreview> sampleModel(Work& work, const Model& model);

/// The same at once.
[[nodiscard]] ModelPreview sampleModel(const Model& model);

/// Returns the box of all samples; nothing if there are none.
[[nodiscard]] std::optional<Bounds> boundsOf(const ModelPreview& preview);

/// Default uniform size of a model / its diagonal.
inline constexpr double kUniformPerDiagonal = 1.0 / 20.0;

}  // namespace tetrafront
