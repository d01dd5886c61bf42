#include "quality/mesh_boundary.h"

#include <cstddef>

#include "topology/face_table.h"
#include "topology/mesh_access.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

enum class Part : std::uint8_t { kNone, kBoundary, kInterface };

std::uint32_t regionOf(const VolumeMesh& mesh, TetId tet) {
  return mesh.regions.empty() ? 0 : mesh.regions[tet.index()];
}

}  // namespace

Task<MeshBoundary> findMeshBoundary(Work& work, const VolumeMesh& mesh) {
  work.beginPart(0.5);
  auto faces = co_await listFaces<ElementFace>(work, countNodes(mesh), countTetrahedra(mesh),
                                               [&mesh](std::size_t tet, const auto& use) {
                                                 for (std::size_t k = 0; k < 4; ++k) {
                                                   const ElementFace face(TetId(tet), k);
                                                   use(nodesOf(mesh, face), face);
                                                 }
                                               });
  work.beginPart(0.8);
  std::vector<Part> partOf(mesh.tetrahedra.size(), Part::kNone);  // by ElementFace::index()
  co_await work.forEachId<NodeId>(countNodes(mesh), [&](NodeId node) {
    faces.forEachGroup(node, [&](const auto& group) {
      const ElementFace first = group[0].owner;
      if (group.size() == 1) {
        partOf[first.index()] = Part::kBoundary;
      } else if (regionOf(mesh, first.tet()) != regionOf(mesh, group[1].owner.tet())) {
        partOf[first.index()] = Part::kInterface;
      }
    });
  });
  work.beginPart(1.0);
  MeshBoundary found;
  co_await work.forEachId<TetId>(countTetrahedra(mesh), [&](TetId tet) {
    for (std::size_t k = 0; k < 4; ++k) {
      const ElementFace face(tet, k);
      const Part part = partOf[face.index()];
      if (part == Part::kNone) continue;
      std::vector<std::uint32_t>& triangles =
          part == Part::kInterface ? found.interfaces : found.boundary.triangles;
      for (const NodeId node : nodesOf(mesh, face)) triangles.push_back(node.value);
      if (part == Part::kBoundary) found.boundary.trianglePatch.push_back(regionOf(mesh, tet));
    }
  });
  co_return found;
}

}  // namespace tetrafront
