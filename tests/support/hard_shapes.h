#pragma once

/// @file Closed surfaces that are hard to fill: they cannot be filled without interior nodes, are
/// thin, touch themselves, or consist of needle triangles. Triangles face outward. Only `points`
/// and `triangles` are set.

#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront::testing {

/// A solid of Schönhardt's prisms stacked on each other; each is rotated by `degrees` relative to
/// the one below.
SurfaceMesh schoenhardtTower(int levels, double degrees);

/// A box with n x n cavities, each in the shape of Schönhardt's prism.
SurfaceMesh schoenhardtCavities(int n, double degrees);

/// Two Schönhardt prisms that share an upright edge; the second is the first one rotated by 180
/// degrees about this edge.
SurfaceMesh schoenhardtPair(double degrees);

/// Chazelle's polyhedron: n notches from below and, across them, n notches from above. The edges of
/// the notches lie on z = x y and slightly above it, so only `gap` is left between them.
SurfaceMesh chazellePolyhedron(int n, double gap);

/// The volume between two graphs of z = x y that are `gap` apart; their squares are cut along
/// opposite diagonals.
SurfaceMesh saddleSlab(int n, double gap);

/// A prism over a counter-clockwise polygon, of this `height`. Its sides have `layers` layers of
/// squares, cut along random diagonals.
SurfaceMesh extruded(const std::vector<Vec2>& polygon, double height, int layers,
                     std::uint64_t seed);

/// A wedge with this angle, and a block with a slit of this angle.
SurfaceMesh wedge(double degrees, int layers);
SurfaceMesh slitBlock(double degrees, int layers);

/// A geodesic sphere with every node moved to a random distance between `least` and 1.
SurfaceMesh spikySphere(int n, double least, std::uint64_t seed);

/// A round bar with flat ends, triangulated as CAD systems do it: needles along the bar, and on
/// each end a fan from one node.
SurfaceMesh coarseBar(int sectors, double length);

/// A tube, triangulated in the same way.
SurfaceMesh coarseTube(int sectors, double innerRadius, double length);

/// A solid of revolution about the z axis. Each entry is the radius and the height of a ring of
/// nodes, from bottom to top. The squares between rings are cut along random diagonals, and a fan
/// closes each end. The two triangles of a square are coplanar up to rounding.
SurfaceMesh solidOfRevolution(const std::vector<Vec2>& radiusAndHeight, int sectors,
                              std::uint64_t seed);

/// A regular polygon of radius 1, connected by needles to one of radius `ratio` above it.
SurfaceMesh loft(int cornersBelow, int cornersAbove, double height, double ratio);

/// The outline of a comb, counter-clockwise: long teeth with narrow gaps.
std::vector<Vec2> combOutline(int teeth, double width, double gap, double length);

/// A cube with n x n squares in the middle of its top; each other side has two triangles.
SurfaceMesh cubeWithFinePatch(int n);

/// gridCube(n) with all coordinates raised to the power `power`: the sizes of its squares and
/// needles span several decades.
SurfaceMesh gradedCube(int n, int power);

/// The surface of randomly chosen cubes of a grid of n^3 unit cubes. Cubes may touch in an edge or
/// a node only.
SurfaceMesh randomBlocks(int n, double share, std::uint64_t seed);

/// Such blocks, with coordinate k moved to 2^(step (k - n)): their sizes differ by many powers of
/// two.
SurfaceMesh distantBlocks(int n, int step, std::uint64_t seed);

/// A pocket that a front left in a rotated, ear-clipped plate with holes. Nearly all its nodes are
/// coplanar up to rounding, so doubles may be unable to hold any position inside it.
SurfaceMesh flatPocket();

/// An upright drum of `count` needle strips, whose caps are fans of needles around their centres. `lobes`: number of waves of its
/// outline, in which it is concave; 0 for a round one.
SurfaceMesh needleDrum(std::uint32_t count, int lobes);

/// A plate with n x n round holes, each a polygon with an even number of `sides`. Ear clipping that
/// always takes the first ear cuts its flat faces into needles.
SurfaceMesh needlePlate(int n, int sides, double thickness);

/// A gear with this number of teeth; its flat faces are cut into needles in the same way.
SurfaceMesh needleGear(int teeth, double thickness);

/// A screw thread with `around` nodes per turn and long triangles along its flanks.
SurfaceMesh screwThread(int turns, int around);

/// A thin twisted blade with two sharp edges: 2 * `across` nodes around each of `along` + 1 sections.
SurfaceMesh twistedBlade(int along, int across, double thickness);

/// A sheet bent by about 180 degrees. Each of its strips is as long as the sheet is wide.
SurfaceMesh bentSheet(int strips, double thickness);

/// A block with a cavity, and another block in the cavity.
SurfaceMesh blockWithIsland(int n);

/// A tube around a torus knot that winds p times around the torus one way and q times the other.
SurfaceMesh torusKnot(int p, int q, int count, int sectors);

}  // namespace tetrafront::testing
