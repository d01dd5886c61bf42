#pragma once

/// @file The cost of edges and elements that an adaptation lowers. Edges of unit length and elements of good shape cost nothing,
/// unless elements have a price (ElementNumber).

#include <algorithm>
#include <cmath>

#include "geom/exponential.h"

namespace tetrafront {

/// Bounds of a unit edge: 1 / sqrt(2) and sqrt(2).
inline constexpr double kLeastUnitLength = 0.70710678118654752;
inline constexpr double kLargestUnitLength = 1.4142135623730951;

/// Cost of an element that is not positively oriented: more than any change can gain.
inline constexpr double kForbidden = 1e9;

class Badness {
 public:
  /// `floor`: quality below which an element costs much.
  explicit Badness(double floor) : floor_(floor), soft_(std::max(kSoft, floor + 0.05)) {}

  [[nodiscard]] double floor() const { return floor_; }
  void setFloor(double floor) {
    floor_ = floor;
    soft_ = std::max(kSoft, floor + 0.05);
  }

  /// Draws moved nodes less to unit edges, so that fewer of them are moved.
  void weakenPull() { edgePull_ = kWeakEdgePull; }

  /// Badness around a node, with the pulls, from which random steps are worth their time.
  [[nodiscard]] double poorSurroundings() const { return edgePull_ < kEdgePull ? 0.6 : 1.5; }

  /// Sets the cost of each element, whatever its quality.
  void setPerElement(double cost) { perElement_ = cost; }

  /// Cost of an edge by its metric length > 0. Up to 0.35 doublings from 1 it is free; at the bounds it jumps to about 1.
  [[nodiscard]] double ofEdge(double length) const {
    if (length > kFreeLow && length < kFreeHigh) return 0.0;
    const double s = doublings(length);
    if (s < 1.0) return kBelowBound * (s - kFree) / (1.0 - kFree);
    return 1.0 + 0.5 * std::min(s - 1.0, 2.0) + 0.1 * s;
  }

  /// Cost of an element by its quality, and its price.
  [[nodiscard]] double ofElement(double quality) const {
    return quality <= 0.0 ? kForbidden : perElement_ + ofQuality(quality);
  }

  /// Cost of a quality > 0.
  [[nodiscard]] double ofQuality(double quality) const {
    double cost = 0.0;
    if (quality < soft_) {
      const double lack = (soft_ - quality) / soft_;
      cost += lack * lack;
    }
    if (quality < floor_) cost += kBelowFloor * (0.1 + (floor_ - quality) / floor_);
    return cost;
  }

  /// Small additional costs that draw a moved node to unit edges and regular elements.
  [[nodiscard]] double pullOfEdge(double length) const {
    const double t = (length - 1.0) / (length + 1.0);
    // 2 log2(l) = (2 / ln 2) 2 artanh(t), whose first terms suffice.
    const double s = kDoublingsPerTanh * t * (1.0 + t * t * (1.0 / 3.0 + 0.2 * t * t));
    return edgePull_ * s * s;
  }
  [[nodiscard]] static double pullOfElement(double quality) {
    return kElementPull * (1.0 / quality - 1.0);
  }
  /// The same for a triangle of the boundary, by the cosine between it and its patch.
  [[nodiscard]] static double pullOfTilt(double cosine) {
    const double tilt = std::max(0.0, 1.0 - cosine - kFreeTilt);
    return kTiltPull * tilt / (tilt + kHalfTilt);
  }

 private:
  /// 2 |log2 l|: 1 at the bounds of unit edges.
  static double doublings(double length) {
    constexpr double kTwoPerLn2 = 2.8853900817779268;
    return kTwoPerLn2 * std::fabs(logarithm(length));
  }

  static constexpr double kSoft = 0.75;
  static constexpr double kFree = 0.7;
  static constexpr double kFreeLow = 0.78458409789675077;  ///< 2^-0.35
  static constexpr double kFreeHigh = 1.2745606273192622;  ///< 2^0.35
  static constexpr double kBelowBound = 0.15;
  static constexpr double kBelowFloor = 30.0;
  static constexpr double kDoublingsPerTanh = 5.7707801635558536;
  // The larger, the more lengths are near 1: with 0.03, 0.1, 0.2 and 0.3, 71, 73, 76 and 77 % are from 0.8 to 1.25 for sinfun3. With 0.3, the
  // poorest elements become poorer.
  static constexpr double kEdgePull = 0.2;
  static constexpr double kWeakEdgePull = 0.03;
  static constexpr double kElementPull = 0.02;
  // Where elements are thin along a curved boundary, its triangles can tilt much. Of a cylinder whose sizes are 0.001 along its axis and
  // 0.1 around it, the area is 0.6 % too large without this pull, 0.1 % with it. It is bounded, so that no element becomes poor for it.
  static constexpr double kTiltPull = 6.0;
  static constexpr double kFreeTilt = 0.005;  ///< 1 - cosine, up to which it is free: 5.7 degrees
  static constexpr double kHalfTilt = 0.1;    ///< from there, 1 - cosine of half the largest pull

  double floor_;
  double soft_;
  double perElement_ = 0.0;
  double edgePull_ = kEdgePull;
};

}  // namespace tetrafront
