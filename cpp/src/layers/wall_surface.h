#pragma once

/// @file The walls of a mesh that get layers: triangles in smooth groups, which are the pieces between sharp edges and the edges of
/// the walls, whatever patches they belong to. Finds the point of each group that is nearest to a position, and the normal and the
/// curvature of the wall there.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "geom/triangle_frame.h"
#include "metric/symmetric_tensor.h"
#include "search/box_tree.h"
#include "tetrafront/mesh.h"
#include "topology/edge_table.h"
#include "topology/node_lists.h"

namespace tetrafront {

/// Returns v v^T.
[[nodiscard]] inline SymmetricTensor squareOf(const Vec3& v) {
  return {v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z};
}

/// The point of a group of triangles that is nearest to a position.
struct WallPoint {
  TriangleId triangle{};
  double distance = 0.0;
  Vec3 position{0.0};
  Vec3 normal{0.0};  ///< unit normal out of the mesh, interpolated over the group
  /// Curvatures of the group along the wall: a tensor whose eigenvalue along a direction is positive if the wall bulges into the
  /// mesh there.
  SymmetricTensor curvature;
  bool isOnEdge = false;    ///< on an edge of the group, or on a corner
  bool isOnCorner = false;  ///< where the edge of the group turns; the rest is then not set
  Vec3 edge{0.0};           ///< unit direction of the edge
  Vec3 outward{0.0};        ///< unit vector along the wall, across the edge and away from the group
};

class WallSurface {
 public:
  /// `boundary` faces outward and must outlive this. `isWall`: one per triangle. O(n log n).
  WallSurface(const SurfaceMesh& boundary, std::span<const std::uint8_t> isWall);

  [[nodiscard]] std::size_t groupCount() const { return groups_.size(); }
  /// Finds the nearest point of a group; returns false if none is nearer than `limit`.
  [[nodiscard]] bool nearest(std::size_t group, const Vec3& position, double limit,
                             WallPoint& found) const;
  /// Returns whether the walls around a point that was found are nowhere nearer to the position: false above a wall that continues
  /// beyond an edge of the group.
  [[nodiscard]] bool isNearestAround(const WallPoint& found, const Vec3& position) const;

 private:
  struct Group {
    std::vector<TriangleId> triangles;
    BoxTree tree;  ///< over `triangles`
    Box box;
  };

  /// What the triangles of a group have at one of its nodes.
  struct GroupNode {
    Vec3 normal{0.0};
    SymmetricTensor curvature = SymmetricTensor::isotropic(0.0);
    double area = 0.0;
    Vec3 edge{0.0};
    Vec3 outward{0.0};
    bool isOnEdge = false;
    bool isOnCorner = false;

    void addEdge(const Vec3& along, const Vec3& beyond);
    void finish();
  };

  void findNormalsAndCurvatures(std::span<const TriangleId> members);
  [[nodiscard]] SymmetricTensor bendOf(TriangleId triangle) const;
  void describe(const std::array<double, 3>& weights, WallPoint& found) const;

  const SurfaceMesh& boundary_;
  std::vector<TriangleFrame> frames_;
  std::vector<Group> groups_;
  std::vector<Vec3> triangleNormals_;
  std::vector<TriangleId> neighbours_;  ///< per half-edge: across smooth edges between walls
  std::vector<GroupNode> nodes_;        ///< of all groups
  std::vector<std::uint32_t> nodeOf_;   ///< per corner of a triangle: index in nodes_
  NodeLists<TriangleId> wallsAt_;
};

}  // namespace tetrafront
