#pragma once

/// @file The costs that the optimizer minimizes. All are functions of the four corners, grow
/// without bound as an element flattens, and use only + - * / and square roots, so they are the
/// same on every machine.
///
/// bulk, finish   e^(1/2) - 1 and e - 1, with e = (sum of squared edges)^3 / (432 D^2) and D six
///                times the volume: the mean ratio to the power -3, 1 for the regular
///                tetrahedron. Summed over elements; convex in each free node. A regular
///                element costs 0; without the -1, deleting elements would pay.
/// within         like bulk, but invalid if an angle misses its target, and with a price for each
///                angle outside 30 to 135 degrees that no better shapes can repay.
/// dihedral       the maximum of k1 (1 + c)/(1 - c) and k2 (1 - c)/(1 + c) over the dihedral
///                cosines c, with k the squared tangent of half the target angle: at most 1 if
///                and only if all angles meet their targets. The worst element counts.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "optimize/metric_space.h"
#include "quality/metrics.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

enum class Measure : std::uint8_t { kBulk, kFinish, kWithin, kDihedral };

/// Cost of an invalid element.
inline constexpr double kInvalidCost = 1e30;
/// Cost of an element that was too flat on entry for plain doubles to prove its sign; worse than
/// any element an operator may make.
inline constexpr double kEntryCost = 1e21;
/// From this cost on, an element counts as invalid. Below it, six times the volume is at least a
/// thousand times its rounding error, so plain doubles prove its sign.
inline constexpr double kMaxShape = 1e20;

/// Squared tangents of half the smallest target angle, and of half of 180 degrees minus the
/// largest.
struct DihedralTargets {
  double least;
  double greatest;

  /// Targets that an element of this `cost` just meets.
  [[nodiscard]] DihedralTargets loweredBy(double cost) const {
    return {least / cost, greatest / cost};
  }
};
inline constexpr DihedralTargets kTargets2And175{0.0003046792916482916, 0.0019062779356603494};
inline constexpr DihedralTargets kTargets8And165{0.00488975902858307, 0.017332380120999264};
inline constexpr DihedralTargets kTargets12And160{0.011046900270782669, 0.03109120412576338};
inline constexpr DihedralTargets kTargets18And150{0.02508563093691659, kSquaredTangentOfHalf30};
inline constexpr DihedralTargets kTargets22And145{0.037783704580475, 0.099413326268553801};
inline constexpr DihedralTargets kTargets30And135{kSquaredTangentOfHalf30, kSquaredTangentOfHalf45};
inline constexpr DihedralTargets kTargets35And130{0.099413326268553801, 0.21744283205399903};

/// What no change may leave an element beyond: the worst values of a given mesh. By default anything.
struct ElementLimits {
  double leastRadiusRatio = 0.0;
  double greatestCosine = 1.0;  ///< of a dihedral angle, which bounds the smallest one
  double leastCosine = -1.0;    ///< bounds the largest one
};

/// Edges of an element from its first corner.
struct Edges {
  Vec3 u;
  Vec3 v;
  Vec3 w;
};

/// Mean ratio as a fraction: bottom / top = (mean ratio)^3. The bottom is 0 for an element without
/// volume.
struct ShapeFraction {
  double top;
  double bottom;
  [[nodiscard]] bool isValid() const { return bottom * kMaxShape > top; }
};

inline ShapeFraction shapeFraction(const Edges& edges) {
  const auto& [u, v, w] = edges;
  const double sixVolumes = glm::dot(u, glm::cross(v, w));
  if (!(sixVolumes > 0.0)) return {1.0, 0.0};
  const double squares = 3.0 * (glm::dot(u, u) + glm::dot(v, v) + glm::dot(w, w)) -
                         2.0 * (glm::dot(u, v) + glm::dot(v, w) + glm::dot(u, w));
  return {squares * squares * squares, 432.0 * sixVolumes * sixVolumes};
}

/// 3 x inradius / circumradius of an element of positive volume.
inline double radiusRatio(const Edges& edges) {
  const auto& [u, v, w] = edges;
  const Vec3 vw = glm::cross(v, w);
  const Vec3 wu = glm::cross(w, u);
  const Vec3 uv = glm::cross(u, v);
  const auto length = [](const Vec3& vector) { return std::sqrt(glm::dot(vector, vector)); };
  // Inradius = det / areas; circumradius = |k| / (2 det).
  const double det = glm::dot(u, vw);
  const double areas = length(vw) + length(wu) + length(uv) + length(vw + wu + uv);
  const Vec3 k = vw * glm::dot(u, u) + wu * glm::dot(v, v) + uv * glm::dot(w, w);
  return 6.0 * det * det / (areas * length(k));
}

/// Computes costs by one measure in one kind of space.
template <class Space = PlainSpace>
class ElementCost {
 public:
  using Frame = typename Space::Frame;

  explicit ElementCost(Measure measure, DihedralTargets targets = kTargets18And150)
      : measure_(measure), targets_(targets) {}

  /// Returns this cost, but with every element beyond the limits invalid.
  [[nodiscard]] ElementCost within(const ElementLimits& limits) const {
    ElementCost limited = *this;
    limited.limits_ = limits;
    return limited;
  }

  [[nodiscard]] bool hasLimit() const { return limits_.leastRadiusRatio > 0.0 || hasAngleLimit(); }

  [[nodiscard]] Measure measure() const { return measure_; }
  [[nodiscard]] const DihedralTargets& targets() const { return targets_; }

  [[nodiscard]] double operator()(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                                  const Frame& frame = {}) const {
    Edges edges{b - a, c - a, d - a};
    if constexpr (Space::kIsStretched) {
      // Plain space decides the sign. A volume that is positive there is positive in unit space
      // too, even if rounding left nothing of it.
      if (!shapeFraction(edges).isValid()) return kInvalidCost;
      edges = {Space::toUnit(frame, edges.u), Space::toUnit(frame, edges.v),
               Space::toUnit(frame, edges.w)};
    }
    const ShapeFraction fraction = shapeFraction(edges);
    if (!fraction.isValid()) return kInvalidCost;
    const double shape = fraction.top / fraction.bottom;
    // The radius ratio is at least the third power of the mean ratio (Liu & Joe 1994).
    if (shape * limits_.leastRadiusRatio > 1.0 && radiusRatio(edges) < limits_.leastRadiusRatio) {
      return kInvalidCost;
    }
    if (hasAngleLimit()) {
      const auto [greatest, least] = extremesOf(sidesOf(edges));
      if (greatest.cosine > limits_.greatestCosine || least.cosine < limits_.leastCosine) {
        return kInvalidCost;
      }
    }
    switch (measure_) {
      case Measure::kBulk:
        return std::sqrt(shape) - 1.0;
      case Measure::kFinish:
        return shape - 1.0;
      case Measure::kWithin: {
        constexpr double kPrice = 1e4;
        const Extremes extremes = extremesOf(sidesOf(edges));
        if (dihedral(extremes, targets_) > 1.0) return kInvalidCost;
        const double missed = dihedral(extremes, kTargets30And135);
        return std::sqrt(shape) - 1.0 + (missed > 1.0 ? kPrice * missed : 0.0);
      }
      case Measure::kDihedral:
        return dihedral(extremesOf(sidesOf(edges)), targets_);
    }
    return kInvalidCost;
  }

  /// Cost of an element and its gradient with respect to the first corner, in plain space.
  struct Slope {
    double cost;
    Vec3 gradient;
  };

  /// Slope of a valid element's dihedral cost: that of its most expensive angle.
  [[nodiscard]] Slope slopeOf(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                              const Frame& frame = {}) const {
    const Edges edges{Space::toUnit(frame, b - a), Space::toUnit(frame, c - a),
                      Space::toUnit(frame, d - a)};
    const Sides sides = sidesOf(edges);
    const Extremes extremes = extremesOf(sides);
    const auto& [greatest, least] = extremes;
    const bool isSmallest =
        priceOfSmallest(greatest.cosine, targets_) >= priceOfLargest(least.cosine, targets_);
    const Angle& angle = isSmallest ? greatest : least;
    const double rest = isSmallest ? 1.0 - greatest.cosine : 1.0 + least.cosine;
    const double rise = 2.0 * (isSmallest ? targets_.least : -targets_.greatest) / (rest * rest);
    // T is symmetric, so it also maps gradients back from unit space.
    return {dihedral(extremes, targets_),
            Space::toUnit(frame, cosineGradient(edges, sides, angle) * rise)};
  }

  /// Total cost of two sets of elements.
  [[nodiscard]] double combined(double one, double other) const {
    return measure_ == Measure::kDihedral ? std::max(one, other) : one + other;
  }

 private:
  [[nodiscard]] bool hasAngleLimit() const {
    return limits_.greatestCosine < 1.0 || limits_.leastCosine > -1.0;
  }

  /// Inward normals of the faces, each opposite to a corner, and their inverse lengths.
  struct Sides {
    std::array<Vec3, 4> normals;
    std::array<double, 4> inverse;
  };
  [[nodiscard]] static Sides sidesOf(const Edges& edges) {
    const auto& [u, v, w] = edges;
    const Vec3 vw = glm::cross(v, w);
    const Vec3 wu = glm::cross(w, u);
    const Vec3 uv = glm::cross(u, v);
    Sides sides{{-vw - wu - uv, vw, wu, uv}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      sides.inverse[i] = 1.0 / std::sqrt(glm::dot(sides.normals[i], sides.normals[i]));
    }
    return sides;
  }

  /// A dihedral angle between two faces.
  struct Angle {
    double cosine;
    std::size_t one = 0;
    std::size_t other = 0;
  };
  struct Extremes {
    Angle greatest{-1.0};
    Angle least{1.0};
  };
  [[nodiscard]] static Extremes extremesOf(const Sides& sides) {
    const auto& [normals, inverse] = sides;
    Extremes extremes;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double cosine = -glm::dot(normals[i], normals[j]) * inverse[i] * inverse[j];
        if (cosine > extremes.greatest.cosine) extremes.greatest = {cosine, i, j};
        if (cosine < extremes.least.cosine) extremes.least = {cosine, i, j};
      }
    }
    return extremes;
  }

  /// Gradient with respect to the first corner, which rotates the three faces that meet there.
  [[nodiscard]] static Vec3 cosineGradient(const Edges& edges, const Sides& sides,
                                           const Angle& angle) {
    const auto& [u, v, w] = edges;
    const std::array<Vec3, 4> across{Vec3(0.0), w - v, u - w, v - u};
    const Vec3 one = sides.normals[angle.one] * sides.inverse[angle.one];
    const Vec3 other = sides.normals[angle.other] * sides.inverse[angle.other];
    return glm::cross(across[angle.one], other + one * angle.cosine) * sides.inverse[angle.one] +
           glm::cross(across[angle.other], one + other * angle.cosine) * sides.inverse[angle.other];
  }

  [[nodiscard]] static double priceOfSmallest(double cosine, const DihedralTargets& targets) {
    return targets.least * (1.0 + cosine) / (1.0 - cosine);
  }
  [[nodiscard]] static double priceOfLargest(double cosine, const DihedralTargets& targets) {
    return targets.greatest * (1.0 - cosine) / (1.0 + cosine);
  }
  [[nodiscard]] static double dihedral(const Extremes& extremes, const DihedralTargets& targets) {
    const double greatest = extremes.greatest.cosine;
    const double least = extremes.least.cosine;
    if (greatest >= 1.0 || least <= -1.0) return kInvalidCost;
    return std::max(priceOfSmallest(greatest, targets), priceOfLargest(least, targets));
  }

  Measure measure_;
  DihedralTargets targets_;
  ElementLimits limits_;
};

}  // namespace tetrafront
