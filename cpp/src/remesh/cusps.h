#pragma once

/// @file Cusps: corners where two feature lines of one patch leave in almost the same direction, as an arc and its
/// tangent do. Short edges would give many triangles with ever smaller angles there; one long triangle at the corner, about
/// as long as the tolerance allows, has the largest angle.

#include <vector>

#include "remesh/reference_surface.h"
#include "search/box_tree.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct Cusp {
  Vec3 tip;
  double reach;  ///< length of the edges from the tip
};

struct CuspRules {
  double width = 0.0;      ///< distance between the lines up to which a cusp is narrow
  double longest = 0.0;    ///< largest length of an edge
  double tolerance = 0.0;  ///< largest deviation of an edge from its feature line
};

/// O(n) for n ends of feature lines, if few of them meet at a corner.
[[nodiscard]] std::vector<Cusp> findCusps(const ReferenceSurface& reference,
                                          const CuspRules& rules);

/// Least sizes near cusps.
class CuspSizes {
 public:
  CuspSizes() = default;
  explicit CuspSizes(std::vector<Cusp> cusps);

  /// Returns the least size at a position; 0 if no cusp is near.
  [[nodiscard]] double leastAt(const Vec3& position) const;

 private:
  std::vector<Cusp> cusps_;
  BoxTree tree_;
};

}  // namespace tetrafront
