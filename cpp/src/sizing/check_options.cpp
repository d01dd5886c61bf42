#include "sizing/check_options.h"

#include <array>
#include <utility>

#include "geom/coordinates.h"

namespace tetrafront {

std::vector<Diagnostic> checkOptions(const MeshOptions& options) {
  struct Option {
    double value;
    bool isInRange;
  };
  // In the order in which the package names them.
  const std::array<Option, 3> checked{
      {{options.size, options.size >= 0.0 && options.size <= kLargestCoordinate},
       {options.growth, options.growth >= 0.0 && options.growth <= kMaxGrowth},
       {options.gradation, options.gradation == 0.0 ||
                               (options.gradation > 1.0 && options.gradation <= kMaxGradation)}}};
  std::vector<Diagnostic> found;
  for (std::size_t i = 0; i < checked.size(); ++i) {
    if (checked[i].isInRange) continue;
    Diagnostic& diagnostic = found.emplace_back();
    diagnostic.code = DiagnosticCode::kOptionOutOfRange;
    diagnostic.values = {static_cast<double>(i), checked[i].value};
  }
  return found;
}

}  // namespace tetrafront
