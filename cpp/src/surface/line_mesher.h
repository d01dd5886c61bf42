#pragma once

/// @file Divides lines into sides (Löhner & Parikh 1988, section 5.1, steps S1-S4).

#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "model/curve.h"

namespace tetrafront {

enum class LineDivisionStatus : std::uint8_t {
  kDivided = 0,
  kOutsideGrid = 1,   ///< the line leaves the background grid at `place`
  kTooManySides = 2,  ///< more sides asked for than kMaxSidesPerLine
};

/// The nodes of a divided line, both ends included: parameters[i] and nodes[i] belong together
/// and ascend from t = 0 to t = 1; the ends are bit-exact copies of the curve's.
struct LineDivision {
  LineDivisionStatus status = LineDivisionStatus::kDivided;
  std::vector<double> parameters;
  std::vector<Vec3> nodes;
  double length = 0.0;       ///< of the line, in wanted sizes
  Vec3 place{0.0};           ///< where, unless divided
  double wantedSides = 0.0;  ///< of kTooManySides: about how many the sizes ask for, at least

  [[nodiscard]] std::size_t sideCount() const { return nodes.empty() ? 0 : nodes.size() - 1; }
};

/// More than this on one line is a slip in a size, not a wish.
inline constexpr std::uint32_t kMaxSidesPerLine = 1'000'000;

/// Divides `curve` so that each side is about as long as the field asks at its middle, and the
/// last ends at the curve's end. With l the line's length measured in wanted sizes, the number of
/// sides is the larger of `minimumSides` and l rounded: where that is l rounded, no side differs
/// from the wish by more than 1/3 (2 sides or more by 1/4). O(sides).
[[nodiscard]] LineDivision divideLine(const Curve& curve, const SizeField& field,
                                      std::uint32_t minimumSides);

/// Puts a node in the middle, by arc length, of side `side`.
void halveSide(const Curve& curve, std::size_t side, LineDivision& division);

}  // namespace tetrafront
