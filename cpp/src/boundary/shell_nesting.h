#pragma once

/// @file Shells within shells: their volumes, and which lie around which by counting the
/// crossings of a ray, decided by exact signs.

#include <cstdint>
#include <span>
#include <vector>

#include "search/box_tree.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// What is known of one connected set of triangle sides (half_faces.h).
struct Shell {
  std::uint32_t firstHalfFace = 0;
  /// Enclosed; positive if the sides look inward, so that they bound a space from outside, negative
  /// if they look outward.
  double volume = 0.0;
  bool isFlat = false;  ///< the volume cannot be told from 0
};

/// `shellOf`: the shell per side, as linkHalfFaces() numbers them.
[[nodiscard]] std::vector<Shell> measureShells(const SurfaceMesh& mesh,
                                               std::span<const std::uint32_t> shellOf);

class ShellNesting {
 public:
  /// `componentOf`: per triangle, as connectedComponents() numbers them; `shellOf`: per side. `tree` holds the
  /// triangles' boxes. Everything must outlive this.
  ShellNesting(const SurfaceMesh& mesh, std::span<const std::uint32_t> componentOf,
               std::size_t componentCount, std::span<const std::uint32_t> shellOf,
               const BoxTree& tree);

  /// The shells of other parts around `part`, ascending: those that a ray from it crosses an odd
  /// number of times. Exact, unless every node of the part is a node of others too, where the ray
  /// begins at the rounded centre of a triangle. O(triangles near the ray).
  [[nodiscard]] std::vector<std::uint32_t> around(std::uint32_t part) const;

 private:
  [[nodiscard]] bool isAheadOf(const Vec3& place, std::uint32_t triangle) const;

  const SurfaceMesh& mesh_;
  std::span<const std::uint32_t> componentOf_;
  std::span<const std::uint32_t> shellOf_;
  const BoxTree& tree_;
  std::vector<Vec3> start_;  ///< of each part's ray
};

}  // namespace tetrafront
