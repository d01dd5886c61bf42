#include "topology/tet_mesh.h"

#include <algorithm>
#include <utility>

#include "topology/mesh_access.h"

namespace tetrafront {

VolumeMesh toVolumeMesh(TetMesh mesh) {
  VolumeMesh flat;
  flat.points.reserve(3 * mesh.points.size());
  for (const Vec3& p : mesh.points) flat.points.insert(flat.points.end(), {p.x, p.y, p.z});
  flat.tetrahedra.reserve(4 * mesh.tetrahedra.size());
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    flat.tetrahedra.insert(flat.tetrahedra.end(), {a.value, b.value, c.value, d.value});
  }
  flat.regions = std::move(mesh.regions);
  for (const auto& [a, b, c] : mesh.front) {
    flat.front.insert(flat.front.end(), {a.value, b.value, c.value});
  }
  return flat;
}

std::vector<std::uint8_t> firstFixed(std::size_t fixed, std::size_t nodes) {
  std::vector<std::uint8_t> marks(nodes, 0);
  std::fill_n(marks.begin(), fixed, std::uint8_t{1});
  return marks;
}

TetMesh toTetMesh(const VolumeMesh& mesh, std::size_t fixed) {
  TetMesh result;
  result.points.reserve(countNodes(mesh));
  for (const NodeId node : IdRange<NodeId>(countNodes(mesh))) {
    result.points.push_back(pointOf(mesh, node));
  }
  result.tetrahedra.reserve(countTetrahedra(mesh));
  for (const TetId tet : IdRange<TetId>(countTetrahedra(mesh))) {
    result.tetrahedra.push_back(nodesOf(mesh, tet));
  }
  result.regions = mesh.regions;
  result.isFixed = firstFixed(fixed, countNodes(mesh));
  return result;
}

}  // namespace tetrafront
