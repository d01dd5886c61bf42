#pragma once

/// @file Verifies a finished mesh, independent of how it was made: signs are exact, faces are
/// matched by sorting, and the boundary is compared with the given surface. Together the checks
/// prove that the tetrahedra fill the region exactly once and keep its boundary.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/compensated_sum.h"
#include "base/ids.h"
#include "base/task.h"
#include "tetrafront/mesh.h"
#include "tetrafront/status.h"
#include "topology/mesh_view.h"
#include "topology/node_list_passes.h"

namespace tetrafront {

/// Numbers of defects; all zero for a valid mesh.
struct MeshDefects {
  std::uint64_t invalidNumbers =
      0;  ///< not finite, or an index out of range; then nothing else is checked
  std::uint64_t movedNodes = 0;           ///< surface nodes with another position or index
  std::uint64_t coincidentNodes = 0;      ///< used nodes at the position of another
  std::uint64_t invertedTetrahedra = 0;   ///< volume not positive, exactly
  std::uint64_t duplicateTetrahedra = 0;  ///< with the same nodes as another
  std::uint64_t nonManifoldFaces = 0;     ///< faces of more than two tetrahedra
  std::uint64_t overlappingFaces = 0;     ///< faces with two tetrahedra on the same side
  std::uint64_t extraBoundaryFaces = 0;   ///< faces of one tetrahedron that are not in the surface
  /// Triangles of the surface that are not boundary faces in their orientation, or interfaces
  /// without a tetrahedron on either side.
  std::uint64_t missingTriangles = 0;
  std::uint64_t wrongRegions = 0;  ///< tetrahedra whose region contradicts a face
  std::uint64_t wrongVolume = 0;   ///< 1 if the two volumes below differ
  /// One entity per kind of defect, the first that was found: a node or a tetrahedron of the mesh, or a triangle of
  /// the surface. None for a wrong volume.
  std::vector<Entity> examples;
  double meshVolume = 0.0;  ///< sum of the tetrahedra's volumes
  double surfaceVolume =
      0.0;  ///< volume enclosed by the surface, by the divergence theorem, without interfaces

  [[nodiscard]] std::uint64_t count() const;
};

/// Verifies a mesh in slices. O(n log k) for n tetrahedra with k at a node; about 0.3 µs each.
class MeshVerifier {
 public:
  /// `surface` is the oriented boundary; its nodes are the first of the mesh. Both must outlive this. At most about `maxFaces` faces are
  /// kept at a time; the others have to wait for a later pass over their elements.
  MeshVerifier(const MeshView& mesh, const SurfaceMesh& surface, std::size_t maxFaces = kMaxListed);

  /// Visits about `budget` tetrahedra; returns true when finished.
  bool advance(std::uint32_t budget) { return job_.advance(budget); }

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const { return job_.fraction(); }
  [[nodiscard]] const MeshDefects& defects() const { return defects_; }

 private:
  /// The two other nodes of a face; its list gives the lowest.
  struct Face {
    NodeId middle;
    NodeId highest;
    /// Owner: the tetrahedron, or the number of tetrahedra plus the triangle; shifted left by one. The last bit is
    /// isEven().
    std::uint32_t ownerAndOrientation;

    [[nodiscard]] std::size_t owner() const { return ownerAndOrientation >> 1U; }
    /// Whether the sorted nodes are counter-clockwise as seen from outside.
    [[nodiscard]] bool isEven() const { return (ownerAndOrientation & 1U) != 0; }
  };

  Task<> verify(Work& work);
  Task<> findCoincidentNodes(Work& work);
  /// Matches the faces of all elements, which `faces` has counted.
  Task<> matchFaces(Work& work, NodeListPasses<Face>& faces);

  void checkNumbers(std::size_t first, std::size_t last);
  void checkKept(std::size_t first, std::size_t last);
  void comparePositions(std::span<NodeId> nodes);
  void checkTetrahedron(TetId tet, const std::array<Vec3, 4>& corners);
  void matchFacesOf(std::span<Face> faces);
  void matchOwners(std::span<const Face> owners);
  void matchInnerRegions(const Face& one, const Face& other);
  void matchRegion(const Face& tetrahedron, const Face& triangle);
  [[nodiscard]] bool isTetrahedron(const Face& face) const;
  [[nodiscard]] TriangleId triangleOf(const Face& face) const;
  void report(std::uint64_t& count, NodeId node) { report(count, {EntityKind::kNode, node.value}); }
  void report(std::uint64_t& count, TetId tet) {
    report(count, {EntityKind::kTetrahedron, tet.value});
  }
  void report(std::uint64_t& count, TriangleId triangle) {
    report(count, {EntityKind::kTriangle, triangle.value});
  }
  void report(std::uint64_t& count, Entity entity);
  void findDuplicateTetrahedra();
  void compareVolumes();
  [[nodiscard]] double volumeRounding() const;
  template <class Use>
  void forEachFace(std::size_t first, std::size_t last, Use use) const;
  [[nodiscard]] std::size_t elementCount() const;

  MeshView mesh_;
  const SurfaceMesh& surface_;
  std::size_t maxFaces_;
  std::vector<std::uint8_t> isUsed_;  ///< per node: whether an element has it
  std::size_t tetrahedra_;            ///< number of them
  MeshDefects defects_;
  CompensatedSum volume_;        ///< of the tetrahedra
  std::vector<TetId> suspects_;  ///< tetrahedra at faces that do not match
  Job<> job_;                    ///< last, because it uses the other members
};

/// Verifies a mesh in one call.
[[nodiscard]] MeshDefects verifyMesh(const MeshView& mesh, const SurfaceMesh& surface);

}  // namespace tetrafront
