#pragma once

/// @file Tangents at the ends of Hermite lines whose tangents are not given, such that lines and smooth patches form a smooth net.
///
/// Two Hermite lines that meet at a point and turn by less than 45 degrees there continue each other: their common tangent is
/// that of the parabola through the point and its two neighbours. Then, at a point where smooth patches meet, tangents move
/// into a common plane, as a surface without an edge needs. This plane contains the tangents that cannot move; without any, it is
/// the mean of the patches' planes. Patches whose planes differ by more than 80 degrees keep their edge.

#include <cstdint>
#include <span>
#include <vector>

#include "model/curve.h"

namespace tetrafront {

/// Returns the tangents at the ends of each line, in its own direction as drawn. Lines with usableLines[line] == 0 get none.
/// Patches may be invalid. O(lines + patches log patches), apart from points at which many lines end.
[[nodiscard]] std::vector<EndTangents> endTangents(const Model& model,
                                                   std::span<const std::uint8_t> usableLines);

}  // namespace tetrafront
