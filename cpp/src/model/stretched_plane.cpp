#include "model/stretched_plane.h"

#include <algorithm>
#include <cmath>

namespace tetrafront {

namespace {

/// Cosine of 20 degrees: outside 20 .. 160 degrees the plane would be so skewed that rounding costs
/// more than the likeness gains.
constexpr double kLargestCosine = 0.93969262078590838;

double limitedCosine(const Vec3& a, const Vec3& b) {
  const double product = glm::length(a) * glm::length(b);
  // A degenerate corner has no angle; use a right angle.
  if (!(product > 0.0)) return 0.0;
  return std::clamp(glm::dot(a, b) / product, -kLargestCosine, kLargestCosine);
}

}  // namespace

StretchedPlane::StretchedPlane(double lengthAB, double lengthAD, double lengthDC,
                               const Vec3& tangentAlongAB, const Vec3& tangentAlongAD)
    : xB_(lengthAB), shear_(lengthDC - lengthAB) {
  placeD(lengthAD, limitedCosine(tangentAlongAB, tangentAlongAD));
}

StretchedPlane StretchedPlane::ofTriangle(double lengthAB, double lengthAD, double lengthBD) {
  StretchedPlane plane;
  plane.xB_ = lengthAB;
  // Law of cosines. The angle between the lines at A would serve as well, except for curved lines,
  // whose plane triangle would then have one side unlike its line.
  const double squares = lengthAB * lengthAB + lengthAD * lengthAD - lengthBD * lengthBD;
  plane.placeD(lengthAD,
               std::clamp(squares / (2.0 * lengthAB * lengthAD), -kLargestCosine, kLargestCosine));
  return plane;
}

void StretchedPlane::placeD(double lengthAD, double cosine) {
  xD_ = lengthAD * cosine;
  yD_ = lengthAD * std::sqrt(1.0 - cosine * cosine);
}

Vec2 StretchedPlane::toPlane(const Vec2& unit) const {
  return {xB_ * unit.x + xD_ * unit.y + shear_ * (unit.x * unit.y), yD_ * unit.y};
}

Vec2 StretchedPlane::toUnit(const Vec2& plane) const {
  const double eta = plane.y / yD_;
  return {(plane.x - xD_ * eta) / (xB_ + shear_ * eta), eta};
}

StretchedPlane::Derivatives StretchedPlane::derivatives(const Vec2& unit) const {
  const double alongXi = xB_ + shear_ * unit.y;
  const double alongEta = xD_ + shear_ * unit.x;
  return {1.0 / alongXi, -alongEta / (alongXi * yD_), 1.0 / yD_};
}

}  // namespace tetrafront
