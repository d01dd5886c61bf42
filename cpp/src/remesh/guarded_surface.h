#pragma once

/// @file The remeshed surface, and the one door through which it changes. apply() makes a change only if afterwards
///   1. no triangle is degenerate, and no two intersect (exact signs);
///   2. triangles face as the reference surface does beneath them;
///   3. triangles are within the tolerance of their patch, everywhere (envelope.h);
///   4. every given node inside a curved patch is within the tolerance of a triangle of the patch.
/// The operations of SurfaceEditor see to the rest: the number of triangles at edges, and feature lines. On a planar
/// patch 3 and 4 follow from 2 and from its feature lines.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "geom/box.h"
#include "geom/intersect.h"
#include "remesh/reference_surface.h"
#include "remesh/surface_complex.h"
#include "search/face_grid.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Triangles that are replaced by others. One node may move with it.
struct SurfaceChange {
  struct Added {
    NodeTriple nodes;
    SmoothPatchId patch;
  };
  std::vector<TriangleId> removed;
  std::vector<Added> added;
  NodeId moved{};
  Vec3 position{0.0};

  void clear() {
    removed.clear();
    added.clear();
    moved = NodeId{};
  }
};

struct SurfaceLimits {
  double tolerance = 0.0;       ///< largest distance from the reference surface
  double facingCosine = 0.643;  ///< least cosine between a triangle and the reference beneath it
};

class GuardedSurface {
 public:
  /// `reference` must outlive this. `baseSize`: typical extent of a triangle.
  GuardedSurface(const ReferenceSurface& reference, const SurfaceLimits& limits, double baseSize);

  [[nodiscard]] const SurfaceComplex& complex() const { return complex_; }
  [[nodiscard]] const ReferenceSurface& reference() const { return reference_; }
  [[nodiscard]] double tolerance() const { return limits_.tolerance; }

  /// Makes the change and returns true, or leaves everything as it is. `coversSame`: the added triangles cover exactly
  /// the points that the removed ones cover, so they can only intersect each other.
  bool apply(const SurfaceChange& change, bool coversSame = false);

  /// A node without triangles, for the next change; removeLastNode() takes it back.
  NodeId addNode(const Vec3& point, NodeKind kind) { return complex_.addNode(point, kind); }
  void removeLastNode() { complex_.removeLastNode(); }

  // Stretches of feature lines are the caller's: apply() carries those of edges that remain.
  void replaceStretch(NodeId a, NodeId b, const Stretch& stretch);
  void updateStretch(StretchId id, const Stretch& stretch) { complex_.stretch(id) = stretch; }
  void releaseStretch(StretchId id) { complex_.removeStretch(id); }

  /// The given triangle beneath a triangle of a curved patch, at the time it was made.
  [[nodiscard]] TriangleId beneath(TriangleId triangle) const { return beneath_[triangle.index()]; }
  /// A given triangle of the same patch, near the triangle.
  [[nodiscard]] TriangleId origin(TriangleId triangle) const;

 private:
  void insert(TriangleId triangle);
  [[nodiscard]] Vec3 positionOf(NodeId node) const {
    return node == change_->moved ? change_->position : complex_.pointOf(node);
  }
  [[nodiscard]] bool isAdmitted(bool coversSame);
  void measureAdded();
  [[nodiscard]] bool facesAsReference();
  [[nodiscard]] bool intersects(bool coversSame);
  [[nodiscard]] bool intersectsOthers();
  [[nodiscard]] bool isInEnvelope() const;
  [[nodiscard]] bool findHosts();
  [[nodiscard]] TriangleId hintFor(std::size_t added) const;
  void replaceTriangles();

  const ReferenceSurface& reference_;
  SurfaceLimits limits_;
  SurfaceComplex complex_;
  std::vector<TriangleId> beneath_;  ///< per triangle
  std::vector<NodeId> firstGuest_;   ///< per triangle: first of the given nodes that it answers for
  std::vector<NodeId> nextGuest_;    ///< per given node
  FaceGrid grid_;
  std::vector<Box> boxes_;  ///< per triangle
  std::vector<std::uint8_t> isRemoved_;

  // What is known of the added triangles, in their order, while a change is examined.
  const SurfaceChange* change_ = nullptr;
  std::vector<NumberedTriangle> numbered_;
  std::vector<Box> addedBoxes_;
  std::vector<TriangleId> addedBeneath_;
  std::vector<std::pair<NodeId, std::size_t>> hosts_;  ///< guest, index of the added triangle
  std::vector<StretchId> carried_;                     ///< per half-edge
  std::vector<std::uint32_t> found_;
};

}  // namespace tetrafront
