#pragma once

/// @file Background grids that cover a box or a model.

#include <cstdint>
#include <memory>

#include "tetrafront/background_grid.h"
#include "tetrafront/model.h"
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

/// Does the work of coveringGrid() in slices.
class CoveringGridBuilder {
 public:
  CoveringGridBuilder(Model model, double size, CoverShape shape);
  CoveringGridBuilder(CoveringGridBuilder&&) noexcept;
  CoveringGridBuilder& operator=(CoveringGridBuilder&&) noexcept;
  ~CoveringGridBuilder();

  /// Does about `budget` units of work; one patch takes many. Returns true when finished.
  bool advance(std::uint32_t budget);

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const BackgroundGrid& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
