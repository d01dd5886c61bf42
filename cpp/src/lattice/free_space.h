#pragma once

/// @file What is free of triangles: distances to them, and on which side of them a position lies.

#include <array>
#include <cstddef>
#include <vector>

#include "base/task.h"
#include "search/box_tree.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class FreeSpace {
 public:
  using Triangle = std::array<Vec3, 3>;

  /// Adds closed surfaces. O(n log n).
  Task<> add(Work& work, std::vector<Triangle> triangles);

  /// Returns the distance to the nearest triangle, or `limit` if it is farther away.
  [[nodiscard]] double distance(const Vec3& position, double limit) const;
  /// Returns whether a ray from the position crosses an odd number of triangles; exact. The position lies on none.
  [[nodiscard]] bool isInside(const Vec3& position) const;

 private:
  /// Surfaces that were added together.
  struct Part {
    std::vector<Triangle> triangles;
    BoxTree tree;
  };
  std::vector<Part> parts_;
};

}  // namespace tetrafront
