#pragma once

/// @file The triangulation of one patch while it is made, in the patch's plane and in space at once.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "geom/predicates.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// A node of one patch's triangulation. NodeId is the same node in the whole surface.
using PlanarNodeId = Id<struct PlanarNodeTag>;
/// A triangle of one patch's triangulation.
using PlanarTriangleId = Id<struct PlanarTriangleTag>;
/// An infinite straight line of the plane that straight lines of the patch's boundary lie on.
using CarrierId = Id<struct CarrierTag>;

struct PlanarMesh {
  /// Three nodes, counter-clockwise in the plane.
  using Triangle = std::array<PlanarNodeId, 3>;
  /// The carriers of a node, at most two.
  using Carriers = std::array<CarrierId, 2>;
  /// A side of the boundary; the patch is on its left.
  struct Side {
    PlanarNodeId from;
    PlanarNodeId to;
  };

  std::vector<Vec2> plane;      ///< per node: position in the plane
  std::vector<Vec3> positions;  ///< per node: position in space
  std::vector<double> sizes;    ///< per node: target edge length in space
  /// Per node: nodes of one carrier count as collinear. Their coordinates are so only up to rounding.
  std::vector<Carriers> carriers;
  /// Per node: its index in the whole surface; none for interior nodes. If the first and the last line of
  /// a patch are the same line (a seam), the nodes of that line occur twice in the plane.
  std::vector<NodeId> surfaceNodes;
  /// Per boundary node: 1 if no interior edge may connect it to another node marked 1. May be empty: all 0.
  std::vector<std::uint8_t> separated;
  std::uint32_t boundaryCount = 0;  ///< nodes 0 .. boundaryCount-1 lie on the patch's lines
  std::vector<Side> sides;          ///< node i is an end of side i, except of those below
  /// Sides that have a node of another loop in place of their own, because the loops touch there.
  std::vector<std::uint32_t> touchingSides;
  std::vector<Triangle> triangles;

  /// Appends an interior node without triangles.
  PlanarNodeId addNode(const Vec2& inPlane, const Vec3& position, double size) {
    plane.push_back(inPlane);
    positions.push_back(position);
    sizes.push_back(size);
    carriers.emplace_back();
    surfaceNodes.emplace_back();
    return PlanarNodeId(plane.size() - 1);
  }

  /// Adds a carrier to a node that has at most one other.
  void addCarrier(std::size_t node, CarrierId carrier) {
    Carriers& known = carriers[node];
    if (known[0] == carrier || known[1] == carrier) return;
    known[known[0].isNone() ? 0 : 1] = carrier;
  }

  void removeLastNode() {
    plane.pop_back();
    positions.pop_back();
    sizes.pop_back();
    carriers.pop_back();
    surfaceNodes.pop_back();
  }

  [[nodiscard]] const Vec2& planeOf(PlanarNodeId node) const { return plane[node.index()]; }
  [[nodiscard]] const Vec3& positionOf(PlanarNodeId node) const { return positions[node.index()]; }
  [[nodiscard]] double sizeOf(PlanarNodeId node) const { return sizes[node.index()]; }
  [[nodiscard]] bool isBoundary(PlanarNodeId node) const { return node.value < boundaryCount; }

  /// True if the three nodes lie on one straight line of the boundary.
  [[nodiscard]] bool shareCarrier(PlanarNodeId a, PlanarNodeId b, PlanarNodeId c) const {
    for (const CarrierId carrier : carriers[a.index()])
      if (!carrier.isNone() && hasCarrier(b, carrier) && hasCarrier(c, carrier)) return true;
    return false;
  }

  /// Exact orientation of a b c: +1 counter-clockwise, 0 collinear or on one carrier, -1 clockwise.
  [[nodiscard]] int orientation(PlanarNodeId a, PlanarNodeId b, PlanarNodeId c) const {
    return shareCarrier(a, b, c) ? 0 : orient2d(planeOf(a), planeOf(b), planeOf(c));
  }

  /// True if a and b are the same node of the surface.
  [[nodiscard]] bool isSameNode(PlanarNodeId a, PlanarNodeId b) const {
    const NodeId node = surfaceNodes[a.index()];
    return a == b || (!node.isNone() && node == surfaceNodes[b.index()]);
  }

  /// True if an interior edge may connect a and b.
  [[nodiscard]] bool canConnect(PlanarNodeId a, PlanarNodeId b) const {
    return !isSameNode(a, b) && !(isSeparated(a) && isSeparated(b));
  }

  /// True if an edge between a and b is a chord: it connects two boundary nodes and is no side.
  [[nodiscard]] bool isChord(PlanarNodeId a, PlanarNodeId b) const {
    if (!isBoundary(a) || !isBoundary(b)) return false;
    const auto isEnd = [&](const Side& side, PlanarNodeId node) {
      return side.from == node || side.to == node;
    };
    // Node i is the first node of side i, or the second one in a reversed loop.
    if (isEnd(sides[a.index()], b) || isEnd(sides[b.index()], a)) return false;
    for (const std::uint32_t side : touchingSides)
      if (isEnd(sides[side], a) && isEnd(sides[side], b)) return false;
    return true;
  }

 private:
  [[nodiscard]] bool hasCarrier(PlanarNodeId node, CarrierId carrier) const {
    return carriers[node.index()][0] == carrier || carriers[node.index()][1] == carrier;
  }
  [[nodiscard]] bool isSeparated(PlanarNodeId node) const {
    return node.index() < separated.size() && separated[node.index()] != 0;
  }
};

/// True if node x, known to be collinear with a and b, lies between them or on one of them.
[[nodiscard]] inline bool isBetween(const PlanarMesh& mesh, PlanarNodeId a, PlanarNodeId b,
                                    PlanarNodeId x) {
  return glm::dot(mesh.planeOf(a) - mesh.planeOf(x), mesh.planeOf(b) - mesh.planeOf(x)) <= 0.0;
}

/// True if the closed segments ab and cd, which share no node, have a point in common. Exact.
[[nodiscard]] inline bool segmentsIntersect(const PlanarMesh& mesh, PlanarNodeId a, PlanarNodeId b,
                                            PlanarNodeId c, PlanarNodeId d) {
  const int abc = mesh.orientation(a, b, c);
  const int abd = mesh.orientation(a, b, d);
  if (abc == 0 && isBetween(mesh, a, b, c)) return true;
  if (abd == 0 && isBetween(mesh, a, b, d)) return true;
  if (abc * abd > 0 || (abc == 0 && abd == 0)) return false;
  const int cda = mesh.orientation(c, d, a);
  const int cdb = mesh.orientation(c, d, b);
  if (cda == 0 && isBetween(mesh, c, d, a)) return true;
  if (cdb == 0 && isBetween(mesh, c, d, b)) return true;
  return abc * abd < 0 && cda * cdb < 0;
}

/// True if the segments from the common node s to a and to b overlap. Exact.
[[nodiscard]] inline bool segmentsOverlap(const PlanarMesh& mesh, PlanarNodeId s, PlanarNodeId a,
                                          PlanarNodeId b) {
  return mesh.orientation(s, a, b) == 0 &&
         glm::dot(mesh.planeOf(a) - mesh.planeOf(s), mesh.planeOf(b) - mesh.planeOf(s)) > 0.0;
}

}  // namespace tetrafront
