#pragma once

/// @file Rays through boxes and triangles, in doubles: for distances. For parities, boundary/ray_crossing.h is exact.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "geom/box.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class Ray {
 public:
  /// `direction`: a unit vector. `begin`: distance from `from` at which the ray begins.
  Ray(const Vec3& from, const Vec3& direction, double begin)
      : from_(from), direction_(direction), begin_(begin) {
    // A direction along an axis must not give 0 x infinity.
    for (int k = 0; k < 3; ++k) {
      inverse_[k] = 1.0 / (std::fabs(direction[k]) < kMinComponent ? kMinComponent : direction[k]);
    }
  }

  /// Returns the distance from `from` at which the ray is first in the box, if it is at most `last`; otherwise infinity.
  [[nodiscard]] double entryInto(const Box& box, double last) const {
    double first = begin_;
    for (int k = 0; k < 3; ++k) {
      const double low = (static_cast<double>(box.low[k]) - from_[k]) * inverse_[k];
      const double high = (static_cast<double>(box.high[k]) - from_[k]) * inverse_[k];
      first = std::max(first, inverse_[k] > 0.0 ? low : high);
      last = std::min(last, inverse_[k] > 0.0 ? high : low);
    }
    return first <= last ? first : std::numeric_limits<double>::infinity();
  }

  /// Returns the distance from `from` at which the ray meets the triangle; nothing if it misses it, or meets it before it begins.
  [[nodiscard]] std::optional<double> distanceTo(const std::array<Vec3, 3>& corners) const {
    const auto& [a, b, c] = corners;
    const Vec3 side = glm::cross(direction_, c - a);
    const double determinant = glm::dot(b - a, side);
    if (!(std::fabs(determinant) > 0.0)) return {};
    const double u = glm::dot(from_ - a, side) / determinant;
    const Vec3 other = glm::cross(from_ - a, b - a);
    const double v = glm::dot(direction_, other) / determinant;
    const double distance = glm::dot(c - a, other) / determinant;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > begin_)) return {};
    return distance;
  }

 private:
  /// In place of a smaller component of the direction, so that its inverse is finite: far below the rounding of a component,
  /// about 1e-16, and its inverse times any coordinate is far below the largest double.
  static constexpr double kMinComponent = 1e-30;

  Vec3 from_;
  Vec3 direction_;
  Vec3 inverse_{0.0};
  double begin_;
};

}  // namespace tetrafront
