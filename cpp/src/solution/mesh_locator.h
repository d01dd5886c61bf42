#pragma once

/// @file Finds the element of a mesh at a position, or the nearest one.

#include <array>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "search/box_tree.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

class MeshLocator {
 public:
  struct Location {
    TetId element{0U};
    std::array<double, 4>
        weights{};          ///< of its nodes, >= 0, sum 1: those of the nearest point if outside
    double distance = 0.0;  ///< outside the mesh, 0 inside
  };

  /// `mesh` must outlive the locator, have an element and no degenerate ones. O(n).
  static Task<MeshLocator> build(Work& work, const VolumeMesh& mesh);

  /// Returns the element that contains the position, on a face of several the one deepest inside, then the lowest;
  /// outside the mesh, the nearest element. The same for every order of calls. O(log n).
  [[nodiscard]] Location locate(const Vec3& position) const;

  [[nodiscard]] const BoxTree& tree() const { return tree_; }

 private:
  MeshLocator(const VolumeMesh& mesh, BoxTree tree) : mesh_(&mesh), tree_(std::move(tree)) {}
  [[nodiscard]] Location nearest(const Vec3& position) const;

  const VolumeMesh* mesh_;
  BoxTree tree_;
};

/// The barycentric coordinates of a tetrahedron, as linear functions.
class BarycentricFrame {
 public:
  explicit BarycentricFrame(const std::array<Vec3, 4>& p);
  [[nodiscard]] std::array<double, 4> at(const Vec3& position) const;

 private:
  Vec3 origin_;
  std::array<Vec3, 3> gradients_;  ///< of the coordinates of corners 1, 2 and 3
};

}  // namespace tetrafront
