#pragma once

/// @file The remeshed surface. All changes go through apply(), which makes a change only if afterwards
///   1. no triangle is degenerate, no two intersect (exact signs), and none was passed over (swept_volume.h);
///   2. triangles face in about the same direction as the reference surface beneath them;
///   3. every point of a triangle is within the tolerance of its patch (envelope.h);
///   4. every guest (guests.h) is within the tolerance of a triangle of its patch.
/// The operations of SurfaceEditor keep the number of triangles at each edge, and the feature lines.
/// For a planar patch, 3 and 4 follow from 2 and from its feature lines. For a facet of a curved patch, 3 follows from 2 if
/// the removed triangles lie over it: the added ones have the same boundary, so they cover no other part of its plane.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "geom/box.h"
#include "geom/intersect.h"
#include "remesh/guests.h"
#include "remesh/reference_surface.h"
#include "remesh/surface_complex.h"
#include "remesh/triangle_grid.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// A replacement of triangles by others; or a move of one node, with its triangles as removed and, in the same order, as
/// added ones.
struct SurfaceChange {
  struct Added {
    NodeTriple nodes;
    SmoothPatchId patch;
  };
  /// An edge of added triangles that will be on a feature line, but is not yet.
  struct LineEdge {
    NodeId a;
    NodeId b;
    FeatureLineId line;
  };
  std::vector<TriangleId> removed;
  std::vector<Added> added;
  std::vector<LineEdge> newLineEdges;
  NodeId moved{};
  Vec3 position{0.0};

  void clear() {
    removed.clear();
    added.clear();
    newLineEdges.clear();
    moved = NodeId{};
  }
};

struct SurfaceLimits {
  double tolerance = 0.0;  ///< largest distance from the reference surface
  double facingCosine =
      0.643;  ///< smallest cosine between the normals of a triangle and of the reference beneath it
};

class GuardedSurface {
 public:
  /// `reference` must outlive this. `baseSize`: typical extent of a triangle.
  GuardedSurface(const ReferenceSurface& reference, const SurfaceLimits& limits, double baseSize);

  [[nodiscard]] const SurfaceComplex& complex() const { return complex_; }
  [[nodiscard]] const ReferenceSurface& reference() const { return reference_; }
  [[nodiscard]] double tolerance() const { return limits_.tolerance; }

  /// Makes the change and returns true, or changes nothing and returns false. `coversSame`: the
  /// added triangles cover exactly the same points as the removed ones, each once, so they cannot intersect anything.
  bool apply(const SurfaceChange& change, bool coversSame = false);

  /// Adds a node without triangles, for the next change; removeLastNode() removes it again.
  NodeId addNode(const Vec3& point, NodeKind kind) { return complex_.addNode(point, kind); }
  void removeLastNode() { complex_.removeLastNode(); }
  /// A node inside a patch becomes one of a feature line.
  void putOnLine(NodeId node) { complex_.putOnLine(node); }

  // The caller sets the stretches of feature lines; apply() keeps those of edges that remain.
  void replaceStretch(NodeId a, NodeId b, const Stretch& stretch);
  void updateStretch(StretchId id, const Stretch& stretch) { complex_.stretch(id) = stretch; }
  void releaseStretch(StretchId id) { complex_.removeStretch(id); }

  /// The facet over which all the triangles are known to lie, or none.
  [[nodiscard]] PatchFacetId facetUnder(std::span<const TriangleId> triangles) const;

  /// A given triangle of the same patch; in a curved patch, one that was beneath or on the same facet when the triangle
  /// was made.
  [[nodiscard]] TriangleId beneath(TriangleId triangle) const { return beneath_[triangle.index()]; }

 private:
  void insert(TriangleId triangle);
  [[nodiscard]] Vec3 positionOf(NodeId node) const {
    return node == change_->moved ? change_->position : complex_.pointOf(node);
  }
  [[nodiscard]] bool isAdmitted(bool coversSame);
  void measureAdded();
  [[nodiscard]] bool faceFacet(PatchFacetId id);
  [[nodiscard]] bool isThickEnough() const;
  [[nodiscard]] bool facesAsReference();
  [[nodiscard]] bool keepsCreases();
  [[nodiscard]] FeatureLineId lineOf(NodeId a, NodeId b) const;
  [[nodiscard]] bool keepsCrease(NodeId a, NodeId b, FeatureLineId line);
  [[nodiscard]] bool isInOnePlane() const;
  [[nodiscard]] bool isFreeOfCollisions();
  [[nodiscard]] bool isCovered(const NumberedTriangle& added) const;
  [[nodiscard]] bool areCovering(const std::array<TriangleId, 2>& covering,
                                 const NumberedTriangle& added, int axis, double facing) const;
  [[nodiscard]] bool isStarRemoved(NodeId node) const;
  [[nodiscard]] bool isInEnvelope();
  [[nodiscard]] bool findHosts();
  [[nodiscard]] TriangleId hintFor(std::size_t added) const;
  void moveTriangles();
  void replaceTriangles();

  const ReferenceSurface& reference_;
  SurfaceLimits limits_;
  SurfaceComplex complex_;
  std::vector<TriangleId> beneath_;  ///< per triangle
  std::vector<PatchFacetId> over_;   ///< per triangle: the facet over which it lies, if known
  std::vector<Vec3> guests_;         ///< positions
  std::vector<GuestId>
      firstGuest_;  ///< per triangle: first of the guests that it must stay close to
  std::vector<GuestId> nextGuest_;  ///< per guest: the next one of the same triangle
  TriangleGrid grid_;

  // Scratch of apply(): data of the added triangles, in their order.
  const SurfaceChange* change_ = nullptr;
  std::vector<NumberedTriangle> numbered_;
  std::vector<NumberedTriangle> uncovered_;  ///< added triangles that may intersect others
  std::vector<NearestPoint> below_;  ///< of the centroid; in planar patches only the triangle
  std::vector<PatchFacetId> overNow_;
  std::vector<std::pair<GuestId, std::size_t>> hosts_;  ///< guest, index of the added triangle
  std::vector<Box> around_;
  std::vector<TriangleId> slots_;
  std::vector<StretchId> carried_;  ///< per half-edge
  std::vector<HalfEdgeId> edge_;
  std::vector<Vec3> creaseNow_;
  std::vector<Vec3> creaseThen_;
};

}  // namespace tetrafront
