#pragma once

/// @file A curved patch over the unit triangle or square, whatever its type: the step xi, eta ->
/// x, y, z of the paper's mappings (Löhner & Parikh 1988, section 5.2 and appendix, eq. 11-15).

#include <cstdint>
#include <span>
#include <variant>

#include "model/isoparametric_surface.h"
#include "model/transfinite_surface.h"

namespace tetrafront {

/// The domain of (xi, eta). Both contain (0, 0), (1, 0) and (0, 1); the square also (1, 1).
enum class UnitShape : std::uint8_t { kTriangle, kSquare };

/// The domain of a patch type other than planar.
[[nodiscard]] UnitShape unitShapeOf(PatchType type);

/// The point of a domain nearest to `unit` along its coordinates.
[[nodiscard]] Vec2 clampedToUnit(UnitShape shape, const Vec2& unit);

/// Where a loop's line number `position`, at parameter t as the loop walks it, runs along the
/// domain's border.
[[nodiscard]] Vec2 unitBorder(UnitShape shape, std::size_t position, double t);

class UnitSurface {
 public:
  /// The lines of the patch's outer loop, as it walks them; of a type and number that `type`,
  /// which is not planar, accepts. Their curves must outlive this.
  UnitSurface(PatchType type, std::span<const OrientedCurve> loop);

  [[nodiscard]] UnitShape shape() const { return shape_; }

  /// Exact derivatives; along the border, the lines themselves.
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  using Surface = std::variant<IsoparametricTriangle, SerendipitySurface,
                               BarnhillGregoryNielsonSurface, CoonsSurface>;
  static Surface makeSurface(PatchType type, std::span<const OrientedCurve> loop);

  UnitShape shape_;
  Surface surface_;
};

}  // namespace tetrafront
