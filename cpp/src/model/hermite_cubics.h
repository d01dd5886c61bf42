#pragma once

/// @file Cubics between successive points that share their slopes: continuously differentiable, and local. A slope inside is
/// that of the parabola through a point and its two neighbours (Bessel's), so that a point moves no more than the two pieces
/// on either side.

#include <optional>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Values and derivatives of the four cubics of a Hermite piece over [0, 1], for its ends and the slopes there.
struct HermiteBasis {
  double start;
  double end;
  double startSlope;
  double endSlope;

  [[nodiscard]] static HermiteBasis at(double t) {
    const double s = 1.0 - t;
    return {s * s * (1.0 + 2.0 * t), t * t * (3.0 - 2.0 * t), t * s * s, -t * t * s};
  }
  [[nodiscard]] static HermiteBasis derivativeAt(double t) {
    const double s = 1.0 - t;
    return {-6.0 * t * s, 6.0 * t * s, s * (s - 2.0 * t), t * (t - 2.0 * s)};
  }
  [[nodiscard]] static HermiteBasis secondDerivativeAt(double t) {
    return {12.0 * t - 6.0, 6.0 - 12.0 * t, 6.0 * t - 4.0, 6.0 * t - 2.0};
  }
};

/// Returns the slope at the middle of three successive points of the parabola through them. The distances of their parameters
/// must be positive.
[[nodiscard]] inline Vec3 besselSlope(const Vec3& slopeBefore, double stepBefore,
                                      const Vec3& slopeAfter, double stepAfter) {
  return (stepAfter * slopeBefore + stepBefore * slopeAfter) / (stepBefore + stepAfter);
}

class HermiteCubics {
 public:
  struct Sample {
    Vec3 value{0.0};
    Vec3 first{0.0};
    Vec3 second{0.0};
  };

  /// Makes cubics that cannot be evaluated.
  HermiteCubics() = default;

  /// At least two knots, ascending, and as many points. Without a given slope, the second derivative at an end is zero. If the
  /// last point is the first, the ends share the slope of the parabola through them and their neighbours.
  HermiteCubics(std::vector<double> knots, std::vector<Vec3> points,
                const std::optional<Vec3>& startSlope, const std::optional<Vec3>& endSlope);

  [[nodiscard]] Sample sample(double t) const;

 private:
  [[nodiscard]] double step(std::size_t piece) const { return knots_[piece + 1] - knots_[piece]; }
  [[nodiscard]] Vec3 chordSlope(std::size_t piece) const {
    return (points_[piece + 1] - points_[piece]) / step(piece);
  }

  std::vector<double> knots_;
  std::vector<Vec3> points_;
  std::vector<Vec3> slopes_;
};

}  // namespace tetrafront
