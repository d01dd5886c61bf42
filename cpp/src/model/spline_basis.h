#pragma once

/// @file The functions of a B-spline that are not zero at a parameter, by the recurrence of de Boor (1972) and Cox, with
/// first and second derivatives.

#include <array>
#include <cstdint>
#include <span>

namespace tetrafront {

/// Limit of the degree of a B-spline, that of CAD programs.
inline constexpr std::uint32_t kMaxDegree = 25;

/// Function k, 0 to degree, belongs to pole firstPole + k.
struct SplineBasis {
  using Row = std::array<double, kMaxDegree + 1>;

  std::size_t firstPole = 0;
  Row values{};
  Row first{};   ///< first derivatives
  Row second{};  ///< second derivatives
};

/// `knots` as in SplineCurve. A parameter outside the domain is replaced by the nearest one inside. At a knot, the
/// functions are those of the interval that follows it; at the last one, of the interval before it.
[[nodiscard]] SplineBasis evaluateBasis(std::span<const double> knots, std::uint32_t degree,
                                        double t);

}  // namespace tetrafront
