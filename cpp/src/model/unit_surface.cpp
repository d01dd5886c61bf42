#include "model/unit_surface.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tetrafront {

UnitShape unitShapeOf(PatchType type) {
  const bool triangle = type == PatchType::kIsoparametricTriangle ||
                        type == PatchType::kBarnhillGregoryNielson || type == PatchType::kNielson;
  return triangle ? UnitShape::kTriangle : UnitShape::kSquare;
}

Vec2 clampedToUnit(UnitShape shape, const Vec2& unit) {
  const double eta = std::clamp(unit.y, 0.0, 1.0);
  return {std::clamp(unit.x, 0.0, shape == UnitShape::kTriangle ? 1.0 - eta : 1.0), eta};
}

Vec2 unitBorder(UnitShape shape, std::size_t position, double t) {
  if (shape == UnitShape::kTriangle) {
    const std::array<Vec2, 3> border{Vec2(t, 0.0), Vec2(1.0 - t, t), Vec2(0.0, 1.0 - t)};
    return border[position];
  }
  const std::array<Vec2, 4> border{Vec2(t, 0.0), Vec2(1.0, t), Vec2(1.0 - t, 1.0),
                                   Vec2(0.0, 1.0 - t)};
  return border[position];
}

UnitSurface::UnitSurface(PatchType type, std::span<const OrientedCurve> loop,
                         std::span<const OrientedCurve> sections)
    : shape_(unitShapeOf(type)), surface_(makeSurface(type, loop, sections)) {}

UnitSurface::UnitSurface(TubeSurface tube)
    : shape_(UnitShape::kSquare), surface_(std::move(tube)) {}

UnitSurface::Surface UnitSurface::makeSurface(PatchType type, std::span<const OrientedCurve> loop,
                                              std::span<const OrientedCurve> sections) {
  switch (type) {
    case PatchType::kIsoparametricTriangle:
      return IsoparametricTriangle(loop);
    case PatchType::kSerendipity:
      return SerendipitySurface(loop);
    case PatchType::kBarnhillGregoryNielson:
      return BarnhillGregoryNielsonSurface(loop);
    case PatchType::kGregory:
      return GregorySurface(loop);
    case PatchType::kNielson:
      return NielsonSurface(loop);
    case PatchType::kLoft:
      return LoftSurface(loop, sections);
    case PatchType::kPlanar:
    case PatchType::kTube:
    case PatchType::kCoons:
      break;
  }
  return CoonsSurface(loop);
}

SurfacePoint UnitSurface::evaluate(const Vec2& unit) const {
  return std::visit([&](const auto& surface) { return surface.evaluate(unit); }, surface_);
}

}  // namespace tetrafront
