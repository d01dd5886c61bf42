#pragma once

/// @file A curved patch of any type over the unit triangle or square: the step xi, eta -> x, y, z
/// of the paper's mappings (Löhner & Parikh 1988, section 5.2 and appendix, eq. 11-15), and those that
/// were added.

#include <cstdint>
#include <span>
#include <variant>

#include "model/isoparametric_surface.h"
#include "model/loft_surface.h"
#include "model/smooth_surface.h"
#include "model/transfinite_surface.h"
#include "model/tube_surface.h"

namespace tetrafront {

/// The domain of (xi, eta). Both contain (0, 0), (1, 0) and (0, 1); the square also (1, 1).
enum class UnitShape : std::uint8_t { kTriangle, kSquare };

/// Returns the domain of a patch type other than planar.
[[nodiscard]] UnitShape unitShapeOf(PatchType type);

/// Returns the point of a domain closest to `unit` along its coordinates.
[[nodiscard]] Vec2 clampedToUnit(UnitShape shape, const Vec2& unit);

/// Maps line number `position` of a loop, at parameter t in the loop's direction, to the border of
/// the domain.
[[nodiscard]] Vec2 unitBorder(UnitShape shape, std::size_t position, double t);

class UnitSurface {
 public:
  /// The lines of the patch's outer loop, in its direction. `type` must not be planar or a tube and
  /// must accept their types and number. Only lofts have sections. Their curves must outlive this.
  UnitSurface(PatchType type, std::span<const OrientedCurve> loop,
              std::span<const OrientedCurve> sections = {});
  /// A tube over the unit square: lines xi = 0 and xi = 1 are the same.
  explicit UnitSurface(TubeSurface tube);

  /// The tube, or null for another type.
  [[nodiscard]] const TubeSurface* tube() const { return std::get_if<TubeSurface>(&surface_); }

  [[nodiscard]] UnitShape shape() const { return shape_; }

  /// Position and exact derivatives; along the border, those of the lines.
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  using Surface =
      std::variant<IsoparametricTriangle, SerendipitySurface, BarnhillGregoryNielsonSurface,
                   CoonsSurface, TubeSurface, GregorySurface, NielsonSurface, LoftSurface>;
  static Surface makeSurface(PatchType type, std::span<const OrientedCurve> loop,
                             std::span<const OrientedCurve> sections);

  UnitShape shape_;
  Surface surface_;
};

}  // namespace tetrafront
