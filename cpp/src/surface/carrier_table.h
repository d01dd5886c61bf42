#pragma once

/// @file The carriers of a patch's boundary: which of its straight lines lie on the same infinite line of the plane.

#include <cstdint>
#include <vector>

#include "search/quadtree.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

/// Each carrier is stored in a tree at its direction and its distance from the middle of the region, so that only
/// carriers near a line in both are compared with it.
class CarrierTable {
 public:
  /// All lines must lie within `region`.
  explicit CarrierTable(const PlaneBox& region);

  /// Returns the first carrier that both ends of a line lie on, or adds one. O(log n) unless many parallel lines
  /// are close to each other.
  [[nodiscard]] CarrierId findOrAdd(const Vec2& from, const Vec2& to);

 private:
  struct Carrier {
    Vec2 from;
    Vec2 direction;  ///< not normalized
  };

  [[nodiscard]] Vec2 dualOf(const Vec2& from, Vec2 direction) const;
  void gatherNear(const Vec2& dual, double length);
  [[nodiscard]] static bool isOn(const Carrier& carrier, const Vec2& position);

  Vec2 middle_;
  double extent_;
  Quadtree tree_;
  std::vector<Carrier> carriers_;
  std::vector<std::uint32_t> near_;
};

}  // namespace tetrafront
