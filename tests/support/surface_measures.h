#pragma once

/// @file Measures of a triangle surface for tests.

#include <cstdint>
#include <map>
#include <utility>

#include "field/size_field.h"
#include "tetrafront/mesh.h"

namespace tetrafront::testing {

struct SurfaceMeasures {
  std::size_t nodes = 0;
  std::size_t edges = 0;
  std::size_t triangles = 0;
  std::size_t borderEdges = 0;       ///< with one triangle
  std::size_t nonManifoldEdges = 0;  ///< with more than two
  double area = 0.0;
  double minAngle = 180.0;       ///< degrees
  double meanRadiusRatio = 0.0;  ///< 2 x inradius / circumradius, 1 equilateral
  double meanEdgeRatio = 0.0;    ///< edge length / target size at its middle

  [[nodiscard]] long eulerCharacteristic() const {
    return static_cast<long>(nodes) - static_cast<long>(edges) + static_cast<long>(triangles);
  }
};

using EdgeUse = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

/// Returns the number of triangles at each edge; the nodes of an edge are ascending.
EdgeUse countEdges(const SurfaceMesh& mesh);

SurfaceMeasures measure(const SurfaceMesh& mesh, const SizeField& field);

/// Returns the distance from a point to a surface: visits every triangle.
double distanceTo(const SurfaceMesh& mesh, const Vec3& point);

}  // namespace tetrafront::testing
