#pragma once

/// @file The space in which the element wanted at a base face is regular: the transformation T of
/// the size tensor there, taken as constant around the face. Shapes and distances are judged in
/// it; signs and crossings are not, since they are the same in both. Where nothing is stretched it
/// is plain space, and the wanted edge is the size.

#include <algorithm>
#include <cmath>
#include <limits>

#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class UnitSpace {
 public:
  /// Plain space with wanted edges of that size.
  static UnitSpace plain(double size) {
    UnitSpace space;
    space.targetEdge_ = size;
    return space;
  }

  /// Coordinates T (x - origin), with wanted edges of length 1.
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
  /// The directions in plain space along which the unit coordinates grow, of a stretched space.
  [[nodiscard]] Vec3 unitAxis(int k) const { return toUnit_.row(k); }
  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] Vec3 toSpace(const Vec3& unit) const {
    return stretched_ ? origin_ + toSpace_ * unit : unit;
  }

  /// In a stretched space: no coordinate of toUnit() is off by more than this, for positions whose
  /// coordinates are no further than `extent` from the origin's.
  [[nodiscard]] double roundingWithin(double extent) const {
    // Three products of a rounded difference, and two sums: less than eight roundings of each term.
    constexpr double kPerTerm = 4.0 * std::numeric_limits<double>::epsilon();
    return kPerTerm * 3.0 * largestTerm_ * extent;
  }

  /// Half the extents, in plain space, of a ball of this space.
  [[nodiscard]] Vec3 extentOfBall(double radius) const {
    if (!stretched_) return Vec3(radius);
    // The image of the unit ball under a symmetric H reaches as far along axis k as row k is long.
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
  double largestTerm_ = 0.0;  ///< of toUnit_
};

}  // namespace tetrafront
