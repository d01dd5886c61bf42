#include "layers/layer_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "geom/measure.h"
#include "layers/layer_metric.h"
#include "metric/mesh_metric.h"
#include "metric/metric.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// A triangle of a wall, to be found by its nodes.
struct WallFace {
  std::array<std::uint32_t, 3> nodes;
  std::uint32_t wall;
  std::uint32_t elements = 0;  ///< two between regions
  double height = 0.0;
};

constexpr auto kByNodes = [](const WallFace& a, const WallFace& b) { return a.nodes < b.nodes; };

std::array<std::uint32_t, 3> ascending(std::array<std::uint32_t, 3> nodes) {
  if (nodes[0] > nodes[1]) std::swap(nodes[0], nodes[1]);
  if (nodes[1] > nodes[2]) std::swap(nodes[1], nodes[2]);
  if (nodes[0] > nodes[1]) std::swap(nodes[0], nodes[1]);
  return nodes;
}

std::vector<WallFace> wallFacesOf(std::span<const PatchLayers> walls, const MeshAdaptation& mesh) {
  std::vector<WallFace> faces;
  for (std::size_t t = 0; t < mesh.trianglePatch.size(); ++t) {
    for (std::size_t w = 0; w < walls.size(); ++w) {
      if (walls[w].patch != mesh.trianglePatch[t]) continue;
      const std::uint32_t* const at = &mesh.triangles[3 * t];
      faces.push_back(
          {.nodes = ascending({at[0], at[1], at[2]}), .wall = static_cast<std::uint32_t>(w)});
    }
  }
  stableSort(faces, kByNodes);
  return faces;
}

/// Returns the height of an element above one of its faces.
double heightOf(const std::array<Vec3, 4>& corners, const std::array<std::uint8_t, 3>& face) {
  const Vec3 normal =
      glm::cross(corners[face[1]] - corners[face[0]], corners[face[2]] - corners[face[0]]);
  const std::size_t apex = std::size_t{6} - face[0] - face[1] - face[2];
  return std::fabs(glm::dot(unitOf(normal), corners[apex] - corners[face[0]]));
}

}  // namespace

Task<> describeLayers(Work& work, std::span<const PatchLayers> walls, LayeredMesh& made) {
  for (const PatchLayers& wall : walls) {
    made.walls.push_back({.patch = wall.patch,
                          .triangles = 0,
                          .meanFirstHeight = 0.0,
                          .thickness = LayerSizes(wall, 1.0).thickness()});
  }
  std::vector<WallFace> faces = wallFacesOf(walls, made.adaptation);
  VolumeMesh mesh;
  mesh.points = made.adaptation.points;
  mesh.tetrahedra = made.adaptation.tetrahedra;
  co_await work.forEachId<TetId>(countTetrahedra(mesh), [&](TetId tet) {
    const std::array<Vec3, 4> corners = cornersOf(mesh, tet);
    const SymmetricTensor shape = impliedMetric(corners);
    made.largestAspect = std::max(made.largestAspect, stretchedSizeOf(shape).stretching);
    for (std::uint32_t k = 0; k < 4; ++k) {
      const auto [a, b, c] = nodesOf(mesh, ElementFace(tet, k));
      const WallFace own{.nodes = ascending({a.value, b.value, c.value}), .wall = 0};
      const auto found = std::ranges::lower_bound(faces, own, kByNodes);
      if (found == faces.end() || found->nodes != own.nodes) continue;
      ++found->elements;
      found->height = heightOf(corners, kFaceCorners[k]);
    }
  });
  for (const WallFace& face : faces) {
    if (face.elements != 1) continue;
    ++made.walls[face.wall].triangles;
    made.walls[face.wall].meanFirstHeight += face.height;
  }
  for (PatchLayersMade& wall : made.walls)
    if (wall.triangles > 0) wall.meanFirstHeight /= wall.triangles;
}

}  // namespace tetrafront
