#pragma once

/// @file The faces and edges of a tetrahedron.

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "base/ids.h"

namespace tetrafront {

/// Corners of face i, which lies opposite corner i, counter-clockwise as seen from outside a
/// tetrahedron of positive volume.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kFaceCorners{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Corners at the ends of an edge, and the other two, so that (from, to, left, right) is positively oriented.
struct TetEdge {
  std::uint8_t from;
  std::uint8_t to;
  std::uint8_t left;
  std::uint8_t right;
};

/// All edges, each with its lower corner first; edges e and 5 - e are opposite.
inline constexpr std::array<TetEdge, 6> kTetEdges{
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

/// A face of a tetrahedron: the tetrahedron and the opposite corner.
template <class AnyTetId>
class FaceOf {
 public:
  constexpr FaceOf() = default;
  constexpr FaceOf(AnyTetId tet, std::size_t corner)
      : packed_(tet.value << 2 | static_cast<std::uint32_t>(corner)) {}

  [[nodiscard]] constexpr bool isNone() const { return packed_ == kNoIndex; }
  [[nodiscard]] constexpr AnyTetId tet() const { return AnyTetId(packed_ >> 2); }
  [[nodiscard]] constexpr std::size_t corner() const { return packed_ & 3U; }
  /// Index into an array with four entries per tetrahedron.
  [[nodiscard]] constexpr std::size_t index() const { return packed_; }
  friend constexpr auto operator<=>(const FaceOf&, const FaceOf&) = default;

 private:
  std::uint32_t packed_ = kNoIndex;
};

using ElementFace = FaceOf<TetId>;
using GridTetFace = FaceOf<GridTetId>;

}  // namespace tetrafront
