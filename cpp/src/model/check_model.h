#pragma once

/// @file Finds all problems of a drawn model at once, before it is meshed.

#include <cstdint>
#include <memory>
#include <vector>

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

/// checkModel() in slices.
class ModelChecker {
 public:
  /// The model must outlive this.
  explicit ModelChecker(const Model& model);
  ModelChecker(ModelChecker&&) noexcept;
  ModelChecker& operator=(ModelChecker&&) noexcept;
  ~ModelChecker();

  /// Checks `budget` patches, after a first call that checks points and lines; returns true when
  /// finished.
  bool advance(std::uint32_t budget);

  /// Returns the result, once, when finished.
  [[nodiscard]] CheckedModel take();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
