#pragma once

/// @file Closed surfaces that are hard to fill: without interior nodes impossible, thin, pinched, or
/// of needle triangles. Outward; only `points` and `triangles` are filled.

#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront::testing {

/// Schönhardt's prisms on top of each other, each rotated further by `degrees`; one solid.
SurfaceMesh schoenhardtTower(int levels, double degrees);

/// A box with n x n cavities of that shape.
SurfaceMesh schoenhardtCavities(int n, double degrees);

/// Two of them, one turned half round about an upright edge, which they share.
SurfaceMesh schoenhardtPair(double degrees);

/// Chazelle's polyhedron: n notches from below and n from above, across each other, that leave only
/// `gap` between their edges, which lie on z = x y and a little above.
SurfaceMesh chazellePolyhedron(int n, double gap);

/// The space between two graphs of z = x y, `gap` apart, with opposite diagonals.
SurfaceMesh saddleSlab(int n, double gap);

/// The polygon, counter-clockwise in the plane, drawn up to `height` in so many layers, with random
/// diagonals.
SurfaceMesh extruded(const std::vector<Vec2>& polygon, double height, int layers,
                     std::uint64_t seed);

/// A wedge of that angle, and a block with a slit of that angle.
SurfaceMesh wedge(double degrees, int layers);
SurfaceMesh slitBlock(double degrees, int layers);

/// A geodesic sphere with every node moved to a random distance between `least` and 1.
SurfaceMesh spikySphere(int n, double least, std::uint64_t seed);

/// A round bar with flat ends, cut into triangles as CAD systems do: needles along the wall, a fan
/// from one node on the ends.
SurfaceMesh coarseBar(int sectors, double length);

/// A tube, likewise.
SurfaceMesh coarseTube(int sectors, double innerRadius, double length);

/// A solid of revolution about the z axis, from points of radius and height upwards: rings of nodes with random
/// diagonals between them, closed by a fan at both ends. Neighbouring triangles are in one plane but for
/// rounding.
SurfaceMesh solidOfRevolution(const std::vector<Vec2>& radiusAndHeight, int sectors,
                              std::uint64_t seed);

/// A regular polygon of radius 1 joined by needles to one of radius `ratio` above it.
SurfaceMesh loft(int cornersBelow, int cornersAbove, double height, double ratio);

/// The outline of a comb, counter-clockwise: long teeth with narrow gaps.
std::vector<Vec2> combOutline(int teeth, double width, double gap, double length);

/// A cube whose top has n x n squares in its middle and the other sides two triangles each.
SurfaceMesh cubeWithFinePatch(int n);

/// gridCube(n) with all coordinates raised to that power: squares and needles over several decades.
SurfaceMesh gradedCube(int n, int power);

/// A random choice of the n^3 unit cubes, as one surface; they meet in edges and nodes too.
SurfaceMesh randomBlocks(int n, double share, std::uint64_t seed);

/// Such blocks with the coordinate k at 2^(step (k - n)): sizes many powers of two apart.
SurfaceMesh distantBlocks(int n, int step, std::uint64_t seed);

/// What a front left of an ear-clipped plate with holes, turned in space: nearly all its nodes are in one
/// plane but for rounding, so that a point within may have no position in doubles.
SurfaceMesh flatPocket();

/// A plate with n x n round holes of so many sides each (even), drawn up; its flat faces are cut into needles
/// by taking the first ear there is, again and again.
SurfaceMesh needlePlate(int n, int sides, double thickness);

/// A gear of so many teeth, its flat faces cut likewise.
SurfaceMesh needleGear(int teeth, double thickness);

/// A screw thread of so many turns with so many nodes around; long triangles along the flanks.
SurfaceMesh screwThread(int turns, int around);

/// A thin twisted blade with two sharp edges: 2 * `across` nodes around each of `along` + 1 sections.
SurfaceMesh twistedBlade(int along, int across, double thickness);

/// A sheet bent round about half a turn, in so many strips as long as it is wide.
SurfaceMesh bentSheet(int strips, double thickness);

/// A block with a cavity, and a block in that.
SurfaceMesh blockWithIsland(int n);

/// A tube around a torus knot that winds p times one way and q times the other.
SurfaceMesh torusKnot(int p, int q, int count, int sectors);

}  // namespace tetrafront::testing
