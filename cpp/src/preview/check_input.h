#pragma once

/// @file The check of a drawn model and its sizes that a preview and a run share: finds all diagnostics at once, before
/// anything is meshed.

#include <cstdint>
#include <optional>

#include "base/task.h"
#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/preview.h"

namespace tetrafront {

struct CheckedInput {
  /// The samples, with all diagnostics: about single points, lines and patches, then about the surface, then about the
  /// background grid, then about the sizes.
  ModelPreview preview;
  /// Nothing if the sizes are invalid.
  std::optional<SizeField> field;
  /// The sampled surface, oriented as a whole; empty if it encloses no volume.
  SurfaceMesh boundary;
};

/// Checks any input. Reports each problem, unless another one makes the question meaningless. Takes milliseconds for
/// typical models. All arguments must outlive the task.
[[nodiscard]] Task<CheckedInput> checkInput(Work& work, const Model& model,
                                            const BackgroundGrid& grid, const MeshOptions& options);

/// The same at once.
[[nodiscard]] CheckedInput checkInput(const Model& model, const BackgroundGrid& grid,
                                      const MeshOptions& options);

}  // namespace tetrafront
