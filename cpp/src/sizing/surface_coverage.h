#pragma once

/// @file Does the background grid cover a given surface (step F1)? Asked before it is filled.

#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Looks at every node and at the middle of every triangle, in slices.
class SurfaceCoverage {
 public:
  /// Both must outlive the check.
  SurfaceCoverage(const SurfaceMesh& surface, const SizeField& field)
      : surface_(&surface), field_(&field) {}

  /// Works on for `budget` places; true when finished.
  bool advance(std::uint32_t budget);

  /// After advance() has returned true: nothing, or one kOutsideBackgroundGrid that names the first
  /// node (else triangle) outside, with its place and, as its value, how many places are outside.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;

 private:
  [[nodiscard]] Vec3 placeOf(std::size_t node) const;
  [[nodiscard]] Vec3 middleOf(std::size_t triangle) const;
  void look(const Vec3& place, const Entity& entity);

  const SurfaceMesh* surface_;
  const SizeField* field_;
  FieldHint hint_;
  std::size_t seen_ = 0;  ///< places: the nodes, then the triangles
  std::size_t outside_ = 0;
  Entity first_;
  Vec3 firstPlace_{0.0};
};

}  // namespace tetrafront
