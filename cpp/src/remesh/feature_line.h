#pragma once

/// @file A feature line of a given surface: a chain of edges that the remesher keeps sharp.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

using FeatureLineId = Id<struct FeatureLineTag>;

/// A chain of feature edges that runs from corner to corner or is closed. A position on it is given
/// by its arc, which is the length of the line up to this position. On a closed line, an arc may
/// exceed the length of the line: it then continues at the first point.
class FeatureLine {
 public:
  /// Smooth pieces of the surface that meet at the line; indices of patches in the reference surface.
  std::vector<std::uint32_t> patches;
  /// Cosine of the smallest angle between the triangles at the line; 1 if the surface is flat at
  /// one of its edges.
  double creaseCosine = -1.0;

  /// `nodes`: nodes of the given surface along the line; if the line is closed, the first node is
  /// repeated at the end.
  FeatureLine(std::vector<NodeId> nodes, std::vector<Vec3> points, bool isClosed);

  [[nodiscard]] bool isClosed() const { return isClosed_; }
  [[nodiscard]] double length() const { return arcs_.back(); }
  [[nodiscard]] const std::vector<NodeId>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
  /// Arc of each point.
  [[nodiscard]] const std::vector<double>& arcs() const { return arcs_; }

  /// Returns the position at an arc. O(log n).
  [[nodiscard]] Vec3 at(double arc) const;

  /// Returns the centroid of the line between two arcs, relative to `origin`. A coordinate that is the same everywhere gives
  /// exactly zero.
  [[nodiscard]] Vec3 centroidFrom(const Vec3& origin, double from, double to) const;

  /// Returns the square of the largest distance from the line between two arcs to the segment a b. Exact up to
  /// rounding: the distance to a segment is convex, so it is largest at a point of the line or at an end.
  [[nodiscard]] double squaredDeviation(double from, double to, const Vec3& a, const Vec3& b) const;

 private:
  std::vector<NodeId> nodes_;
  std::vector<Vec3> points_;
  std::vector<double> arcs_;
  bool isClosed_;
};

/// Returns true if the lines bound the same smooth patch.
[[nodiscard]] bool sharePatch(const FeatureLine& a, const FeatureLine& b);

}  // namespace tetrafront
