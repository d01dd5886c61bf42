#pragma once

/// @file Closed triangle surfaces for tests, oriented outward unless said otherwise. Only
/// `points` and `triangles` of the SurfaceMesh are filled.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront::testing {

/// How the squares of a grid are cut into triangles.
enum class Diagonals : std::uint8_t { kParallel, kAlternating, kUnionJack, kRandom };

/// Unit sphere: an icosahedron, each face divided n x n. 20 n^2 triangles of like size.
SurfaceMesh geodesicSphere(int n);

/// Geodesic sphere of about that many triangles.
SurfaceMesh sphereOfAbout(int triangles);

/// Unit sphere by latitude and longitude: needle triangles at the poles.
SurfaceMesh latitudeSphere(int rings, int sectors);

/// [0,1]^3 with n x n squares on each side: 12 n^2 triangles.
SurfaceMesh gridCube(int n, Diagonals diagonals = Diagonals::kParallel, std::uint64_t seed = 1);

/// An axis-parallel box with nx, ny, nz squares along its edges.
SurfaceMesh gridBox(const Vec3& lower, const Vec3& upper, std::array<int, 3> counts,
                    Diagonals diagonals = Diagonals::kParallel, std::uint64_t seed = 1);

SurfaceMesh torus(double majorRadius, double minorRadius, int majorCount, int minorCount);

/// gridCube(n) with the inner cube [0.25,0.75]^3 of m x m squares left out.
SurfaceMesh cubeWithCubicCavity(int n, int m);

/// gridCube(n) with a geodesic sphere of radius 0.3 about its centre left out.
SurfaceMesh cubeWithSphericalCavity(int n, int m);

/// Schönhardt's prism: the top triangle of a prism turned by `degrees` < 60, each side bent
/// inward along its diagonal. Cannot be filled without an interior node for any angle > 0.
SurfaceMesh schoenhardtPrism(double degrees);

/// A flat box of edge 1, n x n squares, and the given thickness in one layer.
SurfaceMesh thinPlate(int n, double thickness);

/// Two cubes of one square per side, joined at the nodes of one edge, or at one node.
SurfaceMesh cubesSharingEdge();
SurfaceMesh cubesSharingNode();

/// `depth` spheres of 20 n^2 triangles about one centre, alternately outward and inward: shell,
/// cavity, island, ...
SurfaceMesh nestedSpheres(int depth, int n);

/// [0, nx] x [0, ny] x [0, nz] cut into unit cubes, with the interfaces between them, of m x m squares per
/// side. Walls are there once, turned towards rising coordinates; the outside is turned outward.
SurfaceMesh dividedBox(std::array<int, 3> counts, int m);

/// A tetrahedron with the four given corners, oriented outward whatever their order.
SurfaceMesh tetrahedronSurface(const std::array<Vec3, 4>& corners);

// ---- changing a mesh -----------------------------------------------------------------------------

void translate(SurfaceMesh& mesh, const Vec3& by);
void scale(SurfaceMesh& mesh, double factor);
void stretch(SurfaceMesh& mesh, const Vec3& factors);

/// x becomes -x, triangles turned so that the surface stays outward.
void mirror(SurfaceMesh& mesh);

/// A rotation drawn uniformly from the seed.
void rotateRandomly(SurfaceMesh& mesh, std::uint64_t seed);

/// Turns every triangle round.
void turnInsideOut(SurfaceMesh& mesh);

/// Turns about half of the triangles round; which, the seed decides.
void flipRandomly(SurfaceMesh& mesh, std::uint64_t seed);

/// Renumbers nodes and triangles by random permutations, and rotates each triangle's start.
void shuffle(SurfaceMesh& mesh, std::uint64_t seed);

/// Appends the other mesh; its nodes get new numbers.
void append(SurfaceMesh& mesh, const SurfaceMesh& other);

// ---- reading one -----------------------------------------------------------------------------------

inline Vec3 pointOf(const SurfaceMesh& mesh, std::uint32_t node) {
  return {mesh.points[3 * std::size_t{node}], mesh.points[3 * std::size_t{node} + 1],
          mesh.points[3 * std::size_t{node} + 2]};
}
std::size_t nodeCount(const SurfaceMesh& mesh);
std::size_t triangleCount(const SurfaceMesh& mesh);

/// By the divergence theorem; positive for an outward surface without interfaces.
double enclosedVolume(const SurfaceMesh& mesh);

/// The same for each region of a surface that knows them.
std::vector<double> regionVolumes(const SurfaceMesh& mesh);

}  // namespace tetrafront::testing
