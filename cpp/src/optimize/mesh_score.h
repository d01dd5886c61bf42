#pragma once

/// @file Scores of a whole mesh, to decide which of two is better.

#include <algorithm>

#include "optimize/element_cost.h"
#include "optimize/tet_complex.h"
#include "quality/metrics.h"

namespace tetrafront {

class MeshScore {
 public:
  template <class Space>
  void add(const TetComplex& complex, TetId tet) {
    const Corners& nodes = complex.element(tet).nodes;
    const auto frame = complex.frameOf<Space>(nodes);
    const Vec3& origin = complex.position(nodes[0]);
    const auto seen = [&](std::size_t k) {
      return Space::toUnit(frame, complex.position(nodes[k]) - origin);
    };
    const TetrahedronMeasures measures = measureTetrahedron(Vec3(0.0), seen(1), seen(2), seen(3));
    largestCosine_ = std::max(largestCosine_, measures.largestCosine);
    smallestCosine_ = std::min(smallestCosine_, measures.smallestCosine);
    if (kTargets30And135.least * (1.0 + measures.largestCosine) > 1.0 - measures.largestCosine ||
        kTargets30And135.greatest * (1.0 - measures.smallestCosine) >
            1.0 + measures.smallestCosine) {
      ++outOfRangeCount_;
    }
    radiusRatios_ += measures.radiusRatio;
    ++count_;
  }

  /// Returns those targets, lowered to the worst angles of the mesh.
  [[nodiscard]] DihedralTargets within(const DihedralTargets& targets) const {
    return {std::min(targets.least, least()), std::min(targets.greatest, greatest())};
  }

  /// Returns whether this mesh misses no target by more than the other, has no more elements
  /// outside 30 to 135 degrees, and has no worse mean.
  [[nodiscard]] bool isNoWorseThan(const MeshScore& other) const {
    return missing(kTargets30And135) <= other.missing(kTargets30And135) &&
           missing(kTargets35And130) <= other.missing(kTargets35And130) &&
           outOfRangeCount_ <= other.outOfRangeCount_ &&
           radiusRatios_ * other.count_ >= other.radiusRatios_ * count_;
  }

  /// Returns whether this mesh is no worse than the other, and better in some respect.
  [[nodiscard]] bool isBetterThan(const MeshScore& other) const {
    return isNoWorseThan(other) && !other.isNoWorseThan(*this);
  }

  /// Returns whether hope is lost, after the first of several rounds, that this mesh becomes no worse than the other: many
  /// elements are outside 30 to 135 degrees, as with a boundary of needles, and they have become more, or the mean has
  /// fallen by more than later rounds regain.
  [[nodiscard]] bool isHopelessBeside(const MeshScore& other) const {
    constexpr double kFew = 1000.0;    // elements: their rounds take little time
    constexpr double kMany = 0.01;     // of all elements
    constexpr double kMaxMore = 1.02;  // times as many elements
    constexpr double kMaxLost =
        0.004;  // of the mean radius ratio; later rounds regain up to 0.0035
    if (count_ < kFew || outOfRangeCount_ <= kMany * count_) return false;
    return outOfRangeCount_ > kMaxMore * other.outOfRangeCount_ ||
           radiusRatios_ / count_ < other.radiusRatios_ / other.count_ - kMaxLost;
  }

 private:
  [[nodiscard]] double least() const { return (1.0 - largestCosine_) / (1.0 + largestCosine_); }
  [[nodiscard]] double greatest() const {
    return (1.0 + smallestCosine_) / (1.0 - smallestCosine_);
  }
  /// Cost of the worst element; 1 if none misses.
  [[nodiscard]] double missing(const DihedralTargets& targets) const {
    return std::max({1.0, targets.least / least(), targets.greatest / greatest()});
  }

  double largestCosine_ = -1.0;
  double smallestCosine_ = 1.0;
  double radiusRatios_ = 0.0;
  double outOfRangeCount_ = 0.0;
  double count_ = 0.0;
};

}  // namespace tetrafront
