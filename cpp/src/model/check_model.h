#pragma once

/// @file Everything that is wrong with a drawn model, all at once, before anything is meshed.

#include <cstdint>
#include <memory>
#include <vector>

#include "model/duplicates.h"
#include "tetrafront/model.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// What is wrong with the points, lines and patches of a model, each taken by itself; empty if
/// nothing is. Points first, then lines, then patches, each in the model's order. Any input is
/// accepted, also numbers out of range. O(model), curved lines counting as their samples; whether
/// the patches close a surface is asked by checkInput().
[[nodiscard]] std::vector<Diagnostic> diagnoseModel(const Model& model);

/// What diagnoseModel() found, and what can be drawn in spite of it.
struct CheckedModel {
  std::vector<Diagnostic> diagnostics;
  /// Per line: 1 if a curve can be built from it (its points exist, are finite, distinct and of
  /// the right number), else 0.
  std::vector<std::uint8_t> usableLines;
  /// Per patch: 1 if its surface can be evaluated (sound lines, closed loops, a number of lines
  /// its type takes, some area), else 0.
  std::vector<std::uint8_t> usablePatches;
  /// What was drawn twice.
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

  /// Looks at `budget` patches, after a first call that looks at points and lines; true when
  /// finished.
  bool advance(std::uint32_t budget);

  /// Once, when finished.
  [[nodiscard]] CheckedModel take();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
