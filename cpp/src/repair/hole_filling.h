#pragma once

/// @file Closes small holes of a surface without new nodes.

#include <cstdint>
#include <memory>
#include <vector>

#include "tetrafront/mesh.h"

namespace tetrafront {

struct FilledHole {
  std::uint32_t firstTriangle = 0;  ///< position in `triangles` of the mesh
  std::uint32_t triangles = 0;
};

/// Closes the holes of at most `maxEdges` edges, in slices: of all triangulations of a hole without new
/// nodes, without triangles of no area, without edges that exist elsewhere and without triangles that
/// isIntersectedBy others or the given surface but where they should, by one of least area (Barequet & Sharir 1995;
/// triangles that isIntersectedBy others are barred, and the least of what is left is looked for again). Where there is
/// none, or none is found soon, the hole stays. That two holes' triangles isIntersectedBy each other is left to the check of
/// the whole. New triangles are turned as one at the hole's edge is. O(n log n), and O(edges^3) for each
/// try.
class HoleFiller {
 public:
  /// Finds the holes. Triangles are appended to `mesh`, which must outlive this. Those with a repeated
  /// node should be gone: what they have for edges counts as open.
  HoleFiller(SurfaceMesh& mesh, std::uint32_t maxEdges);
  HoleFiller(HoleFiller&&) noexcept;
  HoleFiller& operator=(HoleFiller&&) noexcept;
  ~HoleFiller();

  /// Tries triangulations of about `budget` edges together; true when finished.
  bool advance(std::uint32_t budget);

  [[nodiscard]] const std::vector<FilledHole>& filled() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
