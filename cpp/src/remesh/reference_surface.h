#pragma once

/// @file The given surface in the form that the remesher needs: divided into smooth patches by
/// feature lines, with a search tree. It never changes; every distance is measured to it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "geom/coordinates.h"
#include "geom/triangle_frame.h"
#include "remesh/feature_line.h"
#include "search/box_tree.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/edge_table.h"
#include "topology/mesh_access.h"

namespace tetrafront {

using SmoothPatchId = Id<struct SmoothPatchTag>;
using PatchFacetId = Id<struct PatchFacetTag>;

/// Angles from which on the surface counts as sharp.
struct FeatureRules {
  double creaseCosine =
      0.766;  ///< cosine of the smallest angle between triangles at a feature edge
  double cornerCosine =
      0.643;  ///< cosine of the smallest angle by which a feature line turns at a corner
};

/// The point of a patch nearest to a position, and the triangle that contains it.
struct NearestPoint {
  TriangleId triangle{};  ///< none if nothing is near enough
  double squaredDistance = 0.0;
  Vec3 position{0.0};
};

/// The triangles of a smooth part of the surface: connected, and bounded by feature lines.
struct SmoothPatch {
  bool isPlanar = false;
  Vec3 normal{0.0};         ///< unit normal; the mean normal if the patch is not planar
  std::uint32_t group = 0;  ///< given patch of its triangles
};

/// Connected coplanar triangles of a curved patch, for example one strip of a fillet.
struct Facet {
  Vec3 normal{0.0};       ///< unit normal
  Vec3 origin{0.0};       ///< a point of the plane
  double flatness = 0.0;  ///< largest distance of a corner from the plane
  double area = 0.0;
  std::uint32_t firstEdge = 0;
  std::uint32_t edgeCount = 0;
  std::uint32_t tree = 0;  ///< index of the tree of its edges, if they are many

  [[nodiscard]] Vec3 projected(const Vec3& position) const {
    return position - normal * glm::dot(position - origin, normal);
  }
};

class ReferenceSurface {
 public:
  /// `mesh`: a valid boundary, which must outlive this; its trianglePatch may be empty. `centre`: the nodes are relative to it.
  ReferenceSurface(const SurfaceMesh& mesh, const FeatureRules& rules,
                   const Vec3& centre = Vec3(0.0));

  /// Returns another surface in the same coordinates by the same rules, not yet prepared. `mesh` must outlive it.
  [[nodiscard]] ReferenceSurface of(const SurfaceMesh& mesh) const {
    return {mesh, rules_, centre_};
  }

  /// Finds features and patches, and builds the search tree. O(n log n).
  Task<> prepare(Work& work);

  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }
  [[nodiscard]] const FeatureRules& rules() const { return rules_; }
  /// Returns the position nearest to the given one that a node can have: in the user's coordinates it must be exact, too.
  [[nodiscard]] Vec3 representable(const Vec3& position) const {
    return centre_ == Vec3(0.0) ? inExactRange(position) : exactAbout(centre_, position);
  }
  [[nodiscard]] double diagonal() const { return diagonal_; }
  [[nodiscard]] const std::vector<FeatureLine>& lines() const { return lines_; }
  [[nodiscard]] const FeatureLine& line(FeatureLineId id) const { return lines_[id.index()]; }
  [[nodiscard]] std::size_t patchCount() const { return patches_.size(); }
  [[nodiscard]] const SmoothPatch& patch(SmoothPatchId id) const { return patches_[id.index()]; }
  [[nodiscard]] SmoothPatchId patchOf(TriangleId triangle) const {
    return patchOf_[triangle.index()];
  }
  /// Unit normal; that of a neighbour if the triangle is flatter than the rounding of its corners.
  [[nodiscard]] const Vec3& normalOf(TriangleId triangle) const {
    return normals_[triangle.index()];
  }
  /// True if the remesher must keep the node: a feature line ends or turns there, the node is the
  /// tip of a cone, or the surface touches itself.
  [[nodiscard]] bool isCorner(NodeId node) const { return isCorner_[node.index()] != 0; }
  /// The neighbour across a half-edge, in the same patch; none at a feature line.
  [[nodiscard]] TriangleId smoothNeighbour(HalfEdgeId halfEdge) const {
    return neighbours_[halfEdge.index()];
  }
  /// The facet of a triangle; none in planar patches.
  [[nodiscard]] PatchFacetId facetOf(TriangleId triangle) const {
    return facetOf_[triangle.index()];
  }
  [[nodiscard]] const Facet& facet(PatchFacetId id) const { return facets_[id.index()]; }
  /// Calls visit(from, to) for the boundary edges of a facet that may touch a box, with the facet
  /// on their left. Stops and returns false when `visit` returns false.
  template <class Visit>
  bool visitFacetEdges(const Facet& facet, const Box& box, Visit visit) const;

  /// Returns the nearest point of the patch within `limit`. `hint`: a triangle of the patch that
  /// may be near, or none. The walk from the hint may end at a local minimum, which is returned if
  /// it is within the limit; the walk thus stays on its side of a thin part.
  [[nodiscard]] NearestPoint nearest(const Vec3& position, SmoothPatchId patch, double limit,
                                     TriangleId hint) const;

  [[nodiscard]] double squaredDistance(const Vec3& position, TriangleId triangle) const {
    return frames_[triangle.index()].squaredDistance(position);
  }

  /// A part of a given triangle, no longer than a fraction of the diagonal: boxes around whole needles would overlap.
  struct Piece {
    TriangleId triangle{};
    Vec3 centroid{0.0};
    double area = 0.0;
  };
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// Boxes of the pieces.
  [[nodiscard]] const BoxTree& tree() const { return tree_; }

 private:
  struct Arm {
    NodeId to;
    EdgeId edge;
  };

  void findPatches();
  void findFacets();
  void growFacet(TriangleId seed, std::vector<TriangleId>& members);
  [[nodiscard]] SmoothPatch describePatch(std::span<const TriangleId> members) const;
  void findCorners(const EdgeTable& edges);
  void findApexes();
  [[nodiscard]] std::vector<std::uint32_t> countSectors() const;
  void traceLines(const EdgeTable& edges);
  void traceLine(NodeId from, const Arm& first, const EdgeTable& edges);
  [[nodiscard]] std::span<const Arm> armsOf(NodeId node) const {
    const std::uint32_t begin = armBegins_[node.index()];
    return std::span(arms_).subspan(begin, armBegins_[node.index() + 1] - begin);
  }
  Task<bool> divideAll(Work& work, std::vector<Box>& boxes);
  void divide(TriangleId triangle, const std::array<Vec3, 3>& corners, int depth,
              std::vector<Box>& boxes);
  [[nodiscard]] NearestPoint walk(const Vec3& position, TriangleId from) const;
  /// Distance from a plane within which triangles are in it: rounding of files.
  [[nodiscard]] double planarTolerance() const;

  const SurfaceMesh& mesh_;
  FeatureRules rules_;
  Vec3 centre_;
  double diagonal_ = 0.0;
  double largestCoordinate_ = 0.0;
  std::vector<TriangleFrame> frames_;
  std::vector<Vec3> normals_;
  std::vector<TriangleId> neighbours_;       ///< per half-edge
  std::vector<std::uint8_t> isFeatureEdge_;  ///< per edge of the table
  std::vector<SmoothPatchId> patchOf_;
  std::vector<SmoothPatch> patches_;
  std::vector<std::uint8_t> isCorner_;
  std::vector<Arm> arms_;  ///< feature edges at each node
  std::vector<std::uint32_t> armBegins_;
  std::vector<std::uint8_t> isTraced_;  ///< per edge of the table
  std::vector<FeatureLine> lines_;
  double pieceLength_ = 0.0;  ///< longest piece of a triangle
  std::vector<Piece> pieces_;
  BoxTree tree_;

  /// Facets with more edges than this have a tree of them.
  static constexpr std::uint32_t kFewEdges = 8;
  std::vector<Facet> facets_;
  std::vector<PatchFacetId> facetOf_;  ///< per triangle; none in planar patches
  std::vector<HalfEdgeId> facetEdges_;
  std::vector<BoxTree> facetTrees_;  ///< over the edges of a facet, numbered from its first one
};

template <class Visit>
bool ReferenceSurface::visitFacetEdges(const Facet& facet, const Box& box, Visit visit) const {
  const auto visitEdge = [&](std::uint32_t i) {
    const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, facetEdges_[i]);
    return visit(pointOf(mesh_, nodes.from), pointOf(mesh_, nodes.to));
  };
  bool goesOn = true;
  const auto visitNext = [&](std::uint32_t i) { return goesOn = visitEdge(facet.firstEdge + i); };
  if (facet.edgeCount > kFewEdges) {
    facetTrees_[facet.tree].visitOverlaps(box, visitNext);
  } else {
    for (std::uint32_t i = 0; i < facet.edgeCount && goesOn; ++i) visitNext(i);
  }
  return goesOn;
}

}  // namespace tetrafront
