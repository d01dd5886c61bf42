#pragma once

/// @file Drawn models for tests.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/model.h"

namespace tetrafront::testing {

/// Builds a model from points, lines and patches. Equal positions become one point.
class ModelBuilder {
 public:
  std::uint32_t point(const Vec3& position);
  std::uint32_t line(LineType type, const std::vector<Vec3>& positions);
  OrientedLine straight(const Vec3& from, const Vec3& to);

  /// A closed polygon of straight lines.
  Loop polygon(const std::vector<Vec3>& corners);

  /// A circle around `centre` of `arcs` splines, in the plane of the orthonormal u and v.
  Loop circle(const Vec3& centre, double radius, int arcs, const Vec3& u = {1, 0, 0},
              const Vec3& v = {0, 1, 0});

  /// The exact circle from `centre` + `radius` u, as one line.
  OrientedLine exactCircle(const Vec3& centre, double radius, const Vec3& u = {1, 0, 0},
                           const Vec3& v = {0, 1, 0});

  void patch(PatchType type, std::vector<Loop> loops);

  Model model;
};

/// One planar patch. The first polygon is the outer one; the others are holes.
Model polygonModel(const std::vector<std::vector<Vec3>>& loops);

/// The unit square in the plane z = 0 moved by `corner`, with edges of length `edge`.
std::vector<Vec3> squareCorners(const Vec3& corner, double edge);

/// A Coons patch over a quadrilateral. The seed decides whether each line is straight, parabolic or
/// a spline, and how far, up to `bend`, it is bent and twisted.
Model randomCoonsModel(std::uint64_t seed, double bend);

/// A triangular patch of either type, made in the same way; the lines of an isoparametric patch are
/// parabolic.
Model randomTriangleModel(PatchType type, std::uint64_t seed, double bend);

/// All patch types except the planar one.
inline constexpr std::array<PatchType, 4> kCurvedTypes{
    PatchType::kIsoparametricTriangle, PatchType::kSerendipity, PatchType::kBarnhillGregoryNielson,
    PatchType::kCoons};

/// Bend of random models: clearly curved, without folds.
inline constexpr double kTypicalBend = 0.3;

/// A patch of any curved type, made as in randomCoonsModel() and randomTriangleModel().
Model randomCurvedModel(PatchType type, std::uint64_t seed, double bend);

/// A planar patch in a random plane: a star-shaped polygon of mean radius 1 with up to four
/// polygonal holes. `area` receives its area.
Model randomPolygonModel(std::uint64_t seed, double& area);

/// The box of six planar patches that share twelve lines; some lines and loops run backward.
Model boxModel(const Vec3& low, const Vec3& high);

/// A box of six Coons or serendipity patches with displaced corners. Its twelve lines are bent by
/// up to `bend`; those of Coons patches have random types, the others are parabolic.
Model randomBentBox(std::uint64_t seed, double bend, PatchType type = PatchType::kCoons);

/// A tetrahedron of four triangular patches of either type, made in the same way.
Model randomBentTetrahedron(std::uint64_t seed, double bend, PatchType type);

/// Approximately a sphere around the origin: an inflated cube of six Coons patches between twelve
/// arcs.
Model sphereModel(double radius);

/// A torus around the z axis, of 8 x 4 Coons patches.
Model torusModel(double majorRadius, double minorRadius);

/// An angle bracket of 2 x 1 x 1.5. Its arms are 0.4 thick and have one hole each; a fillet
/// connects them.
Model bracketModel();

/// The side of a tube: one Coons patch with a seam, between two circles of one spline each.
Model seamedTube(double radius, double height);

/// A grid without nodes, with one point source.
inline BackgroundGrid sourceAt(const Vec3& position, double size, double distance) {
  BackgroundGrid grid;
  grid.sources.emplace_back();
  grid.sources[0].points[0] = position;
  grid.sources[0].size = size;
  grid.sources[0].distance = distance;
  return grid;
}

/// A grid of six tetrahedra that fill the box; `sizeAt` returns the size at a corner.
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
