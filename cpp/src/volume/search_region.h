#pragma once

/// @file The region in which the faces around a base face are searched: a box in plain space, for
/// the face grid, and in a stretched space also a box in unit space. A ball in unit space is a long
/// ellipsoid in plain space. If the ellipsoid is slanted, its box contains a hundred times as many
/// faces as are relevant.

#include <algorithm>
#include <array>

#include "geom/box.h"
#include "tetrafront/vec3.h"
#include "volume/unit_space.h"

namespace tetrafront {

class SearchRegion {
 public:
  /// Contains the corners of a base face and the ball of `radius` around `unitCentre` in `space`,
  /// which must outlive the region. `extent` bounds the distance between any two positions in
  /// queries, along any axis.
  SearchRegion(const UnitSpace& space, const std::array<Vec3, 3>& corners, const Vec3& unitCentre,
               double radius, double extent)
      : space_(space), box_(Box::of(corners[0], corners[1], corners[2])) {
    box_.include(space.toSpace(unitCentre), space.extentOfBall(radius));
    if (!space.isStretched()) return;
    rounding_ = 2.0 * space.roundingWithin(extent);
    unitLow_ = unitCentre - (radius + rounding_);
    unitHigh_ = unitCentre + (radius + rounding_);
    for (const Vec3& corner : corners) includeUnit(corner);
  }

  /// Grows to contain the position. Returns true if it grew.
  bool include(const Vec3& position) {
    const bool grewInUnitSpace = space_.isStretched() && includeUnit(position);
    return box_.include(position) || grewInUnitSpace;
  }

  [[nodiscard]] const Box& box() const { return box_; }

  /// Returns true if the box in unit space restricts the region further than box() does.
  [[nodiscard]] bool isStretched() const { return space_.isStretched(); }

  /// Call it in stretched spaces only. Returns false only if the triangle and the convex hull of
  /// the region have no point in common.
  [[nodiscard]] bool mayIntersect(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 fromA = a - space_.origin();
    const Vec3 fromB = b - space_.origin();
    const Vec3 fromC = c - space_.origin();
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = space_.unitAxis(k);
      const double ua = glm::dot(axis, fromA);
      const double ub = glm::dot(axis, fromB);
      const double uc = glm::dot(axis, fromC);
      if (std::min(ua, std::min(ub, uc)) > unitHigh_[k]) return false;
      if (std::max(ua, std::max(ub, uc)) < unitLow_[k]) return false;
    }
    return true;
  }

 private:
  bool includeUnit(const Vec3& position) {
    const Vec3 unit = space_.toUnit(position);
    const Vec3 low = glm::min(unitLow_, unit - rounding_);
    const Vec3 high = glm::max(unitHigh_, unit + rounding_);
    const bool grew = low != unitLow_ || high != unitHigh_;
    unitLow_ = low;
    unitHigh_ = high;
    return grew;
  }

  const UnitSpace& space_;
  Box box_;
  // Extended by the rounding error of positions.
  Vec3 unitLow_{0.0};
  Vec3 unitHigh_{0.0};
  double rounding_ = 0.0;
};

}  // namespace tetrafront
