#pragma once

/// @file The ruled surface between two closed rims: straight lines join positions of both. Two
/// circles with one axis give a cylinder or a cone, exactly.

#include <span>
#include <vector>

#include "model/rim.h"
#include "model/surface_point.h"

namespace tetrafront {

/// Which position of the second rim belongs to one of the first.
struct RimMatch {
  bool isReversed = false;  ///< whether the second rim is traversed from its end
  double offset = 0.0;      ///< on the second rim, at the start of the first
};

/// Returns the match of two rims with the least sum of squared lengths of the rulings, at equal
/// steps along both. If several are equally good, joints of lines are matched, then the same
/// direction and the smallest offset are preferred. The result does not depend on where the rims
/// begin, except by rounding.
[[nodiscard]] RimMatch matchRims(const Rim& first, const Rim& second);

/// Over the strip 0 <= eta <= 1, with period 1 in xi: xi is the parameter of the first rim, eta runs
/// from the first rim to the second.
class TubeSurface {
 public:
  TubeSurface(Rim first, Rim second);

  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

  [[nodiscard]] const Rim& first() const { return first_; }
  [[nodiscard]] const Rim& second() const { return second_; }
  /// True if xi grows against the direction of the second rim.
  [[nodiscard]] bool isReversed() const { return match_.isReversed; }
  /// Returns the xi of a parameter of the second rim, 0 to 1.
  [[nodiscard]] double xiOfSecond(double part) const;
  /// Mean length of the rulings.
  [[nodiscard]] double meanRuling() const;
  /// The xi of the creases, ascending: of the rulings between two joints of lines, of which one is a corner. Where only
  /// one rim has a joint, there is no crease.
  [[nodiscard]] std::span<const double> creases() const { return creases_; }

 private:
  [[nodiscard]] double direction() const { return match_.isReversed ? -1.0 : 1.0; }

  Rim first_;
  Rim second_;
  RimMatch match_;
  std::vector<double> creases_;
};

}  // namespace tetrafront
