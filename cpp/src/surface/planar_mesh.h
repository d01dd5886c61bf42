#pragma once

/// @file One patch's triangulation while it is made, in the plane and in space at once.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "geom/predicates.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct PlanarMesh {
  /// Up to two straight lines of the plane a node lies on; nodes of one such line are collinear
  /// by decree, as their coordinates are so only up to rounding.
  using Straights = std::array<std::uint32_t, 2>;

  std::vector<Vec2> plane;    ///< per node: place in the plane
  std::vector<Vec3> places;   ///< per node: place in space
  std::vector<double> sizes;  ///< per node: wanted edge length
  std::vector<Straights> straights;
  /// Per node: which node of the whole surface it is. A patch whose first and last line are one
  /// (a seam) shows some nodes twice in its plane. kNoIndex for interior nodes.
  std::vector<std::uint32_t> aliases;
  /// Per boundary node: 1 if no inner edge may join it to another such node. Empty: none are.
  std::vector<std::uint8_t> parted;
  std::uint32_t boundaryCount = 0;       ///< nodes 0 .. boundaryCount-1 lie on the patch's lines
  std::vector<std::uint32_t> sides;      ///< two nodes per boundary side, the patch on its left
  std::vector<std::uint32_t> triangles;  ///< three nodes each, counter-clockwise in the plane

  std::uint32_t addNode(const Vec2& at, const Vec3& place, double size) {
    plane.push_back(at);
    places.push_back(place);
    sizes.push_back(size);
    straights.push_back({kNoIndex, kNoIndex});
    aliases.push_back(kNoIndex);
    return static_cast<std::uint32_t>(plane.size() - 1);
  }

  void dropLastNode() {
    plane.pop_back();
    places.pop_back();
    sizes.pop_back();
    straights.pop_back();
    aliases.pop_back();
  }

  [[nodiscard]] bool onStraight(std::uint32_t node, std::uint32_t straight) const {
    return straights[node][0] == straight || straights[node][1] == straight;
  }

  /// True if the three nodes lie on one straight line of the boundary.
  [[nodiscard]] bool onOneStraight(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    for (const std::uint32_t straight : straights[a])
      if (straight != kNoIndex && onStraight(b, straight) && onStraight(c, straight)) return true;
    return false;
  }

  /// Exact turn a b c: +1 counter-clockwise, 0 collinear (also by decree), -1 clockwise.
  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return onOneStraight(a, b, c) ? 0 : orient2d(plane[a], plane[b], plane[c]);
  }

  /// True if the two are one node of the surface.
  [[nodiscard]] bool sameNode(std::uint32_t a, std::uint32_t b) const {
    return a == b || (aliases[a] != kNoIndex && aliases[a] == aliases[b]);
  }

  [[nodiscard]] bool isParted(std::uint32_t node) const {
    return node < parted.size() && parted[node] != 0;
  }

  /// True if an inner edge may join the two.
  [[nodiscard]] bool mayJoin(std::uint32_t a, std::uint32_t b) const {
    return !sameNode(a, b) && !(isParted(a) && isParted(b));
  }

  /// True if an edge between the two would join nodes of the boundary other than along it.
  [[nodiscard]] bool joinsLines(std::uint32_t a, std::uint32_t b) const {
    if (a >= boundaryCount || b >= boundaryCount) return false;
    const auto endsAt = [&](std::uint32_t side, std::uint32_t node) {
      return sides[2 * std::size_t{side}] == node || sides[2 * std::size_t{side} + 1] == node;
    };
    // Node i begins or, in a loop that was turned round, ends side i.
    return !endsAt(a, b) && !endsAt(b, a);
  }
};

/// True if node `x`, known to be collinear with a and b, lies between them or on one of them.
[[nodiscard]] inline bool between(const PlanarMesh& mesh, std::uint32_t a, std::uint32_t b,
                                  std::uint32_t x) {
  return glm::dot(mesh.plane[a] - mesh.plane[x], mesh.plane[b] - mesh.plane[x]) <= 0.0;
}

/// True if the closed segments ab and cd, which share no node, have a point in common. Exact.
[[nodiscard]] inline bool segmentsTouch(const PlanarMesh& mesh, std::uint32_t a, std::uint32_t b,
                                        std::uint32_t c, std::uint32_t d) {
  const int abc = mesh.turn(a, b, c);
  const int abd = mesh.turn(a, b, d);
  if (abc == 0 && between(mesh, a, b, c)) return true;
  if (abd == 0 && between(mesh, a, b, d)) return true;
  if (abc * abd > 0 || (abc == 0 && abd == 0)) return false;
  const int cda = mesh.turn(c, d, a);
  const int cdb = mesh.turn(c, d, b);
  if (cda == 0 && between(mesh, c, d, a)) return true;
  if (cdb == 0 && between(mesh, c, d, b)) return true;
  return abc * abd < 0 && cda * cdb < 0;
}

/// True if segments from the common node s to a and to b run over each other.
[[nodiscard]] inline bool segmentsOverlap(const PlanarMesh& mesh, std::uint32_t s, std::uint32_t a,
                                          std::uint32_t b) {
  return mesh.turn(s, a, b) == 0 &&
         glm::dot(mesh.plane[a] - mesh.plane[s], mesh.plane[b] - mesh.plane[s]) > 0.0;
}

/// Shape of a triangle in space: 4 sqrt(3) area / sum of squared edges, 1 equilateral, 0 flat.
[[nodiscard]] inline double triangleShape(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kTwoRootThree = 3.4641016151377544;
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const Vec3 ca = a - c;
  const double squares = glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca);
  return squares > 0.0 ? kTwoRootThree * glm::length(glm::cross(ab, ca)) / squares : 0.0;
}

/// What a triangle's shape costs where shapes are summed: 1 equilateral, without bound flat, so that
/// no gain elsewhere makes up for a bad triangle.
[[nodiscard]] inline double shapeCost(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kFlat = 1e-6;
  const double shape = std::max(triangleShape(a, b, c), kFlat);
  return 1.0 / (shape * shape);
}

/// Sine of a triangle's smallest angle, in space: twice the area over the two longest edges.
[[nodiscard]] inline double triangleSine(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const Vec3 ca = a - c;
  const double first = glm::dot(ab, ab);
  const double second = glm::dot(bc, bc);
  const double third = glm::dot(ca, ca);
  const double shortest = std::min({first, second, third});
  // The product of the two longest, without dividing by the shortest, which may vanish.
  const double product = shortest == first    ? second * third
                         : shortest == second ? first * third
                                              : first * second;
  return product > 0.0 ? glm::length(glm::cross(ab, ca)) / std::sqrt(product) : 0.0;
}

/// Cosine of the angle between the normals of the triangles a b c and b a d.
[[nodiscard]] inline double foldCosine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 first = glm::cross(b - a, c - a);
  const Vec3 second = glm::cross(d - a, b - a);
  const double product = glm::length(first) * glm::length(second);
  return product > 0.0 ? glm::dot(first, second) / product : 1.0;
}

}  // namespace tetrafront
