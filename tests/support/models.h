#pragma once

/// @file Drawn models for tests.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/model.h"

namespace tetrafront::testing {

/// Draws points, lines and patches; a point given twice with the same coordinates is one point.
class ModelBuilder {
 public:
  std::uint32_t point(const Vec3& position);
  std::uint32_t line(LineType type, const std::vector<Vec3>& positions);
  OrientedLine straight(const Vec3& from, const Vec3& to);

  /// A closed polygon of straight lines.
  Loop polygon(const std::vector<Vec3>& corners);

  /// A circle of `arcs` splines about `centre`, in the plane of the orthonormal u and v.
  Loop circle(const Vec3& centre, double radius, int arcs, const Vec3& u = {1, 0, 0},
              const Vec3& v = {0, 1, 0});

  void patch(PatchType type, std::vector<Loop> loops);

  Model model;
};

/// One planar patch: the outer polygon first, then holes.
Model polygonModel(const std::vector<std::vector<Vec3>>& loops);

/// The unit square in the plane z = 0 moved by `corner`, with edges of length `edge`.
std::vector<Vec3> squareCorners(const Vec3& corner, double edge);

/// A Coons patch over a quadrilateral whose lines are straight, parabolic or splines, bent and
/// twisted by up to `bend`; which, the seed decides.
Model randomCoonsModel(std::uint64_t seed, double bend);

/// A triangular patch of either type, likewise; the lines of an isoparametric one are parabolic.
Model randomTriangleModel(PatchType type, std::uint64_t seed, double bend);

/// All patch types except the planar one.
inline constexpr std::array<PatchType, 4> kCurvedTypes{
    PatchType::kIsoparametricTriangle, PatchType::kSerendipity, PatchType::kBarnhillGregoryNielson,
    PatchType::kCoons};

/// Bend of random models: clearly curved, without folds.
inline constexpr double kTypicalBend = 0.3;

/// A patch of any type but planar; as randomCoonsModel() and randomTriangleModel().
Model randomCurvedModel(PatchType type, std::uint64_t seed, double bend);

/// A planar patch in a random plane: a star-shaped polygon of mean radius 1 with up to four
/// polygonal holes. `area` receives its area.
Model randomPolygonModel(std::uint64_t seed, double& area);

/// The box of six planar patches that share twelve lines; some lines and loops run backward.
Model boxModel(const Vec3& low, const Vec3& high);

/// A box of six Coons, or serendipity, patches whose corners are moved and whose twelve lines, of
/// random types, or parabolic, are bent by up to `bend`.
Model randomBentBox(std::uint64_t seed, double bend, PatchType type = PatchType::kCoons);

/// A tetrahedron of four triangular patches of either type, likewise.
Model randomBentTetrahedron(std::uint64_t seed, double bend, PatchType type);

/// The sphere about the origin, nearly, as six Coons patches between twelve arcs: a cube blown up.
Model sphereModel(double radius);

/// A torus about the z axis as 8 x 4 Coons patches.
Model torusModel(double majorRadius, double minorRadius);

/// An angle bracket 2 x 1 x 1.5, its arms 0.4 thick: a fillet between them, a hole in each.
Model bracketModel();

/// The side of a tube, one Coons patch between two circles of one spline each, with a seam.
Model seamedTube(double radius, double height);

/// No nodes, and one point source.
inline BackgroundGrid sourceAt(const Vec3& position, double size, double distance) {
  BackgroundGrid grid;
  grid.sources.emplace_back();
  grid.sources[0].points[0] = position;
  grid.sources[0].size = size;
  grid.sources[0].distance = distance;
  return grid;
}

/// Six tetrahedra over the box; `sizeAt` gives the size at its corners.
template <class SizeAt>
BackgroundGrid boxGrid(const Vec3& low, const Vec3& high, SizeAt&& sizeAt) {
  BackgroundGrid grid;
  for (int corner = 0; corner < 8; ++corner) {
    BackgroundNode node;
    node.position = {(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                     (corner & 4) != 0 ? high.z : low.z};
    node.size = sizeAt(node.position);
    grid.nodes.push_back(node);
  }
  // Kuhn's division: all six share the diagonal 0-7.
  grid.tetrahedra = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                     {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  return grid;
}

}  // namespace tetrafront::testing
