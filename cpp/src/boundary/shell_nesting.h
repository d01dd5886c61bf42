#pragma once

/// @file Shells inside shells: their volumes, and which shells contain which. Containment is decided by counting the
/// crossings of a ray, with exact signs.

#include <span>
#include <vector>

#include "search/box_tree.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/half_faces.h"

namespace tetrafront {

/// A connected set of half-faces (half_faces.h).
struct Shell {
  HalfFaceId firstHalfFace{};
  /// Enclosed volume; positive if the half-faces look inward, so that they bound a volume from outside, negative if
  /// they look outward.
  double volume = 0.0;
  bool isDegenerate = false;  ///< volume indistinguishable from 0
};

/// Returns the shells that linkHalfFaces() numbers. `shellOf`: shell of each half-face.
[[nodiscard]] std::vector<Shell> measureShells(const SurfaceMesh& mesh,
                                               std::span<const ShellId> shellOf);

class ShellNesting {
 public:
  /// `componentOf`: component of each triangle, as connectedComponents() returns it; `shellOf`: shell of each
  /// half-face; `tree`: tree of triangleBoxes(). Everything must outlive this object.
  ShellNesting(const SurfaceMesh& mesh, std::span<const ComponentId> componentOf,
               std::size_t componentCount, std::span<const ShellId> shellOf, const BoxTree& tree);

  /// Returns the shells of other components that contain this component, in ascending order: a ray from the
  /// component crosses each of them an odd number of times. Exact, unless every node of the component belongs to
  /// other components too; then the ray starts at the rounded centroid of a triangle. O(triangles near the ray).
  [[nodiscard]] std::vector<ShellId> shellsAround(ComponentId component) const;

  /// Returns how often the other components wind around this one, if all are closed and oriented; 0 outside all that are
  /// oriented outward. Does not need shells. As exact and as fast as shellsAround().
  [[nodiscard]] int windingAround(ComponentId component) const;
  /// Origin of the ray of a component.
  [[nodiscard]] const Vec3& startOf(ComponentId component) const {
    return starts_[component.index()];
  }

 private:
  template <class Visit>
  void visitCrossed(ComponentId component, Visit visit) const;

  const SurfaceMesh& mesh_;
  std::span<const ComponentId> componentOf_;
  std::span<const ShellId> shellOf_;
  const BoxTree& tree_;
  std::vector<Vec3> starts_;  ///< per component: origin of its ray
};

}  // namespace tetrafront
