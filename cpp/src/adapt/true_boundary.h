#pragma once

/// @file The faces and edges of a CAD model behind the patches and lines of a reference surface that approximates them: nodes of
/// an adapted mesh lie on these, and not on triangles and chords.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/task.h"
#include "placement/model_index.h"
#include "remesh/reference_surface.h"

namespace tetrafront {

class TrueBoundary {
 public:
  /// All must outlive this.
  TrueBoundary(const ReferenceSurface& reference, const ReadModel& model,
               const ModelTriangles& triangles);

  /// Finds the faces of the triangles of curved patches, and the edge of each segment of lines. O(n log n).
  Task<> prepare(Work& work);

  /// Returns the position on the faces of a curved patch that is nearest to `position`, or to its foot on a triangle of the patch if
  /// it is far from that; the foot itself if no face is near.
  [[nodiscard]] Vec3 onPatch(SmoothPatchId patch, TriangleId triangle, const Vec3& foot,
                             const Vec3& position) const;

  /// Returns the position on an edge of the model that is nearest to `position`, or to its foot on a segment of a line, from 0, if it
  /// is far from that; the foot itself if no edge is near.
  [[nodiscard]] Vec3 onLine(FeatureLineId id, std::size_t segment, const Vec3& foot,
                            const Vec3& position) const;

  /// Largest distance between the middle of a triangle or a segment and its face or edge.
  [[nodiscard]] double sag() const { return sag_; }

 private:
  void addFacesOf(TriangleId triangle, std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);
  void addSegment(const Vec3& from, const Vec3& to);
  [[nodiscard]] double reachOf(TriangleId triangle) const;

  const ReferenceSurface& reference_;
  ModelIndex index_;
  double sag_ = 0.0;
  std::vector<std::uint32_t> faceBegins_;  ///< per patch, into `faces_`
  std::vector<std::uint32_t> faces_;
  std::vector<std::uint32_t> segmentBegins_;  ///< per line, into `edges_`
  std::vector<std::uint32_t> edges_;          ///< per segment: an edge of the model, or none
};

}  // namespace tetrafront
