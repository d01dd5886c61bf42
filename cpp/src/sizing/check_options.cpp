#include "sizing/check_options.h"

#include <array>
#include <cmath>
#include <utility>

#include "base/diagnostics.h"
#include "geom/coordinates.h"

namespace tetrafront {

std::vector<Diagnostic> optionsOutOfRange(std::span<const OptionValue> values) {
  std::vector<Diagnostic> found;
  for (const OptionValue& given : values) {
    if (given.isInRange) continue;
    found.push_back(diagnose<DiagnosticCode::kOptionOutOfRange>(given.option, given.value));
  }
  return found;
}

std::vector<Diagnostic> checkOptions(const MeshOptions& options) {
  const auto [size, growth, gradation] =
      std::array{options.size, options.growth, options.gradation};
  const double volume = options.maxVolume;
  const std::array<OptionValue, 4> checked{
      {{CheckedOption::kMaxVolume, volume, volume >= 0.0 && std::isfinite(volume)},
       {CheckedOption::kSize, size, size >= 0.0 && size <= kLargestCoordinate},
       {CheckedOption::kGrowth, growth, growth >= 0.0 && growth <= kMaxGrowth},
       {CheckedOption::kGradation, gradation,
        gradation == 0.0 || (gradation > 1.0 && gradation <= kMaxGradation)}}};
  return optionsOutOfRange(checked);
}

}  // namespace tetrafront
