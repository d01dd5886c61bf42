#pragma once

/// @file Triangulations of a hole without new nodes, by least area (Barequet & Sharir 1995).

#include <cstddef>
#include <limits>
#include <vector>

#include "geom/intersect.h"
#include "repair/open_rims.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Triangulates one rim by dynamic programming. Triangles can be excluded, so that the next solution avoids them.
class RimTriangulation {
 public:
  /// A triangle of the triangulation: ascending indices in the rim.
  struct Corners {
    std::size_t first;
    std::size_t apex;
    std::size_t last;
  };

  /// `mesh` must outlive this object.
  RimTriangulation(const SurfaceMesh& mesh, Rim rim);

  /// Returns the triangulation of least area without degenerate or excluded triangles and without new edges (a, b)
  /// with edgeExists(a, b); empty if there is none. O(n^3) for n edges of the rim.
  template <class EdgeExists>
  [[nodiscard]] std::vector<Corners> solve(const EdgeExists& edgeExists);

  /// Returns the triangle, oriented as the surface beside the first half-edge of the rim.
  [[nodiscard]] NumberedTriangle triangleOf(const Corners& corners) const;

  void exclude(const Corners& corners);

 private:
  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i * rim_.size() + j; }
  [[nodiscard]] std::size_t at(const Corners& corners) const {
    return at(at(corners.first, corners.apex), corners.last);
  }
  void chooseApex(std::size_t first, std::size_t last);
  [[nodiscard]] std::vector<Corners> chosen() const;

  const SurfaceMesh& mesh_;
  Rim rim_;
  /// Entry at(i, j) belongs to the polygon of the corners from i to j.
  std::vector<double> cost_;       ///< twice the least area; infinite if there is no triangulation
  std::vector<std::size_t> apex_;  ///< third corner of the triangle on the chord from i to j
  std::vector<bool> isExcluded_;   ///< per triangle; empty if none is excluded
};

template <class EdgeExists>
std::vector<RimTriangulation::Corners> RimTriangulation::solve(const EdgeExists& edgeExists) {
  const std::size_t count = rim_.size();
  for (std::size_t span = 2; span < count; ++span) {
    for (std::size_t i = 0; i + span < count; ++i) {
      const std::size_t j = i + span;
      const bool isOnRim = span == count - 1;
      cost_[at(i, j)] = std::numeric_limits<double>::infinity();
      if (isOnRim || !edgeExists(rim_[i], rim_[j])) chooseApex(i, j);
    }
  }
  return chosen();
}

}  // namespace tetrafront
