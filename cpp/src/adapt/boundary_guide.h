#pragma once

/// @file The boundary that an adaptation follows: the smooth patches, feature lines and corners of a reference surface.

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/adapt_mesh.h"
#include "adapt/true_boundary.h"
#include "remesh/reference_surface.h"

namespace tetrafront {

/// Smallest cosine between a triangle and the patch that it approximates: beyond, triangles tilt against a curved patch.
inline constexpr double kFacingCosine = 0.75;

class BoundaryGuide {
 public:
  /// `reference` must be prepared and outlive this. `isFixed`: per node of its mesh, 1 if it stays; or empty. `truth`: what the
  /// reference approximates; null if its triangles are the boundary.
  BoundaryGuide(const ReferenceSurface& reference, std::span<const std::uint8_t> isFixed,
                const TrueBoundary* truth = nullptr);

  /// Returns the place of a node of the reference mesh.
  [[nodiscard]] const Place& placeOf(NodeId node) const { return places_[node.index()]; }

  /// Number of nodes that stay.
  [[nodiscard]] std::size_t fixedCount() const { return patchBegins_.size() - 1; }

  [[nodiscard]] bool isOnPatch(const Place& place, SmoothPatchId patch) const;
  [[nodiscard]] bool isOnLine(const Place& place, FeatureLineId line) const;
  /// Returns the line of both places that bounds both patches, the one nearest to `middle` if there are several; none if
  /// there is none.
  [[nodiscard]] FeatureLineId commonLine(const Place& a, const Place& b, SmoothPatchId one,
                                         SmoothPatchId other, const Vec3& middle) const;

  /// Returns the place on the line between two others, at a part of the way; sets its position.
  [[nodiscard]] Place onLine(FeatureLineId id, const Place& a, const Place& b, double part,
                             Vec3& position) const;
  /// Returns the place of the patch nearest to a position, and moves the position there. `hint`: a place on the boundary.
  [[nodiscard]] Place onPatch(SmoothPatchId patch, const Place& hint, Vec3& position) const;
  /// Moves a place and a position to the nearest ones of its patch or line. Returns false if the node would leave it.
  [[nodiscard]] bool follow(Place& place, Vec3& position) const;

  /// Returns the cosine between the triangle, counter-clockwise as seen from outside, and its patch; 1 on a plane patch that it
  /// does not face away from. `hint`: a triangle of the patch near it, or none.
  [[nodiscard]] double cosineToPatch(const std::array<Vec3, 3>& corners, SmoothPatchId patch,
                                     TriangleId hint) const;
  /// Returns whether a triangle faces as its patch does.
  [[nodiscard]] bool isFacing(const std::array<Vec3, 3>& corners, SmoothPatchId patch,
                              TriangleId hint) const {
    return cosineToPatch(corners, patch, hint) >= kFacingCosine;
  }

  [[nodiscard]] const ReferenceSurface& reference() const { return reference_; }

  /// Largest distance between the boundary and the reference, nearly; 0 if the reference is the boundary.
  [[nodiscard]] double sag() const;

 private:
  void findFixed(std::span<const std::uint8_t> isFixed);
  void findLineNodes();
  void findNormals();
  [[nodiscard]] std::span<const std::uint32_t> patchesOf(std::uint32_t fixed) const {
    return std::span(fixedPatches_)
        .subspan(patchBegins_[fixed], patchBegins_[fixed + 1] - patchBegins_[fixed]);
  }
  /// Returns the position of a line, at an arc, that is nearest to a position.
  [[nodiscard]] Vec3 onTrueLine(FeatureLineId id, double arc, const Vec3& position) const;
  [[nodiscard]] double arcOn(FeatureLineId line, const Place& place, double near) const;
  [[nodiscard]] double nearestArc(const FeatureLine& line, const Vec3& position,
                                  double start) const;

  const ReferenceSurface& reference_;
  const TrueBoundary* truth_;
  std::vector<Place> places_;
  // Patches and lines of the fixed nodes.
  std::vector<std::uint32_t> patchBegins_;
  std::vector<std::uint32_t> fixedPatches_;
  struct LineEnd {
    std::uint32_t fixed;
    FeatureLineId line;
    double arc;
  };
  std::vector<LineEnd> lineEnds_;  ///< by fixed node and line
  std::vector<std::uint32_t> endBegins_;
  std::vector<Vec3> normals_;  ///< per corner of the reference triangles: mean over its patch
};

}  // namespace tetrafront
