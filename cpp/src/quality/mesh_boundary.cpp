#include "quality/mesh_boundary.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetrafront {
namespace {

/// The faces of a b c d (mesh.h) by position.
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct Face {
  std::array<std::uint32_t, 3> nodes;  ///< ascending
  std::uint32_t owner;                 ///< 4 x element + face

  [[nodiscard]] bool isBefore(const Face& other) const {
    return nodes != other.nodes ? nodes < other.nodes : owner < other.owner;
  }
};

std::array<std::uint32_t, 3> faceOf(const VolumeMesh& mesh, std::uint32_t owner) {
  const std::size_t first = 4 * std::size_t{owner / 4};
  std::array<std::uint32_t, 3> nodes{};
  for (std::size_t k = 0; k < 3; ++k) nodes[k] = mesh.tetrahedra[first + kFaces[owner % 4][k]];
  return nodes;
}

}  // namespace

SurfaceMesh boundaryOf(const VolumeMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(mesh.tetrahedra.size());
  for (std::uint32_t owner = 0; owner < mesh.tetrahedra.size(); ++owner) {
    Face face{faceOf(mesh, owner), owner};
    std::sort(face.nodes.begin(), face.nodes.end());
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.isBefore(b); });
  std::vector<std::uint32_t> single;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool hasTwinBefore = i > 0 && faces[i - 1].nodes == faces[i].nodes;
    const bool hasTwinAfter = i + 1 < faces.size() && faces[i + 1].nodes == faces[i].nodes;
    if (!hasTwinBefore && !hasTwinAfter) single.push_back(faces[i].owner);
  }
  std::sort(single.begin(), single.end());
  SurfaceMesh boundary;
  for (const std::uint32_t owner : single) {
    const std::array<std::uint32_t, 3> nodes = faceOf(mesh, owner);
    boundary.triangles.insert(boundary.triangles.end(), nodes.begin(), nodes.end());
    boundary.trianglePatch.push_back(mesh.regions.empty() ? 0 : mesh.regions[owner / 4]);
  }
  return boundary;
}

}  // namespace tetrafront
