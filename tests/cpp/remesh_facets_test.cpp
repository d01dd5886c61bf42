/// Changes over one facet of a curved patch, which need no proof of their distance.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

#include "base/task.h"
#include "remesh/envelope.h"
#include "remesh/guarded_surface.h"
#include "remesh/surface_editor.h"
#include "support/hard_shapes.h"
#include "support/part_shapes.h"
#include "support/surface_measures.h"
#include "topology/surface_access.h"

namespace tetrafront::testing {
namespace {

constexpr double kTolerance = 0.02;
constexpr double kSize = 0.25;

/// An L without features: it is one curved patch, whose facets are its flat faces. Turned, so that no plane is exact.
SurfaceMesh turnedL() {
  SurfaceMesh mesh =
      prism({{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}}, {}}, 0.7);
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
    const Vec3 p(mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]);
    const Vec3 q(0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, p.z);
    mesh.points[i] = q.x;
    mesh.points[i + 1] = 0.28 * q.y - 0.96 * q.z;
    mesh.points[i + 2] = 0.96 * q.y + 0.28 * q.z;
  }
  return mesh;
}

TEST(RemeshFacets, ManyNeedlesHaveFewLongPieces) {
  // Pieces of the usual length would be 2 to 3 million.
  constexpr std::uint32_t kStrips = 20'000;
  const SurfaceMesh given = needleDrum(kStrips, 0);
  ReferenceSurface reference(given, FeatureRules{});
  Job<> job([&reference](Work& work) { return reference.prepare(work); });
  job.finish();
  EXPECT_LE(reference.pieces().size(), 1'000'000 + countTriangles(given));
  double area = 0.0;
  for (const ReferenceSurface::Piece& piece : reference.pieces()) area += piece.area;
  const double wall = 4.0 * kStrips * std::sin(std::numbers::pi / kStrips);
  const double cap = 0.5 * kStrips * std::sin(2.0 * std::numbers::pi / kStrips);
  EXPECT_NEAR(area, wall + 2.0 * cap, 1e-9);
  // The side of the drum is at a distance of 0.1 from these positions, up to the sagitta of a strip.
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.7 * i;
    const Vec3 position(1.1 * std::cos(angle), 1.1 * std::sin(angle), 0.2 * i + 0.1);
    double nearest = 1.0;
    for (const SmoothPatchId patch : IdRange<SmoothPatchId>(reference.patchCount())) {
      const NearestPoint found = reference.nearest(position, patch, 0.5, {});
      if (!found.triangle.isNone()) nearest = std::min(nearest, std::sqrt(found.squaredDistance));
    }
    EXPECT_NEAR(nearest, 0.1, 1e-7);
  }
}

TEST(RemeshFacets, TrianglesOverAFacetStayOverIt) {
  const SurfaceMesh given = turnedL();
  ReferenceSurface reference(given, {.creaseCosine = -1.0, .cornerCosine = -1.0});
  Job<> job([&reference](Work& work) { return reference.prepare(work); });
  job.finish();
  SurfaceLimits limits;
  limits.tolerance = kTolerance;
  GuardedSurface surface(reference, limits, kSize);
  const RemeshSizes sizes(SizeField::uniform(kSize));
  SurfaceEditor editor(surface, sizes);
  const SurfaceComplex& complex = surface.complex();
  std::mt19937_64 random(17);
  const auto below = [&](std::size_t count) {
    return static_cast<std::uint32_t>(random() % count);
  };
  std::array<int, 4> made{};
  for (int i = 0; i < 3000; ++i) {
    const TriangleId t(below(complex.triangleSlots()));
    if (!complex.isAlive(t)) continue;
    const std::uint32_t k = below(3);
    const NodeId a = complex.nodesOf(t)[k];
    const NodeId b = complex.nodesOf(t)[(k + 1) % 3];
    const std::uint32_t kind = i < 300 ? 0 : below(4);
    bool isMade = false;
    if (kind == 0 && complex.triangleCount() < 600) isMade = editor.split(a, b);
    if (kind == 1) isMade = editor.collapse(a, b, CollapseRule{2.0, 0.0, false});
    if (kind == 2) isMade = editor.flip(a, b);
    if (kind == 3) isMade = editor.smooth(a);
    if (isMade) ++made[kind];
  }
  for (const int count : made) EXPECT_GT(count, 20);
  std::size_t over = 0;
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    if (!complex.isAlive(t)) continue;
    const PatchFacetId id = surface.facetUnder({&t, 1});
    const auto [a, b, c] = complex.cornersOf(t);
    if (!id.isNone()) {
      ++over;
      EXPECT_TRUE(isNearFacet(reference.facet(id), complex.cornersOf(t), kTolerance));
    }
    for (int n = 0; n < 20; ++n) {
      const double u = 0.05 * below(21);
      const double v = (1.0 - u) * 0.05 * below(21);
      EXPECT_LE(distanceTo(given, a + (b - a) * u + (c - a) * v), kTolerance * (1.0 + 1e-9));
    }
  }
  EXPECT_GT(2 * over, complex.triangleCount());
}

TEST(RemeshFacets, ATriangleBeyondTheEdgeOfAFacetDoesNotLieOverIt) {
  const SurfaceMesh given = turnedL();
  ReferenceSurface reference(given, {.creaseCosine = -1.0, .cornerCosine = -1.0});
  Job<> job([&reference](Work& work) { return reference.prepare(work); });
  job.finish();
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(given))) {
    const std::array<Vec3, 3> corners = cornersOf(given, t);
    const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    const auto proofOf = [&](double scale) {
      std::array<Vec3, 3> scaled{};
      for (std::size_t k = 0; k < 3; ++k) scaled[k] = centre + (corners[k] - centre) * scale;
      return proveWithin(reference, scaled, reference.patchOf(t), kTolerance, {t, 0.0, centre});
    };
    const EnvelopeProof inside = proofOf(0.3);
    EXPECT_TRUE(inside.isProven);
    EXPECT_EQ(inside.over, reference.facetOf(t));
    EXPECT_FALSE(proofOf(3.0).isProven);
  }
}

}  // namespace
}  // namespace tetrafront::testing
