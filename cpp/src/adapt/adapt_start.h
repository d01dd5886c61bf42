#pragma once

/// @file From a given mesh to the mesh that an adaptation changes, and back to flat arrays.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/adapt_mesh.h"
#include "adapt/boundary_guide.h"
#include "base/task.h"
#include "optimize/given_mesh.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Looks up the patches of given triangles by their nodes.
class PatchTable {
 public:
  PatchTable(std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> patches);

  /// Returns 0 if there is no such triangle.
  [[nodiscard]] std::uint32_t patchOf(const std::array<std::uint32_t, 3>& nodes) const;

 private:
  struct Entry {
    std::array<std::uint32_t, 3> nodes;
    std::uint32_t patch;
  };
  std::vector<Entry> entries_;
};

/// The faces of a given mesh: which elements are neighbours, and which faces bound it.
struct StartFaces {
  std::vector<Beyond>
      beyond;  ///< four per element; a patch is not known yet, so an outer face is an index into `outer`
  std::vector<ElementFace>
      outer;             ///< faces of the boundary, in the order of the triangles of `boundary`
  SurfaceMesh boundary;  ///< the outer boundary, with the nodes of the mesh and the given patches
  std::vector<std::uint8_t> isFixed;  ///< per node: 1 if it is on a kept face
};

/// Finds the faces. `triangles` and `trianglePatch`: given triangles of the given mesh with their patches.
Task<StartFaces> findStartFaces(Work& work, const GivenMesh& given,
                                std::span<const std::uint32_t> triangles,
                                std::span<const std::uint32_t> trianglePatch);

/// Returns per node of the given mesh 1 if its elements are not all connected over their common faces: the mesh touches itself.
std::vector<std::uint8_t> nodesInSeveralSets(const GivenMesh& given, const StartFaces& faces);

/// Where the nodes and the outer faces of a mesh lie on the boundary that the adaptation follows.
struct BoundaryPlaces {
  std::vector<Place> nodes;            ///< one per node
  std::vector<SmoothPatchId> patches;  ///< one per outer face
};

/// Returns the places of the mesh whose outer boundary is the reference of the guide.
BoundaryPlaces placesOnReference(const BoundaryGuide& guide);

/// The mesh that an adaptation begins with.
struct AdaptStart {
  AdaptMesh mesh;
  std::vector<NodeId> origin;  ///< per node of `mesh`: its index in the given mesh
};

/// Makes the mesh, without metrics: a node is repeated for each set of its elements that are connected over faces.
AdaptStart makeStart(const GivenMesh& given, const StartFaces& faces, const BoundaryPlaces& places);

}  // namespace tetrafront
