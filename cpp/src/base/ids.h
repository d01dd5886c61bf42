#pragma once

/// @file Typed indices: a NodeId does not convert to a FaceId.

#include <array>
#include <compare>
#include <cstdint>
#include <limits>

namespace tetrafront {

/// A position in a flat array of things of kind Tag; 32 bits, as everything is stored.
template <class Tag>
struct Id {
  std::uint32_t value = kNone;

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}

  [[nodiscard]] constexpr bool isNone() const { return value == kNone; }
  [[nodiscard]] constexpr std::size_t index() const { return value; }
  friend constexpr auto operator<=>(const Id&, const Id&) = default;  // NOLINT(*-use-nullptr)
};

using NodeId = Id<struct NodeTag>;
using FaceId = Id<struct FaceTag>;
using TetId = Id<struct TetTag>;
using LineId = Id<struct LineTag>;
using PatchId = Id<struct PatchTag>;

using NodeTriple = std::array<NodeId, 3>;  ///< nodes of a triangle, in its orientation
using NodeQuad = std::array<NodeId, 4>;    ///< nodes of a tetrahedron

}  // namespace tetrafront
