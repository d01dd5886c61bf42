#include "support/shape_building.h"

#include <map>
#include <vector>

#include "support/shapes.h"

namespace tetrafront::testing {

std::uint32_t addPoint(SurfaceMesh& mesh, const Vec3& p) {
  mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
  return static_cast<std::uint32_t>(mesh.points.size() / 3 - 1);
}

void addTriangle(SurfaceMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
}

void addSquare(SurfaceMesh& mesh, std::array<std::uint32_t, 4> n, bool otherDiagonal) {
  if (otherDiagonal) n = {n[1], n[2], n[3], n[0]};
  addTriangle(mesh, n[0], n[1], n[2]);
  addTriangle(mesh, n[0], n[2], n[3]);
}

SurfaceMesh joined(const SurfaceMesh& mesh) {
  SurfaceMesh result;
  std::map<std::array<double, 3>, std::uint32_t> nodes;
  std::vector<std::uint32_t> newId;
  for (std::uint32_t i = 0; i < nodeCount(mesh); ++i) {
    const Vec3 p = pointOf(mesh, i);
    const auto [at, isNew] =
        nodes.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(nodes.size()));
    if (isNew) addPoint(result, p);
    newId.push_back(at->second);
  }
  for (const std::uint32_t node : mesh.triangles) result.triangles.push_back(newId[node]);
  return result;
}

}  // namespace tetrafront::testing
