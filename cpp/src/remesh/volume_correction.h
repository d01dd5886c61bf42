#pragma once

/// @file Moves nodes off curved patches and lines, so that the remeshed surface encloses the volume of the given one.
/// Nodes on a convex patch leave all triangles inside it. If each node moves by the mean distance of its triangles from
/// the patch, the triangles lie partly outside and partly inside; the largest distance also becomes smaller.

#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "remesh/guarded_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Corrects the connected parts of the surface whose volumes have changed. A part that has the given volume, up to a small
/// fraction, stays as it is, so remeshing a result again changes little.
class VolumeCorrection {
 public:
  /// `surface` must outlive this.
  explicit VolumeCorrection(GuardedSurface& surface);

  /// The surface is valid whenever the task yields.
  Task<> run(Work& work);

 private:
  void findParts();
  [[nodiscard]] bool findChanged();
  [[nodiscard]] bool isSelected(TriangleId triangle) const;
  using AddGap = void (VolumeCorrection::*)(TriangleId triangle);
  Task<> correct(Work& work, AddGap add);
  void addLineGaps(TriangleId triangle);
  void addPatchGap(TriangleId triangle);
  void addEvenGap(TriangleId triangle);
  void addGap(TriangleId triangle, double height);
  void move(NodeId node);
  bool tryMove(NodeId node, const Vec3& to);
  [[nodiscard]] bool followsLine(NodeId node, const Vec3& to) const;

  GuardedSurface& surface_;
  const SurfaceComplex& complex_;
  const ReferenceSurface& reference_;
  std::vector<std::uint32_t> partOf_;  ///< per smooth patch
  std::vector<double> given_;          ///< per part: volume, times 6
  std::vector<std::uint8_t>
      isChanged_;                ///< per part: true if its volume differs from the given one
  std::vector<double> evenGap_;  ///< per part: missing volume / area of its curved patches

  /// What a node has around it.
  struct Gap {
    Vec3 sum{
        0.0};  ///< of the distances from the given surface to the triangles or edges, times their weights
    double weight = 0.0;
  };
  std::vector<Gap> gaps_;  ///< per node
  SurfaceChange change_;
};

}  // namespace tetrafront
