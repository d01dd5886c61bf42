#include "model/spline_basis.h"

#include <algorithm>

namespace tetrafront {

namespace {

/// Returns the last interval of the domain that begins at or before t and is not empty.
std::size_t findInterval(std::span<const double> knots, std::uint32_t degree, double t) {
  const auto first = knots.begin() + degree;
  const auto last = knots.end() - degree - 1;
  auto above = std::upper_bound(first, last, t);
  // Step back over the empty intervals at the end of the domain.
  while (above > first + 1 && !(*above > *(above - 1))) --above;
  return static_cast<std::size_t>(above - knots.begin()) - 1;
}

double ratio(double numerator, double denominator) {
  return denominator > 0.0 ? numerator / denominator : 0.0;
}

/// Raises the functions of degree d - 1 in `row` to degree d, in place. Function k belongs to pole interval - d + k.
void raise(std::span<const double> knots, std::size_t interval, std::uint32_t d, double t,
           SplineBasis::Row& row) {
  double saved = 0.0;
  for (std::uint32_t k = 0; k < d; ++k) {
    const double right = knots[interval + k + 1];
    const double left = knots[interval + k + 1 - d];
    const double share = ratio(row[k], right - left);
    row[k] = saved + (right - t) * share;
    saved = (t - left) * share;
  }
  row[d] = saved;
}

/// Derivatives of the functions of degree d, whose next lower functions, or their derivatives, are in `lower`.
SplineBasis::Row differentiate(std::span<const double> knots, std::size_t interval, std::uint32_t d,
                               const SplineBasis::Row& lower) {
  SplineBasis::Row row{};
  double before = 0.0;
  for (std::uint32_t k = 0; k < d; ++k) {
    const double slope = d * ratio(lower[k], knots[interval + k + 1] - knots[interval + k + 1 - d]);
    row[k] = before - slope;
    before = slope;
  }
  row[d] = before;
  return row;
}

}  // namespace

SplineBasis evaluateBasis(std::span<const double> knots, std::uint32_t degree, double t) {
  const double inside = std::clamp(t, knots[degree], knots[knots.size() - degree - 1]);
  const std::size_t interval = findInterval(knots, degree, inside);
  SplineBasis basis;
  basis.firstPole = interval - degree;
  // Functions of degree - 2 and degree - 1, or of degree 0 if there are none so low.
  SplineBasis::Row lower2{};
  SplineBasis::Row lower1{};
  basis.values[0] = 1.0;
  for (std::uint32_t d = 1; d <= degree; ++d) {
    lower2 = lower1;
    lower1 = basis.values;
    raise(knots, interval, d, inside, basis.values);
  }
  if (degree >= 1) basis.first = differentiate(knots, interval, degree, lower1);
  if (degree >= 2) {
    const SplineBasis::Row slopes = differentiate(knots, interval, degree - 1, lower2);
    basis.second = differentiate(knots, interval, degree, slopes);
  }
  return basis;
}

}  // namespace tetrafront
