#include "geom/insphere.h"

#include <cmath>

#include "geom/twofold.h"

namespace tetrafront {
namespace {

// The determinant has the rows (v, v.v), where v is the vector from p to each corner (Shewchuk
// 1997, section 4.4). It is a sum of squares times volumes of the other three vectors. A term has
// at most 17 roundings, and the bounds allow for twice as many. With twice the digits, sums and
// products have errors of a few 2^-104.
constexpr double kPlainBound = 34.0 * 0x1p-53;
constexpr double kTwofoldBound = 0x1p-97;

template <class Number>
using Rows = std::array<std::array<Number, 3>, 4>;

template <class Number>
Number square(const std::array<Number, 3>& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

template <class Number>
Number triple(const std::array<Number, 3>& u, const std::array<Number, 3>& v,
              const std::array<Number, 3>& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/// The determinant; positive if the origin of the rows is inside.
template <class Number>
Number sphereDeterminant(const Rows<Number>& r) {
  return (square(r[0]) * triple(r[1], r[2], r[3]) - square(r[1]) * triple(r[0], r[2], r[3])) +
         (square(r[2]) * triple(r[0], r[1], r[3]) - square(r[3]) * triple(r[0], r[1], r[2]));
}

/// As triple(), with all terms positive.
double tripleOfSizes(const std::array<double, 3>& u, const std::array<double, 3>& v,
                     const std::array<double, 3>& w) {
  return u[0] * (v[1] * w[2] + v[2] * w[1]) + u[1] * (v[2] * w[0] + v[0] * w[2]) +
         u[2] * (v[0] * w[1] + v[1] * w[0]);
}

double sumOfSizes(const Rows<double>& r) {
  Rows<double> sizes;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) sizes[i][k] = std::fabs(r[i][k]);
  }
  return square(r[0]) * tripleOfSizes(sizes[1], sizes[2], sizes[3]) +
         square(r[1]) * tripleOfSizes(sizes[0], sizes[2], sizes[3]) +
         square(r[2]) * tripleOfSizes(sizes[0], sizes[1], sizes[3]) +
         square(r[3]) * tripleOfSizes(sizes[0], sizes[1], sizes[2]);
}

}  // namespace

bool isInsideSphere(const std::array<Vec3, 4>& corners, const Vec3& p) {
  Rows<double> plain;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 v = corners[i] - p;
    plain[i] = {v.x, v.y, v.z};
  }
  const double sizes = sumOfSizes(plain);
  const double rounded = sphereDeterminant(plain);
  if (std::fabs(rounded) > kPlainBound * sizes) return rounded > 0.0;
  Rows<Twofold> twofold;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& c = corners[i];
    twofold[i] = {difference(c.x, p.x), difference(c.y, p.y), difference(c.z, p.z)};
  }
  return sphereDeterminant(twofold).high > kTwofoldBound * sizes;
}

}  // namespace tetrafront
