#pragma once

/// @file Points of an arrangement of triangles: the nodes of a surface, and the points where its triangles intersect. The
/// latter have exact homogeneous coordinates, x / w, y / w, z / w with dyadic numbers. Their rounded positions decide most
/// signs; exact arithmetic decides the others. Points at one position are one point.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "base/ids.h"
#include "geom/dyadic.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Point of an arrangement. The first ones are the nodes of the surface.
using CutPointId = Id<struct CutPointTag>;

/// Plane through three nodes, or parallel to an axis through two.
struct CutPlane {
  std::array<NodeId, 3> nodes;     ///< the third is none if the plane is parallel to an axis
  std::uint32_t parallelAxis = 0;  ///< 0, 1 or 2
};

/// A plane in which points are seen along one axis, so that the axes `u` and `v` have the orientation of the plane.
struct CutView {
  std::uint32_t u;
  std::uint32_t v;
};

class CutPoints {
 public:
  /// `mesh` must outlive this object. No two used nodes may have equal positions.
  explicit CutPoints(const SurfaceMesh& mesh);

  [[nodiscard]] std::size_t size() const { return nodeCount_ + made_.size(); }
  /// Returns whether there are so many points of intersections that the arrangement would take minutes.
  [[nodiscard]] bool isFull() const { return exact_.size() > kMaxExactPoints; }
  [[nodiscard]] bool isNode(CutPointId point) const { return point.value < nodeCount_; }

  /// Returns the point where the line through two nodes crosses the plane of three others. They must cross in one point.
  CutPointId addOnLine(NodeId from, NodeId to, const NodeTriple& triangle);
  /// Returns the point that is common to three planes. They must have exactly one.
  CutPointId addOnPlanes(const CutPlane& a, const CutPlane& b, const CutPlane& c);
  /// Adds a position that is not compared with others.
  CutPointId addHelper(const Vec3& position);

  /// Returns the double nearest to each coordinate.
  [[nodiscard]] Vec3 rounded(CutPointId point) const {
    return isNode(point) ? nodeAt(NodeId(point.value)) : made_[point.index() - nodeCount_].position;
  }

  /// Returns the side of the plane a b c on which the point lies, as orient3d() does.
  [[nodiscard]] int sideOf(const NodeTriple& triangle, CutPointId point) const;
  /// Returns the orientation of three points in a view, as orient2d() does.
  [[nodiscard]] int orient(const CutView& view, CutPointId a, CutPointId b, CutPointId c) const;
  /// Returns the sign of a - b along an axis.
  [[nodiscard]] int compare(std::uint32_t axis, CutPointId a, CutPointId b) const;

 private:
  struct Homogeneous {
    DyadicVec3 numerator;
    Dyadic denominator;  ///< above 0
  };
  struct Made {
    Vec3 position;                   ///< rounded
    std::uint32_t exact = kNoIndex;  ///< index in exact_; none if the position is exact
  };
  using Key = std::array<double, 3>;

  static constexpr std::size_t kMaxExactPoints = 400'000;

  [[nodiscard]] Vec3 nodeAt(NodeId node) const {
    const std::size_t i = 3 * node.index();
    return {mesh_.points[i], mesh_.points[i + 1], mesh_.points[i + 2]};
  }
  [[nodiscard]] bool isExact(CutPointId point) const {
    return isNode(point) || made_[point.index() - nodeCount_].exact == kNoIndex;
  }
  [[nodiscard]] Homogeneous exact(CutPointId point) const;
  [[nodiscard]] CutPointId add(Homogeneous position);
  [[nodiscard]] NodeId nodeAtPosition(const Key& position) const;

  const SurfaceMesh& mesh_;
  std::uint32_t nodeCount_;
  std::vector<NodeId> sortedNodes_;  ///< used nodes by position
  std::vector<Made> made_;
  std::vector<Homogeneous> exact_;
  std::map<Key, std::vector<CutPointId>> byPosition_;  ///< made points by rounded position
};

/// Returns the axes along which a triangle that is not degenerate is seen counter-clockwise, without its longest axis.
[[nodiscard]] CutView viewOf(const SurfaceMesh& mesh, const NodeTriple& triangle);

}  // namespace tetrafront
