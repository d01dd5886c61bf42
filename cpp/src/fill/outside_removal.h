#pragma once

/// @file Drops the tetrahedra outside the given triangles, once all triangles are faces of the
/// mesh: floods the interior from the tetrahedra above the triangles. A tetrahedron is both inside
/// and outside only if the triangles are not a closed boundary; this is an error.

#include <array>
#include <cstdint>
#include <vector>

#include "fill/fill_mesh.h"

namespace tetrafront {

class OutsideRemoval {
 public:
  /// Both must outlive this object.
  OutsideRemoval(FillMesh& mesh, const std::vector<NodeTriple>& triangles);

  /// Visits one tetrahedron; the last step drops all exterior ones.
  FillState step();

 private:
  void classify(TetId tet);
  [[nodiscard]] bool flood(TetId tet);

  FillMesh& mesh_;
  const std::vector<NodeTriple>& triangles_;
  std::vector<std::uint8_t> inside_;  ///< per tetrahedron
  std::vector<TetId> queue_;          ///< interior tetrahedra, in order of discovery
  std::vector<TetId> outside_;        ///< tetrahedra below a triangle
  std::size_t nextToFind_ = 0;
  std::size_t nextToFlood_ = 0;
};

}  // namespace tetrafront
