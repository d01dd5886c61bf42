#pragma once

/// @file Where in the empty star of a node its faces are all seen.

#include <array>
#include <span>
#include <vector>

#include "base/ids.h"
#include "fill/exact_points.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Half-spaces of faces, in doubles: what is found must be checked by signs.
class StarKernel {
 public:
  void clear() { planes_.clear(); }
  void add(const ExactPoints& points, const NodeTriple& innerFace);

  /// The position deepest inside all half-spaces, sought from `start` by steps away from the worst.
  [[nodiscard]] Vec3 deepest(const Vec3& start) const;
  [[nodiscard]] Vec3 middle() const;

 private:
  struct Plane {
    Vec3 normal;  ///< of unit length, inwardDirection
    Vec3 position;
    Vec3 centroid;
    double size;
  };
  [[nodiscard]] double depth(const Vec3& p, std::size_t& worst) const;

  std::vector<Plane> planes_;
};

}  // namespace tetrafront
