#pragma once

/// @file The exact arrangement of the triangles of a surface: the triangles cut along their intersections, so that the
/// parts have only corners and edges in common. Parts of several triangles that coincide are one part.
///
/// The intersections of all pairs are computed first (triangle_cuts.h). Then each triangle, or set of triangles that overlap in one
/// plane, is triangulated with its cuts as edges (cut_graph.h, planar_triangulation.h). All points are exact (cut_points.h;
/// compare the indirect predicates of Attene 2020).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/cut_points.h"
#include "base/ids.h"
#include "base/task.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// A given triangle that a part belongs to.
struct PartOwner {
  TriangleId triangle;
  bool isReversed = false;  ///< whether the part has the opposite orientation
};

class Arrangement {
 public:
  /// `mesh` must outlive this object. It must have no degenerate triangles, and no two used nodes at one position.
  explicit Arrangement(const SurfaceMesh& mesh) : mesh_(mesh), points_(mesh) {}

  /// Computes the parts. O(n log n) for n triangles that have few others near them, if few intersect. Returns false if there
  /// are more than `maxPairs` pairs of intersecting triangles or too many points; the parts are then incomplete.
  Task<bool> run(Work& work, std::size_t maxPairs);

  [[nodiscard]] const CutPoints& points() const { return points_; }
  /// Returns the points of each part, three per part: those of uncut triangles first.
  [[nodiscard]] std::span<const std::uint32_t> parts() const { return parts_; }
  [[nodiscard]] std::uint32_t partCount() const {
    return static_cast<std::uint32_t>(parts_.size() / 3);
  }
  /// Returns the triangles that a part belongs to; the part has the orientation of the first.
  [[nodiscard]] std::span<const PartOwner> ownersOf(std::uint32_t part) const {
    return std::span(owners_).subspan(begins_[part], begins_[part + 1] - begins_[part]);
  }
  /// Returns whether a triangle is cut, or overlaps another one in its plane.
  [[nodiscard]] bool isCut(TriangleId triangle) const { return isCut_[triangle.index()] != 0; }
  /// Number of pairs of intersecting triangles.
  [[nodiscard]] std::size_t pairCount() const { return pairCount_; }
  /// A triangle that intersects another one; none if there is no such pair.
  [[nodiscard]] TriangleId firstOfPair() const { return firstOfPair_; }

 private:
  void addPart(const std::array<CutPointId, 3>& points);
  void addUncut();

  const SurfaceMesh& mesh_;
  CutPoints points_;
  std::vector<std::uint32_t> parts_;
  std::vector<PartOwner> owners_;
  std::vector<std::uint32_t> begins_{0};  ///< per part and one more: index in owners_
  std::vector<std::uint8_t> isCut_;       ///< per triangle
  std::size_t pairCount_ = 0;
  TriangleId firstOfPair_;
};

}  // namespace tetrafront
