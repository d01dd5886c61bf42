#pragma once

/// @file Checks before meshing whether the background grid covers a given surface (step F1).

#include <cstdint>
#include <vector>

#include "base/resumable.h"
#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Checks every node and the centroid of every triangle, in slices.
class SurfaceCoverage : public Resumable {
 public:
  /// Both must outlive this.
  SurfaceCoverage(const SurfaceMesh& surface, const SizeField& field)
      : Resumable(surface.points.size() / 3 + surface.triangles.size() / 3),
        surface_(surface),
        field_(field) {}

  /// Checks `budget` positions; returns true when finished.
  bool advance(std::uint32_t budget);

  /// When finished: nothing, or one kOutsideBackgroundGrid. It names the first node outside, or else the first
  /// triangle, with its position. Its value is the number of positions outside.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;

 private:
  void check(const Vec3& position, const Entity& entity);

  const SurfaceMesh& surface_;
  const SizeField& field_;
  FieldHint hint_;
  std::size_t outside_ = 0;
  Entity first_;
  Vec3 firstPosition_{0.0};
};

}  // namespace tetrafront
