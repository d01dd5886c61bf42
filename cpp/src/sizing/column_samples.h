#pragma once

/// @file Means over the interior of a surface, from samples on straight columns through it. The crossings of a column
/// with the triangles separate the inside from the outside.

#include <array>
#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class ColumnSamples {
 public:
  /// The surface must be closed, oriented and not empty. Both must outlive this.
  ColumnSamples(const SurfaceMesh& surface, const SizeField& field);

  /// Returns the mean of 1 / det H over the interior, with H the tensor of target sizes. The first 16 x 16 columns run
  /// along the shortest of the three extents. Columns are divided where much smaller sizes may be hidden between them.
  /// If the surface is so thin that no column crosses its interior, returns the mean over its triangles. O(triangles).
  [[nodiscard]] double meanDensity();

 private:
  /// A crossing of a column with a triangle.
  struct Crossing {
    double depth;
    int winding;  ///< +1 if the column enters there, -1 if it leaves
  };
  /// The interior along one column.
  struct Column {
    double length = 0.0;
    double integral = 0.0;  ///< of 1 / det H
    double minSize = 0.0;
    double maxSize = 0.0;
  };

  void cross(std::uint32_t columnsPerAxis, const std::vector<std::uint32_t>& active);
  void crossTriangle(std::uint32_t triangle);
  [[nodiscard]] double densityAtTriangles();
  [[nodiscard]] Column integrate(std::uint32_t column, std::uint32_t slot, double step);
  [[nodiscard]] double across(std::size_t axis, double column) const;

  const SurfaceMesh& surface_;
  const SizeField& field_;
  FieldHint hint_;
  Vec3 low_{0.0};
  Vec3 high_{0.0};
  std::array<std::size_t, 3> axes_{0, 1, 2};  ///< two across the columns, then the one along them
  std::uint32_t perAxis_ = 0;                 ///< columns along each axis across them
  std::vector<std::uint32_t> slots_;  ///< per column: its slot, or kNoIndex if it is not active
  std::vector<std::vector<Crossing>> crossings_;  ///< per slot
};

}  // namespace tetrafront
