#pragma once

/// @file The one check of a drawn model and its sizes: what a preview and a run have to say before
/// anything is meshed, all at once.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/mesher.h"

namespace tetrafront {

struct CheckedInput {
  /// The picture, with all diagnostics: about points, lines and patches by themselves, then about
  /// the surface, then about the background grid, then about the sizes.
  ModelPreview preview;
  /// Nothing where sizes are not known.
  std::optional<SizeField> field;
};

/// Any input is accepted. No finding keeps another from being made, unless it takes away what the
/// other is about. Milliseconds for the models people draw.
[[nodiscard]] CheckedInput checkInput(const Model& model, const BackgroundGrid& grid,
                                      const MeshOptions& options);

/// checkInput() in slices.
class InputChecker {
 public:
  /// All must outlive this.
  InputChecker(const Model& model, const BackgroundGrid& grid, const MeshOptions& options);
  InputChecker(InputChecker&&) noexcept;
  InputChecker& operator=(InputChecker&&) noexcept;
  ~InputChecker();

  /// Works on for about `budget` steps, a patch being many, or takes one of the steps that look at all
  /// patches together; true when finished.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Once, when finished.
  [[nodiscard]] CheckedInput take();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Options that make no sense, as a caller of the engine may give them.
[[nodiscard]] std::vector<Diagnostic> checkOptions(const MeshOptions& options);

[[nodiscard]] bool anyError(const std::vector<Diagnostic>& diagnostics);

}  // namespace tetrafront
