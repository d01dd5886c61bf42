#pragma once

/// @file Unit space: the space in which the target element at a base face is regular. It is the
/// transformation T of the size tensor there, taken as constant around the face. Shapes and
/// distances are measured in unit space. Signs and crossings are computed in plain space, because
/// they are the same in both. Without stretching, unit space is plain space, and the target edge
/// length is the size.

#include <algorithm>
#include <cmath>
#include <limits>

#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class UnitSpace {
 public:
  /// Returns plain space with this target edge length.
  static UnitSpace plain(double size) {
    UnitSpace space;
    space.targetEdge_ = size;
    return space;
  }

  /// Returns the space of coordinates T (x - origin), with target edge length 1.
  static UnitSpace stretched(const SymmetricTensor& size, const Vec3& origin) {
    UnitSpace space;
    space.stretched_ = true;
    space.toSpace_ = size;
    space.toUnit_ = size.inverse();
    space.origin_ = origin;
    const SymmetricTensor& t = space.toUnit_;
    for (const double term : {t.xx, t.yy, t.zz, t.xy, t.xz, t.yz})
      space.largestTerm_ = std::max(space.largestTerm_, std::fabs(term));
    return space;
  }

  [[nodiscard]] bool isStretched() const { return stretched_; }
  [[nodiscard]] double targetEdge() const { return targetEdge_; }

  [[nodiscard]] Vec3 toUnit(const Vec3& position) const {
    return stretched_ ? toUnit_ * (position - origin_) : position;
  }
  /// Direction in plain space along which unit coordinate `k` grows, in a stretched space.
  [[nodiscard]] Vec3 unitAxis(int k) const { return toUnit_.row(k); }
  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] Vec3 toSpace(const Vec3& unit) const {
    return stretched_ ? origin_ + toSpace_ * unit : unit;
  }

  /// The tensor that maps unit space to plain space, in a stretched space.
  [[nodiscard]] const SymmetricTensor& sizeTensor() const { return toSpace_; }

  /// In a stretched space: upper bound of the rounding error of a coordinate of toUnit(), for
  /// positions whose coordinates differ by at most `extent` from the origin's.
  [[nodiscard]] double roundingWithin(double extent) const {
    // Three products of a rounded difference and two sums: less than eight roundings per term.
    constexpr double kPerTerm = 4.0 * std::numeric_limits<double>::epsilon();
    return kPerTerm * 3.0 * largestTerm_ * extent;
  }

  /// Returns half the extents, in plain space, of a ball in this space.
  [[nodiscard]] Vec3 extentOfBall(double radius) const {
    if (!stretched_) return Vec3(radius);
    // The image of the unit ball under a symmetric H extends along axis k by the length of row k.
    Vec3 extent;
    for (int k = 0; k < 3; ++k) {
      const Vec3 row = toSpace_.row(k);
      extent[k] = radius * std::sqrt(glm::dot(row, row));
    }
    return extent;
  }

 private:
  bool stretched_ = false;
  double targetEdge_ = 1.0;
  SymmetricTensor toUnit_;
  SymmetricTensor toSpace_;
  Vec3 origin_{0.0};
  double largestTerm_ = 0.0;  ///< of toUnit_, in magnitude
};

}  // namespace tetrafront
