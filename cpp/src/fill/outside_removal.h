#pragma once

/// @file What is outside the given triangles is dropped, once all of them are faces of the mesh: floods from
/// the tetrahedra above the triangles. Sides contradict each other only where the triangles are not the
/// closed boundary of something.

#include <array>
#include <cstdint>
#include <vector>

#include "fill/fill_mesh.h"

namespace tetrafront {

class OutsideRemoval {
 public:
  /// Both must outlive this.
  OutsideRemoval(FillMesh& mesh, const std::vector<NodeTriple>& triangles);

  /// Looks at one tetrahedron; the last step drops all that are outside.
  FillState step();

 private:
  void classify(TetId tet);
  [[nodiscard]] bool flood(TetId tet);

  FillMesh& mesh_;
  const std::vector<NodeTriple>& triangles_;
  std::vector<std::uint8_t> inside_;  ///< per tetrahedron
  std::vector<TetId> queue_;          ///< those inside
  std::vector<TetId> outside_;        ///< below a triangle
  std::size_t nextToFind_ = 0;
  std::size_t nextToFlood_ = 0;
};

}  // namespace tetrafront
