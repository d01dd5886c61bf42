#pragma once

/// @file Means over what a surface encloses, from straight columns through it: along each of them
/// the crossings with the triangles tell inside from outside.

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

  /// The mean of 1 / det H over the inside. Columns, first 16 x 16 along the shortest extent, are
  /// divided where much smaller sizes may hide between them. Where a body is so thin that no column
  /// meets its inside, the mean over its triangles. O(triangles).
  [[nodiscard]] double meanDensity();

 private:
  /// Where a column enters (+1) or leaves.
  struct Crossing {
    double depth;
    int turn;
  };
  /// What is met inside along one column.
  struct Column {
    double length = 0.0;
    double integral = 0.0;
    double least = 0.0;
    double most = 0.0;
  };

  void cross(std::uint32_t columnsPerAxis, const std::vector<std::uint32_t>& active);
  void crossTriangle(std::uint32_t triangle);
  [[nodiscard]] double densityAtTriangles();
  [[nodiscard]] Column integrate(std::uint32_t place, std::uint32_t slot, double step);
  [[nodiscard]] double across(std::size_t axis, double column) const;

  const SurfaceMesh& surface_;
  const SizeField& field_;
  FieldHint hint_;
  Vec3 low_{0.0};
  Vec3 high_{0.0};
  std::array<std::size_t, 3> axes_{0, 1, 2};  ///< across, across, along the columns
  std::uint32_t perAxis_ = 0;
  std::vector<std::uint32_t> slots_;              ///< per column of the present fineness
  std::vector<std::vector<Crossing>> crossings_;  ///< per slot
};

}  // namespace tetrafront
