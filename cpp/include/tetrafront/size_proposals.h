#pragma once

/// @file Sizes proposed from the shape of a model, to be edited or used directly.

#include <cstdint>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/model.h"
#include "tetrafront/sliced_tool.h"

namespace tetrafront {

/// Options of proposeSizes(). 0 turns off `elementsPerCircle` or `elementsPerGap`.
struct ProposalOptions {
  double uniform = 0.0;             ///< largest size; 0: a twentieth of the model's diagonal
  double smallest = 0.0;            ///< smallest size proposed; 0: a fiftieth of the largest
  double elementsPerCircle = 24.0;  ///< elements around a full circle of a curved line or patch
  double elementsPerGap = 3.0;      ///< elements across the inside, between opposite patches
  double growth = 0.3;              ///< growth of the proposed sources
};

struct SizeProposal {
  double size = 0.0;  ///< uniform size, which the sources refine; 0: nothing could be sampled
  std::vector<SizeSource> sources;  ///< smallest first; none if `size` is small enough everywhere
};

/// Proposes a uniform size, and sources on lines and patches that are curved or close to each other. Works on the
/// samples of previewModel(), so it misses finer detail. Omits a source if smaller sources nearby already ask for
/// its size. Takes milliseconds for typical models.
[[nodiscard]] SizeProposal proposeSizes(const Model& model, const ProposalOptions& options);

/// Does the work of proposeSizes() in slices. One patch takes many units of work. Building the tree over all sampled
/// triangles and sorting the proposals are not divided.
class SizeProposer : public SlicedTool<SizeProposal> {
 public:
  SizeProposer(Model model, const ProposalOptions& options);
};

}  // namespace tetrafront
