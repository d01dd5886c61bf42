#pragma once

/// @file An independent judgement of a finished mesh. Nothing here relies on how the mesh was
/// made: signs are exact, faces are matched by sorting, and the boundary is compared with the
/// surface that was to be filled. Together the checks prove that the tetrahedra fill the region
/// once and keep its boundary.

#include <cstdint>
#include <memory>
#include <vector>

#include "tetrafront/mesh.h"

namespace tetrafront {

/// Counts of what is wrong; all zero for a good mesh.
struct MeshDefects {
  std::uint64_t badNumbers = 0;  ///< not finite, or an index out of range; nothing else is judged
  std::uint64_t movedNodes = 0;  ///< surface nodes that are not where, or what, they were
  std::uint64_t coincidentNodes = 0;      ///< used nodes at the place of another
  std::uint64_t invertedTetrahedra = 0;   ///< volume not positive, exactly
  std::uint64_t duplicateTetrahedra = 0;  ///< with the nodes of another
  std::uint64_t nonManifoldFaces = 0;     ///< of more than two tetrahedra
  std::uint64_t overlappingFaces = 0;     ///< of two tetrahedra on the same side
  std::uint64_t extraBoundaryFaces = 0;   ///< of one tetrahedron, but not in the surface
  /// Of the surface: not boundary faces as they are turned, or walls without a tetrahedron on either
  /// side.
  std::uint64_t missingTriangles = 0;
  std::uint64_t wrongRegions = 0;  ///< tetrahedra that a face says are not where they are
  std::uint64_t wrongVolume = 0;   ///< 1 if the volumes below differ
  double meshVolume = 0.0;         ///< sum over the tetrahedra
  double surfaceVolume = 0.0;      ///< enclosed, by the divergence theorem, walls apart

  [[nodiscard]] std::uint64_t count() const;
};

/// The check in slices. O(n log k) for n tetrahedra with k at a node; about 0.3 µs each.
class MeshVerifier {
 public:
  /// `surface` is the oriented boundary whose nodes are the mesh's first. Both must outlive this.
  MeshVerifier(const VolumeMesh& mesh, const SurfaceMesh& surface);

  /// Works on for about `budget` tetrahedra; true when finished.
  bool advance(std::uint32_t budget);

  [[nodiscard]] double fraction() const;
  [[nodiscard]] const MeshDefects& defects() const { return defects_; }

 private:
  enum class Stage : std::uint8_t {
    kNumbers,
    kMarkNodes,
    kCountPlaces,
    kSortPlaces,
    kMatchPlaces,
    kTetrahedra,
    kCountFaces,
    kSortFaces,
    kMatchFaces,
    kDone
  };

  /// A face by its nodes, the lowest being known from the place in the array.
  struct Face {
    std::uint32_t middle;
    std::uint32_t highest;
    /// Tetrahedron, or their number plus that of a triangle, shifted left by one; the last bit tells
    /// the turn of the sorted nodes seen from outside.
    std::uint32_t ownerAndTurn;
  };

  void emptyBuckets();
  void layOutBuckets();
  void checkNumbers(std::size_t first, std::size_t last);
  void checkKept(std::size_t first, std::size_t last);
  void markNodes(std::size_t first, std::size_t last);
  template <class Use>
  void forEachPlace(std::size_t first, std::size_t last, Use use) const;
  void matchPlaces(std::size_t firstBucket, std::size_t lastBucket);
  void checkTetrahedra(std::size_t first, std::size_t last);
  void countFaces(std::size_t first, std::size_t last);
  void sortFaces(std::size_t first, std::size_t last);
  void matchFaces(std::size_t firstNode, std::size_t lastNode);
  void matchOne(const Face* first, const Face* last);
  void matchInnerRegions(const Face& one, const Face& other);
  void matchRegion(const Face& tetrahedron, const Face& triangle);
  [[nodiscard]] std::size_t triangleOf(const Face& face) const;
  void finish();
  [[nodiscard]] double volumeRounding() const;
  template <class Use>
  void forEachFace(std::size_t first, std::size_t last, Use use) const;
  [[nodiscard]] std::size_t elementCount() const;

  const VolumeMesh& mesh_;
  const SurfaceMesh& surface_;
  Stage stage_ = Stage::kNumbers;
  std::size_t next_ = 0;
  MeshDefects defects_;
  /// What is in bucket i begins at buckets_[i]: the used nodes whose places hash to i; later the
  /// faces whose lowest node is i.
  std::vector<std::uint32_t> buckets_;
  std::vector<std::uint32_t> filled_;
  std::vector<std::uint8_t> isUsed_;
  std::vector<std::uint32_t> places_;    ///< nodes, by bucket
  std::unique_ptr<Face[]> faces_;        ///< by bucket
  std::vector<std::uint32_t> suspects_;  ///< tetrahedra of faces that do not match
};

/// The whole check at once.
[[nodiscard]] MeshDefects verifyMesh(const VolumeMesh& mesh, const SurfaceMesh& surface);

}  // namespace tetrafront
