#pragma once

/// @file A triangulation of points in one plane that contains given edges. Points are inserted one by one into a first
/// triangle; edges are made by flips (Sloan 1993). Exact signs decide the topology; a test in doubles chooses the better of
/// two diagonals.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "arrangement/cut_points.h"

namespace tetrafront {

class PlanarTriangulation {
 public:
  /// Vertices are numbered in the order in which they are added.
  using Vertex = std::uint32_t;
  using Corners = std::array<Vertex, 3>;

  /// The first triangle has the vertices 0, 1 and 2, counter-clockwise in `view`.
  PlanarTriangulation(const CutPoints& points, const CutView& view,
                      const std::array<CutPointId, 3>& corners);

  /// Adds a point in the first triangle or on its boundary, other than the vertices. O(triangles), usually less.
  Vertex insert(CutPointId point);

  /// Makes the edge between two vertices, and keeps it. No vertex and no kept edge may cross it.
  void constrain(Vertex from, Vertex to);

  /// Flips edges that are not kept, for larger angles.
  void improve();

  [[nodiscard]] std::size_t triangleCount() const { return triangles_.size(); }
  [[nodiscard]] const Corners& cornersOf(std::size_t triangle) const {
    return triangles_[triangle].corners;
  }
  [[nodiscard]] CutPointId pointOf(Vertex vertex) const { return vertices_[vertex]; }

 private:
  static constexpr std::uint32_t kOutside = kNoIndex;

  struct Triangle {
    Corners corners;
    std::array<std::uint32_t, 3> beyond{kOutside, kOutside, kOutside};  ///< opposite each corner
    std::array<bool, 3> isKept{};
  };
  /// Edge of a triangle, opposite one of its corners.
  struct Side {
    std::uint32_t triangle;
    std::uint32_t corner;
  };

  [[nodiscard]] int orient(Vertex a, Vertex b, Vertex c) const {
    return points_.orient(view_, vertices_[a], vertices_[b], vertices_[c]);
  }
  [[nodiscard]] std::uint32_t cornerOf(std::uint32_t triangle, Vertex vertex) const;
  [[nodiscard]] Side opposite(const Side& side) const;
  [[nodiscard]] std::uint32_t locate(Vertex vertex) const;
  [[nodiscard]] std::uint32_t scan(Vertex vertex) const;
  void splitTriangle(std::uint32_t triangle, Vertex vertex);
  void splitSide(const Side& side, Vertex vertex);
  void divide(std::uint32_t triangle, std::uint32_t corner, Vertex vertex);
  void link(std::uint32_t triangle, std::uint32_t corner, std::uint32_t beyond);
  /// Returns the triangles around a vertex.
  void collectAround(Vertex vertex, std::vector<std::uint32_t>& around) const;
  [[nodiscard]] Side sideBetween(Vertex a, Vertex b) const;
  [[nodiscard]] bool isConvex(const Side& side) const;
  void flip(const Side& side);
  [[nodiscard]] bool isBetterFlipped(const Side& side) const;
  void keep(Vertex a, Vertex b);

  const CutPoints& points_;
  CutView view_;
  std::vector<CutPointId> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> triangleAt_;  ///< per vertex
  mutable std::uint32_t last_ = 0;         ///< where the next search begins
};

}  // namespace tetrafront
