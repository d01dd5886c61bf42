#pragma once

/// @file Typed indices: a NodeId does not convert to a FaceId.

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tetrafront {

/// The index that stands for "none" where plain indices are stored; a typed one is default-constructed.
inline constexpr std::uint32_t kNoIndex = std::numeric_limits<std::uint32_t>::max();

/// Index into the flat arrays of entities of one kind; 32 bits, as in the arrays of a mesh.
template <class Tag>
struct Id {
  std::uint32_t value = kNoIndex;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}

  [[nodiscard]] constexpr bool isNone() const { return value == kNoIndex; }
  [[nodiscard]] constexpr std::size_t index() const { return value; }
  friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

// What the user draws.
using PointId = Id<struct PointTag>;
using LineId = Id<struct LineTag>;
using PatchId = Id<struct PatchTag>;
using RegionId = Id<struct RegionTag>;

// What the mesher makes, or is given: nodes and edges of any mesh, triangles of a surface, faces of the front or
// of tetrahedra.
using NodeId = Id<struct NodeTag>;
using EdgeId = Id<struct EdgeTag>;
using TriangleId = Id<struct TriangleTag>;
using FaceId = Id<struct FaceTag>;
using TetId = Id<struct TetTag>;

// What the sizes come from. The ids of a background grid differ from those of a mesh, which is often near it.
using GridNodeId = Id<struct GridNodeTag>;
using GridTetId = Id<struct GridTetTag>;
using SourceId = Id<struct SourceTag>;

/// The ids [0, count) in ascending order: `for (const NodeId node : IdRange<NodeId>(count))`.
template <class AnyId>
class IdRange {
 public:
  class Iterator {
   public:
    constexpr explicit Iterator(std::uint32_t index) : index_(index) {}
    constexpr AnyId operator*() const { return AnyId(index_); }
    constexpr Iterator& operator++() {
      ++index_;
      return *this;
    }
    friend constexpr bool operator==(const Iterator&, const Iterator&) = default;

   private:
    std::uint32_t index_;
  };

  constexpr explicit IdRange(std::size_t count) : count_(static_cast<std::uint32_t>(count)) {}
  [[nodiscard]] constexpr Iterator begin() const { return Iterator(0); }
  [[nodiscard]] constexpr Iterator end() const { return Iterator(count_); }

 private:
  std::uint32_t count_;
};

using NodeTriple = std::array<NodeId, 3>;  ///< nodes of a triangle, in its orientation
using NodeQuad = std::array<NodeId, 4>;    ///< nodes of a tetrahedron
using GridNodeQuad = std::array<GridNodeId, 4>;

}  // namespace tetrafront
