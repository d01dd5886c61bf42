/// @file A body that is turned, renumbered or scaled is the same body: the remesher and the optimizer may choose other
/// triangles and elements, but neither more of them nor worse ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "field/size_field.h"
#include "optimize/locality.h"
#include "optimize/optimizer.h"
#include "quality/metrics.h"
#include "support/hard_shapes.h"
#include "support/random.h"
#include "support/remeshed.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/mesher.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"
#include "topology/tet_mesh.h"

namespace tetrafront::testing {
namespace {

struct Variant {
  std::string name;
  std::function<void(SurfaceMesh&)> apply;
};

const std::vector<Variant> kVariants{
    {"turned", [](SurfaceMesh& mesh) { rotateRandomly(mesh, 1); }},
    {"renumbered", [](SurfaceMesh& mesh) { shuffle(mesh, 1); }},
};

const std::vector<Body> kBodies{
    {"gear", [] { return needleGear(12, 0.3); }},
    {"blade", [] { return twistedBlade(8, 4, 0.04); }},
    {"knot", [] { return torusKnot(2, 3, 60, 8); }},
    {"loft", [] { return loft(5, 24, 2.0, 0.5); }},
};

class InvarianceOf : public ::testing::TestWithParam<Body> {};

TEST_P(InvarianceOf, TheRemesher) {
  // By default, size and tolerance follow from the box around the body, which a rotation changes.
  const SurfaceMesh given = GetParam().make();
  RemeshOptions options;
  options.size = std::sqrt(measure(given, SizeField::uniform(1.0)).area / 1000.0);
  options.tolerance = 0.1 * options.size;
  const SurfaceRemesh first = remesh(given, options);
  const double count = countTriangles(surfaceOf(first));
  for (const Variant& variant : kVariants) {
    SurfaceMesh mesh = given;
    variant.apply(mesh);
    const SurfaceRemesh made = remesh(mesh, options);
    EXPECT_NEAR(countTriangles(surfaceOf(made)), count, 0.12 * count) << variant.name;
    EXPECT_LE(made.deviation, options.tolerance) << variant.name;
    EXPECT_NEAR(made.volume, first.volume, 2e-3 * first.volume) << variant.name;
    EXPECT_GT(made.smallestAngle, std::min(first.smallestAngle - 6.0, 15.0)) << variant.name;
  }
}

TEST_P(InvarianceOf, TheRemesherUnderExactScaling) {
  const SurfaceRemesh first = remesh(GetParam().make());
  for (const double factor : {std::ldexp(1.0, -30), std::ldexp(1.0, 20)}) {
    SurfaceMesh mesh = GetParam().make();
    scale(mesh, factor);
    SurfaceMesh made = surfaceOf(remesh(mesh));
    scale(made, 1.0 / factor);
    EXPECT_EQ(made.triangles, first.triangles) << factor;
    EXPECT_EQ(made.points, first.points) << factor;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, InvarianceOf, ::testing::ValuesIn(kBodies),
                         [](const auto& each) { return each.param.name; });

/// Renumbers the elements, the nodes inside, and the corners of each element, whose orientation stays.
void shuffle(TetMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  const auto permuted = [&random](std::size_t first, std::size_t last) {
    std::vector<std::size_t> order(last - first);
    std::iota(order.begin(), order.end(), first);
    for (std::size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[random.bits() % i]);
    }
    return order;
  };
  std::vector<NodeId> newId(mesh.points.size());
  std::vector<Vec3> points = mesh.points;
  const auto fixed = static_cast<std::size_t>(std::ranges::count(mesh.isFixed, 1));
  for (const NodeId node : IdRange<NodeId>(fixed)) newId[node.index()] = node;
  std::size_t next = fixed;
  for (const std::size_t node : permuted(fixed, mesh.points.size())) {
    points[next] = mesh.points[node];
    newId[node] = NodeId(next++);
  }
  TetMesh shuffled;
  shuffled.points = std::move(points);
  shuffled.isFixed = mesh.isFixed;
  for (const std::size_t t : permuted(0, mesh.tetrahedra.size())) {
    const NodeQuad& n = mesh.tetrahedra[t];
    const std::size_t turn = random.bits() % 3;
    // An even permutation: three corners in a circle.
    const NodeQuad turned{n[turn], n[(turn + 1) % 3], n[(turn + 2) % 3], n[3]};
    NodeQuad& named = shuffled.tetrahedra.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) named[k] = newId[turned[k].index()];
    shuffled.regions.push_back(mesh.regions[t]);
  }
  mesh = std::move(shuffled);
}

/// Returns the mesh that the front leaves, before it is optimized.
TetMesh frontMeshOf(const SurfaceMesh& surface) {
  MeshOptions options;
  options.optimization = Optimization::kNone;
  MeshRun run(surface.points, surface.triangles, {}, options);
  while (run.advance(1U << 20U) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  return toTetMesh(run.volume(), countNodes(surface));
}

void rotate(TetMesh& mesh, std::uint64_t seed) {
  SurfaceMesh flat;
  for (const Vec3& p : mesh.points) flat.points.insert(flat.points.end(), {p.x, p.y, p.z});
  rotateRandomly(flat, seed);
  mesh.points = pointsOf(flat);
}

VolumeMesh optimized(TetMesh mesh, const SizeField& field) {
  Job<> ordering([&mesh](Work& work) { return orderAlongMortonCurve(work, mesh); });
  ordering.finish();
  MeshOptimizer optimizer(std::move(mesh), field, Optimization::kDefault);
  Job<> optimizing([&optimizer](Work& work) { return optimizer.run(work); });
  optimizing.finish();
  return toVolumeMesh(optimizer.take());
}

TEST(Invariance, OfTheOptimizer) {
  const std::vector<std::pair<SurfaceMesh, double>> bodies{
      {geodesicSphere(8), 0.18},
      {gridCube(8, Diagonals::kRandom), 0.15},
      {torus(1.0, 0.35, 32, 12), 0.19},
      {cubeWithCubicCavity(10, 5), 0.1},
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const TetMesh given = frontMeshOf(bodies[i].first);
    const SizeField field = SizeField::uniform(bodies[i].second);
    const VolumeMesh first = optimized(given, field);
    const QualitySummary expected = measureQuality(first);
    EXPECT_GE(expected.minDihedral, 28.0) << i;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      TetMesh other = given;
      if (seed % 2 == 0) shuffle(other, seed);
      if (seed > 1) rotate(other, seed);
      if (seed == 1) shuffle(other, seed);
      const VolumeMesh made = optimized(std::move(other), field);
      const QualitySummary quality = measureQuality(made);
      const double count = countTetrahedra(first);
      EXPECT_NEAR(countTetrahedra(made), count, 0.05 * count) << i << ' ' << seed;
      EXPECT_NEAR(quality.minDihedral, expected.minDihedral, 3.0) << i << ' ' << seed;
      EXPECT_NEAR(quality.meanRadiusRatio, expected.meanRadiusRatio, 0.01) << i << ' ' << seed;
      EXPECT_NEAR(quality.volume, expected.volume, 1e-9 * expected.volume) << i << ' ' << seed;
    }
  }
}

}  // namespace
}  // namespace tetrafront::testing
