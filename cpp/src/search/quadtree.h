#pragma once

/// @file A quadtree of small boxes in the plane (Löhner & Parikh 1988, second section 6, structure
/// (2)): finds the edges of a planar front near a position. A box is stored in the leaf that
/// contains its centre. Each node knows how far the boxes below it extend beyond it, so strongly
/// graded sizes increase the depth, not the width.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// An axis-parallel box in the plane.
struct PlaneBox {
  Vec2 low{0.0};
  Vec2 high{0.0};

  static PlaneBox of(const Vec2& a, const Vec2& b);
  void include(const Vec2& position);
  [[nodiscard]] bool overlaps(const PlaneBox& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
           other.low.y <= high.y;
  }
  [[nodiscard]] bool holds(const Vec2& position) const {
    return low.x <= position.x && position.x <= high.x && low.y <= position.y &&
           position.y <= high.y;
  }
};

class Quadtree {
 public:
  /// `region`: where boxes are expected; others are found too, but more slowly.
  explicit Quadtree(const PlaneBox& region);

  /// Ids are small indices chosen by the caller; `id` must not be in the tree. O(depth).
  void insert(std::uint32_t id, const PlaneBox& box);
  /// `id` must be in the tree. O(1).
  void remove(std::uint32_t id);

  /// Appends every id whose box overlaps `box`, in an order that depends only on the sequence of
  /// calls.
  void query(const PlaneBox& box, std::vector<std::uint32_t>& found) const;

 private:
  struct Item {
    PlaneBox box;
    std::uint32_t next = kNoIndex;
    std::uint32_t previous = kNoIndex;
    std::uint32_t leaf = kNoIndex;
  };
  struct Node {
    Vec2 centre{0.0};
    Vec2 halfWidth{0.0};
    Vec2 reach{0.0};  ///< largest extent of any box added below beyond the node's region
    std::uint32_t firstChild = kNoIndex;
    std::uint32_t head = kNoIndex;
    std::uint32_t count = 0;
    std::uint32_t depth = 0;
  };

  void link(std::uint32_t node, std::uint32_t id);
  void split(std::uint32_t node);
  [[nodiscard]] std::uint32_t childAt(const Node& node, const Vec2& centre) const;

  std::vector<Node> nodes_;
  std::vector<Item> items_;
  mutable std::vector<std::uint32_t> stack_;
};

}  // namespace tetrafront
