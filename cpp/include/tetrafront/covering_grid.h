#pragma once

/// @file Background grids that cover a box or a model.

#include <cstdint>

#include "tetrafront/background_grid.h"
#include "tetrafront/model.h"
#include "tetrafront/sliced_tool.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

enum class CoverShape : std::uint8_t {
  kBox = 0,          ///< an axis-parallel box in five tetrahedra, 8 nodes
  kTetrahedron = 1,  ///< one tetrahedron, enough for a uniform mesh (section 3)
};

/// Returns a grid with `size` at every node that covers the box from `low` to `high`, widened on each side by a
/// twentieth of its diagonal, or by `size` if the box is a single position. The corners must be finite,
/// low <= high and size > 0.
[[nodiscard]] BackgroundGrid coveringGrid(const Vec3& low, const Vec3& high, double size,
                                          CoverShape shape);

/// Returns such a grid around the points, lines and patches of a model, including the bulge of curved ones. Leaves
/// out parts of the model that cannot be evaluated; the grid is empty if nothing else is there. `size` 0 stands
/// for a twentieth of the model's diagonal. Costs as much as previewModel().
[[nodiscard]] BackgroundGrid coveringGrid(const Model& model, double size, CoverShape shape);

/// Does the work of coveringGrid() in slices. One patch takes many units of work.
class CoveringGridBuilder : public SlicedTool<BackgroundGrid> {
 public:
  CoveringGridBuilder(Model model, double size, CoverShape shape);
};

}  // namespace tetrafront
