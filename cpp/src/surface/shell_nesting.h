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

/// What is known of one connected part of a closed surface.
struct Shell {
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;
  double volume = 0.0;  ///< enclosed; positive if its triangles are turned outward
  bool isFlat = false;  ///< the volume cannot be told from 0
};

/// `shellOf`: the number of its shell per triangle, counting from 0 in order of the first one.
[[nodiscard]] std::vector<Shell> measureShells(const SurfaceMesh& mesh,
                                               std::span<const std::uint32_t> shellOf);

class ShellNesting {
 public:
  /// `tree` holds the triangles' boxes. Everything must outlive this.
  ShellNesting(const SurfaceMesh& mesh, std::span<const std::uint32_t> shellOf,
               std::size_t shellCount, const BoxTree& tree);

  /// The shells around `shell`, ascending: those that a ray from it crosses an odd number of
  /// times. Exact, unless every node of the shell is a node of others too, where the ray begins
  /// at the rounded centre of a triangle. O(triangles near the ray).
  [[nodiscard]] std::vector<std::uint32_t> around(std::uint32_t shell) const;

 private:
  [[nodiscard]] bool isAheadOf(const Vec3& place, std::uint32_t triangle) const;

  const SurfaceMesh& mesh_;
  std::span<const std::uint32_t> shellOf_;
  const BoxTree& tree_;
  std::vector<Vec3> start_;  ///< of each shell's ray
};

}  // namespace tetrafront
