#pragma once

/// @file Divides lines into sides (Löhner & Parikh 1988, section 5.1, steps S1-S4).

#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "model/curve.h"

namespace tetrafront {

enum class LineDivisionStatus : std::uint8_t {
  kDivided = 0,
  kOutsideGrid = 1,   ///< the line leaves the background grid at `position`
  kTooManySides = 2,  ///< the sizes require more than kMaxSidesPerLine sides
};

/// The nodes of a divided line, including both ends. parameters[i] belongs to nodes[i]; parameters ascend from 0 to
/// 1, and the ends are bit-exact copies of the curve's.
struct LineDivision {
  LineDivisionStatus status = LineDivisionStatus::kDivided;
  std::vector<double> parameters;
  std::vector<Vec3> nodes;
  double length = 0.0;         ///< of the line, in target sizes
  Vec3 position{0.0};          ///< where the division failed, unless kDivided
  double requiredSides = 0.0;  ///< of kTooManySides: lower estimate of the number of sides

  [[nodiscard]] std::size_t sideCount() const { return nodes.empty() ? 0 : nodes.size() - 1; }
};

/// A step of the walk S1-S4 along a line.
struct SideStep {
  enum class End : std::uint8_t {
    kSettled = 0,  ///< where the side of S3 ends
    kCapped = 1,   ///< at the limit of a step's parameter range
    kKnot = 2,     ///< at a knot of the line
  };
  double to = 0.0;      ///< parameter at which the side ends
  double start = 0.0;   ///< S1: target size where the side begins
  double length = 0.0;  ///< S3: length of the side when it is about the target size at its middle
  int rounds = 0;       ///< number of averagings in S3
  End end = End::kSettled;
};

/// Limit of the sides of one line. More of them mean that a size was mistyped.
inline constexpr std::uint32_t kMaxSidesPerLine = 1'000'000;

/// Divides `curve`, a Curve or an EdgeCurve, so that each side is about as long as the target size at its middle. Let l be the length of the
/// line in target sizes. The number of sides is l rounded, but at least `minSides`. If it is l rounded, the length of
/// each side differs from the target size by at most 1/3, and by at most 1/4 if there are 2 sides or more. The walk is
/// passed to `trace`, one of those of surface_trace.h. O(sides).
template <class Line, class Trace>
[[nodiscard]] LineDivision divideLine(const Line& curve, const SizeField& field,
                                      std::uint32_t minSides, Trace trace);
[[nodiscard]] LineDivision divideLine(const Curve& curve, const SizeField& field,
                                      std::uint32_t minSides);

/// Adds a node in the middle, by arc length, of side `side`.
template <class Line>
void halveSide(const Line& curve, std::size_t side, LineDivision& division);

}  // namespace tetrafront
