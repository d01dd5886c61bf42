/// @file No change of the remesher passes over other triangles, which would then be in another region.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

#include "base/ids.h"
#include "boundary/boundary.h"
#include "geom/intersect.h"
#include "geom/measure.h"
#include "remesh/swept_volume.h"
#include "support/remeshed.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/remesh.h"

namespace tetrafront::testing {
namespace {

/// Triangles of numbered points.
std::vector<NumberedTriangle> trianglesOf(
    const std::vector<Vec3>& points, std::initializer_list<std::array<std::uint32_t, 3>> nodes) {
  std::vector<NumberedTriangle> triangles;
  for (const auto& [a, b, c] : nodes)
    triangles.push_back({{a, b, c}, {points[a], points[b], points[c]}});
  return triangles;
}

/// A small triangle with its first node at the position.
NumberedTriangle smallTriangle(const Vec3& position) {
  constexpr double kSmall = 1e-3;
  const Vec3 side(kSmall, 0.0, 0.0);
  const Vec3 up(0.0, 0.0, kSmall);
  return {{90U, 91U, 92U}, {position, position + side, position + up}};
}

/// Corners of a quadrilateral that is not plane: two are above the two others.
const std::vector<Vec3> kQuadrilateral{
    {-1.0, 0.0, 0.1}, {0.0, -1.0, -0.1}, {1.0, 0.0, 0.1}, {0.0, 1.0, -0.1}};

TEST(SweptVolume, OfAFlipIsTheTetrahedronOfItsNodes) {
  const auto triangles = trianglesOf(kQuadrilateral, {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}});
  SweptVolume swept;
  swept.begin(triangles, 2);
  EXPECT_TRUE(swept.contains(smallTriangle({0.0, 0.0, 0.0})));
  EXPECT_TRUE(swept.contains(smallTriangle({0.2, 0.2, 0.0})));
  EXPECT_FALSE(swept.contains(smallTriangle({0.0, 0.0, 0.11})));
  EXPECT_FALSE(swept.contains(smallTriangle({0.0, 0.0, -0.11})));
  EXPECT_FALSE(swept.contains(smallTriangle({0.9, 0.9, 0.0})));
}

/// A sheet with the boundary of the change and no other node, in the middle between both and beyond the second one.
TEST(SweptVolume, FindsSheetsWithoutNodesOfTheirOwn) {
  std::vector<Vec3> points = kQuadrilateral;
  points.emplace_back(0.0, 0.0, 0.3);
  points.emplace_back(0.0, 0.0, -0.3);
  const auto triangles = trianglesOf(
      points,
      {{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 3, 0}, {5, 0, 1}, {5, 1, 2}, {5, 2, 3}, {5, 3, 0}});
  SweptVolume swept;
  swept.begin(triangles, 4);
  for (const NumberedTriangle& between : trianglesOf(points, {{0, 1, 2}, {0, 2, 3}})) {
    EXPECT_TRUE(swept.contains(between));
  }
  points[5].z = 0.2;
  const auto above = trianglesOf(
      points,
      {{4, 0, 1}, {4, 1, 2}, {4, 2, 3}, {4, 3, 0}, {5, 0, 1}, {5, 1, 2}, {5, 2, 3}, {5, 3, 0}});
  swept.begin(above, 4);
  for (const NumberedTriangle& beyond : trianglesOf(points, {{0, 1, 2}, {0, 2, 3}})) {
    EXPECT_FALSE(swept.contains(beyond));
  }
}

/// Three half-planes at 120 degrees around an edge. The middle of the edge moves: what is between the old and the new middle is
/// passed over by one of them.
TEST(SweptVolume, OfThreeSheetsIsWhatOneOfThemPasses) {
  std::vector<Vec3> points{{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0},  {0.0, 0.0, 0.0},  {0.3, 0.2, 0.0},
                           {1.0, 0.0, 0.0},  {-0.5, 0.9, 0.0}, {-0.5, -0.9, 0.0}};
  auto triangles =
      trianglesOf(points, {{0, 2, 4}, {2, 1, 4}, {0, 2, 5}, {2, 1, 5}, {0, 2, 6}, {2, 1, 6}});
  const auto after =
      trianglesOf(points, {{0, 3, 4}, {3, 1, 4}, {0, 3, 5}, {3, 1, 5}, {0, 3, 6}, {3, 1, 6}});
  triangles.insert(triangles.end(), after.begin(), after.end());
  SweptVolume swept;
  swept.begin(triangles, 6);
  // Between the half-plane through node 4 before and after the move.
  EXPECT_TRUE(swept.contains(smallTriangle({0.3, 0.1, 0.001})));
  // Between that through node 6 before and after.
  EXPECT_TRUE(swept.contains(smallTriangle({-0.05, -0.2, 0.001})));
  // Beyond all of them.
  EXPECT_FALSE(swept.contains(smallTriangle({0.3, 0.3, 0.001})));
  EXPECT_FALSE(swept.contains(smallTriangle({-0.6, 0.1, 0.001})));
  EXPECT_FALSE(swept.contains(smallTriangle({0.3, -0.4, 0.001})));
  EXPECT_FALSE(swept.contains(smallTriangle({-0.3, 0.02, 0.9})));
}

/// The corners of two bodies that touch along an edge of four triangles, from node 0 or 1 to node 2. The corner moves into the first
/// body: what is there then is passed over by the triangles of both.
TEST(SweptVolume, OfBodiesThatTouchAlongAnEdgeIsThatOfBoth) {
  const std::vector<Vec3> points{{0.0, 0.0, 0.0}, {0.5, 0.0, 0.4},  {0.0, 0.0, 1.0},
                                 {1.0, 1.0, 0.3}, {1.0, -1.0, 0.3}, {-1.0, -1.0, 0.3},
                                 {-1.0, 1.0, 0.3}};
  auto triangles =
      trianglesOf(points, {{0, 2, 3}, {0, 3, 4}, {0, 4, 2}, {0, 2, 5}, {0, 5, 6}, {0, 6, 2}});
  const auto after =
      trianglesOf(points, {{1, 2, 3}, {1, 3, 4}, {1, 4, 2}, {1, 2, 5}, {1, 5, 6}, {1, 6, 2}});
  triangles.insert(triangles.end(), after.begin(), after.end());
  SweptVolume swept;
  swept.begin(triangles, 6);
  for (const double part : {0.2, 0.5, 0.8}) {
    EXPECT_TRUE(swept.contains(smallTriangle(points[0] + (points[1] - points[0]) * part))) << part;
  }
  EXPECT_FALSE(swept.contains(smallTriangle({-0.5, 0.0, 0.4})));
  EXPECT_FALSE(swept.contains(smallTriangle({0.8, 0.0, 0.5})));
  EXPECT_FALSE(swept.contains(smallTriangle({0.0, 0.9, 0.0})));
}

/// A sheet that separates nothing moves with the corner of a sheet that it ends at: what it alone passes stays where it was.
TEST(SweptVolume, OfASheetWithAFreeEdgeIsThatOfTheOthers) {
  std::vector<Vec3> points{{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0},  {0.0, 0.0, 0.0}, {0.0, 0.3, 0.0},
                           {1.0, 0.0, 0.0},  {-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
  auto triangles = trianglesOf(points, {{0, 2, 4}, {2, 1, 4}, {0, 2, 5}, {2, 1, 5}, {0, 2, 6}});
  const auto after = trianglesOf(points, {{0, 3, 4}, {3, 1, 4}, {0, 3, 5}, {3, 1, 5}, {0, 3, 6}});
  triangles.insert(triangles.end(), after.begin(), after.end());
  SweptVolume swept;
  swept.begin(triangles, 5);
  EXPECT_TRUE(swept.contains(smallTriangle({0.2, 0.1, 0.001})));
  EXPECT_TRUE(swept.contains(smallTriangle({-0.2, 0.1, 0.001})));
  EXPECT_FALSE(swept.contains(smallTriangle({0.2, -0.1, 0.001})));
  EXPECT_FALSE(swept.contains(smallTriangle({0.01, -0.5, -0.1})));
}

/// A box of two regions, one on the other, with a closed gap between them: its upper sheet are two triangles, the lower one
/// four with the same boundary. The other diagonal of the two would be below the four. All is within the tolerance.
class GappedBox {
 public:
  explicit GappedBox(std::uint64_t seed) : random_(seed) {
    const auto below = addRing(kWidth, -1.0);
    const auto middle = addRing(kWidth, 0.0);
    const auto above = addRing(kWidth, 1.0);
    add(below[0], below[2], below[1], 0);
    add(below[0], below[3], below[2], 0);
    add(above[0], above[1], above[2], 1);
    add(above[0], above[2], above[3], 1);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t l = (k + 1) % 4;
      add(below[k], below[l], middle[l], 0);
      add(below[k], middle[l], middle[k], 0);
      add(middle[k], middle[l], above[l], 1);
      add(middle[k], above[l], above[k], 1);
    }
    const std::array<std::uint32_t, 4> gap{addNode({-any(0.5, 0.8), any(-0.02, 0.02), height()}),
                                           addNode({any(-0.02, 0.02), -any(0.3, 0.5), -height()}),
                                           addNode({any(0.5, 0.8), any(-0.02, 0.02), height()}),
                                           addNode({any(-0.02, 0.02), any(0.3, 0.5), -height()})};
    const auto& [left, front, right, back] = gap;
    // The upper sheet faces down into the gap.
    add(left, right, front, 1);
    add(left, back, right, 1);
    const std::uint32_t middleOfLower = addNode({any(-0.02, 0.02), any(-0.02, 0.02), 0.0});
    for (std::size_t k = 0; k < 4; ++k) add(middleOfLower, gap[k], gap[(k + 1) % 4], 0);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t l = (k + 1) % 4;
      // The ring begins at the corner to the front and the left.
      add(middle[k], middle[l], gap[l], 0, 1);
      add(middle[k], gap[l], gap[k], 0, 1);
    }
  }

  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }

 private:
  static constexpr double kWidth = 2.0;

  double any(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double height() { return any(1e-3, 2e-3); }

  std::uint32_t addNode(const Vec3& p) {
    mesh_.points.insert(mesh_.points.end(), {p.x, p.y, p.z});
    return static_cast<std::uint32_t>(mesh_.points.size() / 3 - 1);
  }

  std::array<std::uint32_t, 4> addRing(double width, double z) {
    return {addNode({-width, -width, z}), addNode({width, -width, z}), addNode({width, width, z}),
            addNode({-width, width, z})};
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t behind,
           std::uint32_t inFront = SurfaceMesh::kNoRegion) {
    mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
    mesh_.triangleRegions.insert(mesh_.triangleRegions.end(), {behind, inFront});
  }

  std::mt19937_64 random_;
  SurfaceMesh mesh_;
};

/// Returns the errors of a surface with given regions.
std::vector<Diagnostic> regionErrors(SurfaceMesh mesh) {
  std::vector<Diagnostic> found;
  closeBoundary(mesh, BoundarySource::kGivenSurface, found, InnerShells::kCavities);
  std::erase_if(found, [](const Diagnostic& d) { return d.severity != Severity::kError; });
  return found;
}

TEST(RemeshRegions, StayBesideAGapFlatterThanTheTolerance) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const SurfaceMesh given = GappedBox(seed).mesh();
    ASSERT_TRUE(regionErrors(given).empty()) << "seed " << seed;
    RemeshOptions options;
    options.size = 0.25 * static_cast<double>(1 + seed % 8);
    options.dropPoorDetails = seed % 2 == 0;
    GivenRegions regions;
    regions.triangleRegions = given.triangleRegions;
    SurfaceRemesher remesher(given.points, given.triangles, {}, {}, options, regions);
    while (!remesher.advance(1U << 20U)) {
    }
    const SurfaceRemesh& result = remesher.result();
    ASSERT_TRUE(result.diagnostics.empty()) << "seed " << seed;
    SurfaceMesh made = surfaceOf(result);
    for (const std::uint32_t from : result.origin) {
      made.triangleRegions.push_back(given.triangleRegions[2 * std::size_t{from}]);
      made.triangleRegions.push_back(given.triangleRegions[2 * std::size_t{from} + 1]);
    }
    EXPECT_TRUE(regionErrors(made).empty()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace tetrafront::testing
