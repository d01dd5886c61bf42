// Thin regions between patches that share the lines on both sides of a strip or corner: the patches do not coincide,
// and the surface is closed.

#include "surface/shared_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "boundary/boundary.h"
#include "model/check_model.h"
#include "sizing/expected_count.h"
#include "support/meshed_surface.h"
#include "support/models.h"
#include "support/random.h"
#include "support/shapes.h"

namespace tetrafront::testing {
namespace {

OrientedLine arc(ModelBuilder& builder, const Vec3& from, const Vec3& middle, const Vec3& to) {
  return {builder.line(LineType::kParabolic, {from, middle, to}), false};
}

OrientedLine reversed(const OrientedLine& line) { return {line.line, !line.reversed}; }

/// Two triangular patches between two lines that enclose `angle`. Their third lines rise by `high` and by `low` over the
/// chord between the ends of the two lines; a planar patch lies between them.
Model fin(PatchType type, Random& random, double angle, double low, double high) {
  ModelBuilder builder;
  const Vec3 tip(0.0);
  const Vec3 a(random.between(0.7, 2.0), 0, 0);
  const Vec3 b = random.between(0.7, 2.0) * Vec3(std::cos(angle), std::sin(angle), 0);
  const Vec3 sway(0, random.between(-0.1, 0.1) * angle, 0);
  const OrientedLine first = arc(builder, tip, 0.5 * a + sway, a);
  const OrientedLine last = arc(builder, tip, 0.5 * b, b);
  const Vec3 up(0, 0, glm::length(b - a));
  const OrientedLine above = arc(builder, a, 0.5 * (a + b) + high * up, b);
  const OrientedLine below = arc(builder, a, 0.5 * (a + b) + low * up, b);
  builder.patch(type, {{first, above, reversed(last)}});
  builder.patch(type, {{first, below, reversed(last)}});
  builder.patch(PatchType::kPlanar, {{above, reversed(below)}});
  return std::move(builder.model);
}

/// Two Coons patches between two long lines, closed by planar patches at both ends.
Model lens(Random& random, double width, double low, double high) {
  ModelBuilder builder;
  const std::array<Vec3, 2> left{Vec3(0.0), Vec3(random.between(1.0, 3.0), 0.1, 0)};
  const std::array<Vec3, 2> right{Vec3(0, width, 0), left[1] + Vec3(0, 0.6 * width, 0)};
  const double sag = random.between(-0.1, 0.1);
  const auto along = [&](const std::array<Vec3, 2>& ends) {
    return arc(builder, ends[0], 0.5 * (ends[0] + ends[1]) + Vec3(0, 0, sag), ends[1]);
  };
  const auto across = [&](std::size_t end, double rise) {
    const Vec3 middle = 0.5 * (left[end] + right[end]);
    return arc(builder, left[end], middle + Vec3(0, 0, rise * glm::length(right[end] - left[end])),
               right[end]);
  };
  const OrientedLine first = along(left);
  const OrientedLine last = along(right);
  const std::array<OrientedLine, 2> above{across(0, high), across(1, high)};
  const std::array<OrientedLine, 2> below{across(0, low), across(1, low)};
  builder.patch(PatchType::kCoons, {{first, above[1], reversed(last), reversed(above[0])}});
  builder.patch(PatchType::kCoons, {{first, below[1], reversed(last), reversed(below[0])}});
  for (std::size_t end = 0; end < 2; ++end)
    builder.patch(PatchType::kPlanar, {{above[end], reversed(below[end])}});
  return std::move(builder.model);
}

/// Two triangular patches of different types between the same three bent lines.
Model pillow() {
  ModelBuilder builder;
  const Vec3 a(0.0);
  const Vec3 b(1, 0, 0);
  const Vec3 c(0.4, 0.9, 0);
  const Vec3 up(0, 0, 0.4);
  const Loop loop{arc(builder, a, 0.5 * (a + b) + up, b), arc(builder, b, 0.5 * (b + c) + up, c),
                  arc(builder, c, 0.5 * (c + a) + up, a)};
  builder.patch(PatchType::kIsoparametricTriangle, {loop});
  builder.patch(PatchType::kBarnhillGregoryNielson, {loop});
  return std::move(builder.model);
}

/// Triangles with the same three nodes.
std::size_t countDuplicates(const SurfaceMesh& mesh) {
  std::set<std::array<std::uint32_t, 3>> known;
  std::size_t doubles = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    std::array<std::uint32_t, 3> nodes{mesh.triangles[t], mesh.triangles[t + 1],
                                       mesh.triangles[t + 2]};
    std::ranges::sort(nodes);
    doubles += known.insert(nodes).second ? 0 : 1;
  }
  return doubles;
}

void expectOneRegion(const Model& model, double size) {
  ASSERT_TRUE(diagnoseModel(model).empty());
  SurfaceMesh mesh = meshOf(model, size);
  EXPECT_EQ(countDuplicates(mesh), 0U);
  std::vector<Diagnostic> found;
  const Boundary boundary = closeBoundary(mesh, BoundarySource::kDrawnPatches, found);
  EXPECT_TRUE(boundary.isValid);
  EXPECT_EQ(boundary.regionCount, 1U);
  EXPECT_GT(tetrafront::enclosedVolume(mesh), 0.0);
}

TEST(SurfaceSharedStrips, CornersOfAnySharpnessClose) {
  for (const PatchType type :
       {PatchType::kBarnhillGregoryNielson, PatchType::kIsoparametricTriangle}) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
      SCOPED_TRACE("type " + std::to_string(static_cast<int>(type)) + " seed " +
                   std::to_string(seed));
      Random random(seed);
      const double degrees = seed < 5 ? 0.5 * (seed + 1.0) : random.between(3.0, 60.0);
      const double low = seed % 3 == 0 ? 0.0 : -random.between(0.05, 0.4);
      const Model model =
          fin(type, random, degrees * std::numbers::pi / 180.0, low, random.between(0.05, 0.4));
      expectOneRegion(model, random.between(0.08, 0.6));
    }
  }
}

TEST(SurfaceSharedStrips, ThinLensesOfFewTrianglesAcrossClose) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Model model = lens(random, random.between(0.05, 0.4), -random.between(0.05, 0.3),
                             random.between(0.05, 0.3));
    expectOneRegion(model, random.between(0.08, 0.6));
  }
}

TEST(SurfaceSharedStrips, PillowOfTwoTrianglesCloses) {
  for (const double size : {5.0, 1.0, 0.5}) {
    SCOPED_TRACE(size);
    expectOneRegion(pillow(), size);
  }
}

TEST(SurfaceSharedStrips, PatchesThatShareNoStripDoNotChange) {
  // A tetrahedron of four triangles: no other patch has all three nodes of a patch.
  ModelBuilder builder;
  const std::array<Vec3, 4> p{Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  for (const std::array<std::size_t, 3>& face :
       {std::array<std::size_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    builder.patch(PatchType::kBarnhillGregoryNielson,
                  {builder.polygon({p[face[0]], p[face[1]], p[face[2]]})});
  EXPECT_EQ(triangleCount(meshOf(builder.model, 3.0)), 4U);
}

}  // namespace
}  // namespace tetrafront::testing
