#pragma once

/// @file The kernel of a node's star: the positions from which all its outer faces are visible.

#include <array>
#include <span>
#include <vector>

#include "base/ids.h"
#include "fill/exact_points.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Half-spaces of faces, in doubles. Check every result by exact signs.
class StarKernel {
 public:
  void clear() { planes_.clear(); }
  void add(const ExactPoints& points, const NodeTriple& innerFace);

  /// Searches from `start` for the position deepest inside all half-spaces, by steps of decreasing
  /// length away from the worst one.
  [[nodiscard]] Vec3 deepest(const Vec3& start) const;
  [[nodiscard]] Vec3 middle() const;

 private:
  struct Plane {
    Vec3 normal;  ///< unit length, inwards
    Vec3 position;
    Vec3 centroid;
    double size;
  };
  [[nodiscard]] double depth(const Vec3& p, std::size_t& worst) const;

  std::vector<Plane> planes_;
};

}  // namespace tetrafront
