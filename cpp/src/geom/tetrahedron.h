#pragma once

/// @file The faces of a tetrahedron.

#include <array>
#include <cstdint>

namespace tetrafront {

/// Corners of face i, which lies opposite corner i, counter-clockwise as seen from outside a
/// tetrahedron of positive volume.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kFaceCorners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace tetrafront
