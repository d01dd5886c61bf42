#pragma once

/// @file A TrimmedModel as one array of numbers, in which it crosses from the package to the engine:
///
///     vertices  count, then x y z each
///     curves    count, then a space curve each
///     surfaces  count, then each: kind, then
///               spline: degrees, knots of u, knots of v, poles, weights
///               others: frame, radius, minor radius, half angle; of an extrusion or a revolution, the profile: a space curve
///     edges     count, then each: curve or -1, first, last, start, end, tolerance
///     faces     count, then each: surface, reversed (0 or 1), solid, other solid or -1, loops: count, then each: coedges:
///               count, then each: edge, reversed (0 or 1), plane curve or -1
///
/// A curve is its kind, then degree, knots, poles and weights of a spline, or frame, radius and minor radius. A list of numbers
/// begins with its length; poles are lists of coordinates. A frame is the origin and the axes. Kinds are the values of the enums.
/// Several models may follow each other; indices of each refer to its own items.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tetrafront/trimmed_model.h"

namespace tetrafront {

/// A model that was read, with what is known to be valid.
struct ReadModel {
  TrimmedModel model;
  /// Per surface and per edge: 0 if evaluating it could fail. A degenerate edge is valid.
  std::vector<std::uint8_t> isSurfaceValid;
  std::vector<std::uint8_t> isEdgeValid;
  /// Whether everything can be evaluated, also the curves in the planes of faces: what TrimmedMesher needs.
  bool isSound = false;
};

/// Reads models as one; none if the array ends early, or if an index refers to nothing. O(numbers + models * faces).
[[nodiscard]] std::optional<ReadModel> readModel(std::span<const double> numbers);

}  // namespace tetrafront
