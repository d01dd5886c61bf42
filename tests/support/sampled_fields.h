#pragma once

/// @file Functions of the position, sampled at the nodes of a mesh.

#include <cstddef>
#include <functional>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront::testing {

using Field = std::function<double(const Vec3&)>;

inline Vec3 nodePosition(const VolumeMesh& mesh, std::size_t node) {
  return {mesh.points[3 * node], mesh.points[3 * node + 1], mesh.points[3 * node + 2]};
}

inline std::vector<double> atNodes(const VolumeMesh& mesh, const Field& field) {
  std::vector<double> values;
  for (std::size_t i = 0; i < mesh.points.size() / 3; ++i)
    values.push_back(field(nodePosition(mesh, i)));
  return values;
}

}  // namespace tetrafront::testing
