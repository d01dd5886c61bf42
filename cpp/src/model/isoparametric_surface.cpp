// The shape functions sum to one, so the first one need not be evaluated: positions are relative to
// the first node. This also keeps a small patch far from the origin as exact as its own size
// permits.

#include "model/isoparametric_surface.h"

namespace tetrafront {

namespace {

/// The nodes around the loop after the first one: mid-point, corner, mid-point, ...
template <std::size_t kCount>
std::array<Vec3, kCount> offsetsFrom(const Vec3& origin, std::span<const OrientedCurve> loop) {
  std::array<Vec3, kCount> offsets;
  for (std::size_t i = 0; i < kCount; ++i) {
    const OrientedCurve& line = loop[i / 2];
    offsets[i] = (i % 2 == 0 ? line.points()[1] : line.end()) - origin;
  }
  return offsets;
}

/// A shape function with its derivatives with respect to xi and eta.
struct Weight {
  double value;
  double byXi;
  double byEta;
};

template <std::size_t kCount>
SurfacePoint combine(const Vec3& origin, const std::array<Vec3, kCount>& offsets,
                     const std::array<Weight, kCount>& weights) {
  SurfacePoint point;
  for (std::size_t i = 0; i < kCount; ++i) {
    point.position += weights[i].value * offsets[i];
    point.alongXi += weights[i].byXi * offsets[i];
    point.alongEta += weights[i].byEta * offsets[i];
  }
  point.position += origin;
  return point;
}

}  // namespace

IsoparametricTriangle::IsoparametricTriangle(std::span<const OrientedCurve> loop)
    : origin_(loop[0].start()), offsets_(offsetsFrom<5>(origin_, loop)) {}

SurfacePoint IsoparametricTriangle::evaluate(const Vec2& unit) const {
  const double xi = unit.x;
  const double eta = unit.y;
  const double rest = (1.0 - xi) - eta;
  // N2 .. N6 of eq. (12).
  const std::array<Weight, 5> weights{{
      {4.0 * xi * rest, 4.0 * (rest - xi), -4.0 * xi},
      {xi * (2.0 * xi - 1.0), 4.0 * xi - 1.0, 0.0},
      {4.0 * xi * eta, 4.0 * eta, 4.0 * xi},
      {eta * (2.0 * eta - 1.0), 0.0, 4.0 * eta - 1.0},
      {4.0 * eta * rest, -4.0 * eta, 4.0 * (rest - eta)},
  }};
  return combine(origin_, offsets_, weights);
}

SerendipitySurface::SerendipitySurface(std::span<const OrientedCurve> loop)
    : origin_(loop[0].start()), offsets_(offsetsFrom<7>(origin_, loop)) {}

SurfacePoint SerendipitySurface::evaluate(const Vec2& unit) const {
  const double xi = unit.x;
  const double eta = unit.y;
  const double u = 1.0 - xi;
  const double v = 1.0 - eta;
  const double atB = 1.0 - 2.0 * xi + 2.0 * eta;
  const double atC = 3.0 - 2.0 * xi - 2.0 * eta;
  const double atD = 1.0 + 2.0 * xi - 2.0 * eta;
  // N2 .. N8 of eq. (13).
  const std::array<Weight, 7> weights{{
      {4.0 * xi * u * v, 4.0 * v * (1.0 - 2.0 * xi), -4.0 * xi * u},
      {-xi * v * atB, v * (2.0 * xi - atB), xi * (atB - 2.0 * v)},
      {4.0 * xi * eta * v, 4.0 * eta * v, 4.0 * xi * (1.0 - 2.0 * eta)},
      {-xi * eta * atC, eta * (2.0 * xi - atC), xi * (2.0 * eta - atC)},
      {4.0 * xi * eta * u, 4.0 * eta * (1.0 - 2.0 * xi), 4.0 * xi * u},
      {-eta * u * atD, eta * (atD - 2.0 * u), u * (2.0 * eta - atD)},
      {4.0 * eta * u * v, -4.0 * eta * v, 4.0 * u * (1.0 - 2.0 * eta)},
  }};
  return combine(origin_, offsets_, weights);
}

}  // namespace tetrafront
