#pragma once

/// @file Closed triangle surfaces for tests, oriented outward unless stated otherwise. Only
/// `points` and `triangles` of the SurfaceMesh are set.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront::testing {

/// How the squares of a grid are cut into triangles.
enum class Diagonals : std::uint8_t { kParallel, kAlternating, kUnionJack, kRandom };

/// Unit sphere: an icosahedron whose faces are divided n x n; 20 n^2 triangles of similar size.
SurfaceMesh geodesicSphere(int n);

/// Geodesic sphere of about the given number of triangles.
SurfaceMesh sphereOfAbout(int triangles);

/// Unit sphere by latitude and longitude: needle triangles at the poles.
SurfaceMesh latitudeSphere(int rings, int sectors);

/// The cube [0,1]^3 with n x n squares on each side: 12 n^2 triangles.
SurfaceMesh gridCube(int n, Diagonals diagonals = Diagonals::kParallel, std::uint64_t seed = 1);

/// An axis-parallel box with nx, ny, nz squares along its edges.
SurfaceMesh gridBox(const Vec3& lower, const Vec3& upper, std::array<int, 3> counts,
                    Diagonals diagonals = Diagonals::kParallel, std::uint64_t seed = 1);

SurfaceMesh torus(double majorRadius, double minorRadius, int majorCount, int minorCount);

/// gridCube(n) with a cavity: the cube [0.25,0.75]^3 with m x m squares on each side.
SurfaceMesh cubeWithCubicCavity(int n, int m);

/// gridCube(n) with a cavity: a geodesic sphere of radius 0.3 around its centre, with 20 m^2
/// triangles.
SurfaceMesh cubeWithSphericalCavity(int n, int m);

/// Schönhardt's prism: the top triangle of a prism is rotated by `degrees` < 60, which bends each
/// side inward along its diagonal. For any angle > 0, filling it needs an interior node.
SurfaceMesh schoenhardtPrism(double degrees);

/// A plate of 1 x 1 with n x n squares, and one layer of squares over its thickness.
SurfaceMesh thinPlate(int n, double thickness);

/// Two cubes with one square per side that share the nodes of one edge, or one node.
SurfaceMesh cubesSharingEdge();
SurfaceMesh cubesSharingNode();

/// `depth` spheres of 20 n^2 triangles around one centre, alternately facing outward and inward:
/// outer shell, cavity, island, ...
SurfaceMesh nestedSpheres(int depth, int n);

/// The box [0, nx] x [0, ny] x [0, nz], divided into unit cubes with m x m squares per side,
/// including the interfaces between them. Each interface is listed once and faces towards
/// increasing coordinates; the other triangles face outward.
SurfaceMesh dividedBox(std::array<int, 3> counts, int m);

struct RegionedSurface {
  SurfaceMesh mesh;
  GivenRegions regions;
};
/// Two unit cubes beside each other, of two triangles per side. The one up to x = 1 is region 0, with this largest volume; the
/// other one is region 1.
RegionedSurface twoRegions(double maxVolume);

/// The triangles up to x = 1 and the others, with their longest edges.
struct HalfShare {
  std::size_t left = 0;
  std::size_t right = 0;
  double longestLeft = 0.0;
  double longestRight = 0.0;
};
HalfShare halvesOf(const SurfaceMesh& mesh);

/// A tetrahedron with the four given corners in any order, oriented outward.
SurfaceMesh tetrahedronSurface(const std::array<Vec3, 4>& corners);

// ---- changing a mesh -----------------------------------------------------------------------------

void translate(SurfaceMesh& mesh, const Vec3& by);
void scale(SurfaceMesh& mesh, double factor);
void stretch(SurfaceMesh& mesh, const Vec3& factors);

/// Replaces x by -x, and flips the triangles so that they still face outward.
void mirror(SurfaceMesh& mesh);

/// Applies a random rotation, uniformly distributed.
void rotateRandomly(SurfaceMesh& mesh, std::uint64_t seed);

/// Flips every triangle.
void turnInsideOut(SurfaceMesh& mesh);

/// Flips about half of the triangles, chosen by the seed.
void flipRandomly(SurfaceMesh& mesh, std::uint64_t seed);

/// Renumbers nodes and triangles by random permutations, and rotates each triangle's start.
void shuffle(SurfaceMesh& mesh, std::uint64_t seed);

/// Appends the other mesh; its nodes get new indices.
void append(SurfaceMesh& mesh, const SurfaceMesh& other);

// ---- reading one -----------------------------------------------------------------------------------

inline Vec3 pointOf(const SurfaceMesh& mesh, std::uint32_t node) {
  return {mesh.points[3 * std::size_t{node}], mesh.points[3 * std::size_t{node} + 1],
          mesh.points[3 * std::size_t{node} + 2]};
}
std::size_t nodeCount(const SurfaceMesh& mesh);
std::size_t triangleCount(const SurfaceMesh& mesh);

/// Returns the volume by the divergence theorem; positive if the surface faces outward. The surface
/// must not have interfaces.
double enclosedVolume(const SurfaceMesh& mesh);

/// Returns the volume of each region of a surface with triangleRegions.
std::vector<double> regionVolumes(const SurfaceMesh& mesh);

}  // namespace tetrafront::testing
