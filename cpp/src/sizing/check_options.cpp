#include "sizing/check_options.h"

#include <array>
#include <utility>

#include "geom/coordinates.h"

namespace tetrafront {

std::vector<Diagnostic> checkOptions(const MeshOptions& options) {
  struct Option {
    CheckedOption which;
    double value;
    bool isInRange;
  };
  const auto [size, growth, gradation] =
      std::array{options.size, options.growth, options.gradation};
  const std::array<Option, 3> checked{
      {{CheckedOption::kSize, size, size >= 0.0 && size <= kLargestCoordinate},
       {CheckedOption::kGrowth, growth, growth >= 0.0 && growth <= kMaxGrowth},
       {CheckedOption::kGradation, gradation,
        gradation == 0.0 || (gradation > 1.0 && gradation <= kMaxGradation)}}};
  std::vector<Diagnostic> found;
  for (const Option& option : checked) {
    if (option.isInRange) continue;
    Diagnostic& diagnostic = found.emplace_back();
    diagnostic.code = DiagnosticCode::kOptionOutOfRange;
    diagnostic.values = {static_cast<double>(option.which), option.value};
  }
  return found;
}

}  // namespace tetrafront
