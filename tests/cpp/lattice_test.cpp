/// Lattices inside regions: what they are made of, and meshes with them.

#include "lattice/lattice_interior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/resumable.h"
#include "base/task.h"
#include "geom/measure.h"
#include "lattice/lattice_elements.h"
#include "lattice/lattice_nodes.h"
#include "quality/quality_analysis.h"
#include "quality/verify_mesh.h"
#include "support/mesh_validator.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"

namespace tetrafront {
namespace {

using testing::cubeWithSphericalCavity;
using testing::dividedBox;
using testing::geodesicSphere;
using testing::gridCube;

LatticeInterior interiorOf(const SurfaceMesh& surface, const SizeField& field) {
  Job<LatticeInterior> job(
      [&](Work& work) { return makeLatticeInterior(work, surface, field, 0); });
  while (!job.advance(1000)) {
  }
  return job.take();
}

/// A given surface with a uniform size, filled with or without lattices.
MeshRun filled(const SurfaceMesh& surface, double size, Interior interior,
               std::uint32_t budget = 4096) {
  MeshOptions options;
  options.size = size;
  options.interior = interior;
  MeshRun run(surface.points, surface.triangles, options);
  while (run.advance(budget) == MeshStatus::kRunning) {
  }
  return run;
}

/// The core as arrays: its nodes follow those of the other parts.
struct Core {
  std::vector<Vec3> points;  ///< of all parts
  std::vector<NodeQuad> elements;
};

Core coreOf(const LatticeInterior& lattice) {
  Core core{lattice.points, {}};
  for (std::uint32_t node = 0; node < lattice.core->nodeCount(); ++node) {
    core.points.push_back(lattice.core->positionOf(node));
  }
  std::vector<ElementSource::Element> made(lattice.core->elementCount());
  lattice.core->copyElements(0, made);
  for (ElementSource::Element& element : made) {
    for (std::size_t k = 0; k < 4; ++k) {
      NodeId& node = element.nodes[k];
      if (node.value >= lattice.fixed) {
        node = NodeId(node.value - lattice.fixed + lattice.points.size());
      }
      EXPECT_EQ(element.corners[k], core.points[node.index()]);
    }
    core.elements.push_back(element.nodes);
  }
  return core;
}

std::array<Vec3, 4> cornersOf(const std::vector<Vec3>& points, const NodeQuad& nodes) {
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = points[nodes[k].index()];
  return corners;
}

double volumeOf(const std::array<Vec3, 4>& p) {
  return glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) / 6.0;
}

TEST(LatticeElements, AreTwelvePerCube) {
  // Corners and centres of 4 x 3 x 2 cubes. Between two centres along an axis are four tetrahedra.
  LatticeNodes nodes;
  const Lattice lattice(1.0, Vec3(0.0));
  for (std::uint32_t z = 0; z <= 4; ++z) {
    for (std::uint32_t y = z % 2; y <= 6; y += 2) {
      for (std::uint32_t x = z % 2; x <= 8; x += 2) nodes.add({x, y, z});
    }
  }
  EXPECT_EQ(nodes.count(), 5U * 4U * 3U + 4U * 3U * 2U);
  Job<>([&](Work& work) { return nodes.sort(work); }).finish();
  std::set<std::set<NodeId>> seen;
  forEachCentre(nodes, 0, nodes.count(), [&](const CentreNodes& around) {
    const unsigned bits = around.complete();
    for (std::size_t number = 0; number < kElementsPerCentre; ++number) {
      if ((bits >> number & 1U) == 0) continue;
      const NodeQuad quad = around.nodesOf(number);
      EXPECT_TRUE(seen.insert({quad.begin(), quad.end()}).second);
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) {
        p[k] = lattice.positionOf(nodes.placeOf(quad[k]));
        EXPECT_EQ(p[k], lattice.positionOf(
                            placeAt(nodes.placeOf(around.centre), kElementNodes[number][k])));
      }
      EXPECT_DOUBLE_EQ(volumeOf(p), 1.0 / 12.0);
    }
  });
  EXPECT_EQ(seen.size(), 4U * (3U * 3U * 2U + 4U * 2U * 2U + 4U * 3U * 1U));
}

TEST(LatticeInterior, IsConformingAndDeepInside) {
  for (const SurfaceMesh& surface : {geodesicSphere(10), gridCube(14)}) {
    const double size = 0.09;
    const LatticeInterior lattice = interiorOf(surface, SizeField::uniform(size));
    ASSERT_FALSE(lattice.isEmpty());
    const Core core = coreOf(lattice);
    ASSERT_GT(core.elements.size(), 0U);

    // Each face of an element is one of two, or on the hull.
    std::map<std::set<NodeId>, int> faces;
    double volume = 0.0;
    const auto visit = [&](const NodeQuad& nodes) {
      volume += volumeOf(cornersOf(core.points, nodes));
      for (std::size_t k = 0; k < 4; ++k) {
        std::set<NodeId> face(nodes.begin(), nodes.end());
        face.erase(nodes[k]);
        ++faces[face];
      }
    };
    for (const NodeQuad& nodes : lattice.rim) visit(nodes);
    for (const NodeQuad& nodes : core.elements) visit(nodes);
    std::size_t single = 0;
    for (const auto& [face, count] : faces) {
      EXPECT_LE(count, 2);
      single += count == 1 ? 1 : 0;
    }
    EXPECT_EQ(single, lattice.hull.size());

    // The hull is closed, faces inward, and encloses the elements (divergence theorem).
    std::map<std::pair<NodeId, NodeId>, int> edges;
    double enclosed = 0.0;
    for (const NodeTriple& nodes : lattice.hull) {
      EXPECT_EQ(faces.count({nodes.begin(), nodes.end()}), 1U);
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = lattice.points[nodes[k].index()];
        ++edges[std::minmax(nodes[k], nodes[(k + 1) % 3])];
        EXPECT_GE(nodes[k].value, lattice.firstOnHull());
        EXPECT_LT(nodes[k].value, lattice.firstInRim());
      }
      enclosed += glm::dot(p[0], glm::cross(p[1], p[2])) / 6.0;
    }
    for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
    EXPECT_NEAR(-enclosed, volume, 1e-10);

    // No node is near the boundary: by a search over all triangles.
    for (const Vec3& point : core.points) {
      double squared = 1.0;
      for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
        const auto at = [&](std::size_t k) {
          return testing::pointOf(surface, surface.triangles[t + k]);
        };
        squared = std::min(squared, squaredDistanceToTriangle(point, at(0), at(1), at(2)));
      }
      EXPECT_GE(std::sqrt(squared), 1.2 * size * (1.0 - 1e-12));
    }
  }
}

TEST(LatticeInterior, PartsShareOnlyFixedNodes) {
  const LatticeInterior lattice = interiorOf(geodesicSphere(10), SizeField::uniform(0.08));
  for (const NodeQuad& nodes : lattice.rim) {
    for (const NodeId node : nodes) EXPECT_LT(node.index(), lattice.points.size());
  }
  for (const NodeQuad& nodes : coreOf(lattice).elements) {
    for (const NodeId node : nodes) {
      EXPECT_TRUE(node.value < lattice.fixed || node.index() >= lattice.points.size());
    }
  }
}

TEST(LatticeInterior, IsEmptyInThinAndCoarseBodies) {
  EXPECT_TRUE(interiorOf(testing::thinPlate(20, 0.05), SizeField::uniform(0.05)).isEmpty());
  EXPECT_TRUE(interiorOf(geodesicSphere(4), SizeField::uniform(0.4)).isEmpty());
}

/// In the plate, sizes are larger than wherever a cube fits: it has no class of sizes, and is not searched at the smallest one.
TEST(LatticeInterior, IsSoonFoundBesideAThinCoarseBody) {
  SurfaceMesh surface = gridCube(20);
  testing::append(surface, testing::gridBox({1000, 0, 0}, {3000, 2000, 1}, {4, 4, 1}));
  constexpr double kExtent = 1e4;
  BackgroundGrid grid;
  grid.nodes = {{.position = Vec3(-1.0), .size = 0.03},
                {.position = Vec3(kExtent, -1, -1), .size = 20.0},
                {.position = Vec3(-1, kExtent, -1), .size = 20.0},
                {.position = Vec3(-1, -1, kExtent), .size = 20.0}};
  grid.tetrahedra = {{0, 1, 2, 3}};
  const LatticeInterior lattice = interiorOf(surface, SizeField::fromGrid(GridLocator(grid)));
  EXPECT_FALSE(lattice.isEmpty());
  for (const Vec3& point : lattice.points) EXPECT_LT(point.x, 1.0);
}

struct LatticeCase {
  const char* name;
  SurfaceMesh surface;
  double size;
};

class WithLattice : public ::testing::TestWithParam<LatticeCase> {};

TEST_P(WithLattice, MeshesAreValidAndWellShaped) {
  const auto& [name, surface, size] = GetParam();
  const MeshRun run = filled(surface, size, Interior::kLattice);
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  const auto count = static_cast<double>(run.volume().tetrahedra.size() / 4);
  EXPECT_GT(run.latticeCount(), count / 5);
  const MeshRun front = filled(surface, size, Interior::kFront);
  EXPECT_GT(run.quality().minDihedral, 29.0);
  EXPECT_LT(run.quality().maxDihedral, 137.0);
  EXPECT_GT(run.quality().meanRadiusRatio, front.quality().meanRadiusRatio);
  EXPECT_EQ(front.latticeCount(), 0U);
}

TEST_P(WithLattice, TheLengthOfSlicesDoesNotMatter) {
  const auto& [name, surface, size] = GetParam();
  EXPECT_EQ(filled(surface, size, Interior::kLattice, 300).fingerprint(),
            filled(surface, size, Interior::kLattice, 1'000'000).fingerprint());
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, WithLattice,
    ::testing::Values(LatticeCase{"sphere", geodesicSphere(12), 0.093},
                      LatticeCase{"cube", gridCube(12), 1.0 / 12},
                      LatticeCase{"cavity", cubeWithSphericalCavity(18, 6), 1.0 / 18},
                      LatticeCase{"regions", dividedBox({2, 1, 1}, 10), 1.0 / 10}),
    [](const auto& tested) { return tested.param.name; });

TEST(WithLattices, CountsAreThoseOfTheFront) {
  const SurfaceMesh sphere = geodesicSphere(13);
  const auto countOf = [&](Interior interior) {
    return static_cast<double>(filled(sphere, 0.098, interior).volume().tetrahedra.size() / 4);
  };
  const double withFront = countOf(Interior::kFront);
  EXPECT_NEAR(countOf(Interior::kLattice) / withFront, 1.0, 0.05);
}

TEST(WithLattices, AreTheDefaultInLargeMeshesOnly) {
  const MeshRun small = filled(geodesicSphere(7), 0.2, MeshOptions().interior);
  EXPECT_LT(small.volume().tetrahedra.size() / 4, std::size_t{9'000});
  EXPECT_EQ(small.latticeCount(), 0U);
  const MeshRun large = filled(geodesicSphere(14), 0.08, MeshOptions().interior);
  EXPECT_GT(large.latticeCount(), 10'000U);
}

/// Sizes grow away from one corner, then stay: lattices of several sizes, which keep away from each other.
TEST(WithLattices, GradedSizesMakeSeveralIslands) {
  const SurfaceMesh cube = gridCube(20);
  BackgroundGrid grid;
  SizeSource corner;
  corner.size = 1.0 / 20.0;
  corner.distance = 0.9;
  corner.growth = 0.2;
  grid.sources.push_back(corner);
  MeshOptions options;
  options.interior = Interior::kLattice;
  options.size = 0.066;
  MeshRun run(cube.points, cube.triangles, grid, options);
  while (run.advance(4096) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  EXPECT_GT(run.latticeCount(), 0U);
  EXPECT_GT(run.quality().minDihedral, 28.0);
}

/// The mesh in parts is the one in arrays, and lists in many passes give the same statistics and the same verdict as lists in one.
TEST_P(WithLattice, PartsOfTheMeshAreThoseOfItsArrays) {
  const auto& [name, surface, size] = GetParam();
  const MeshRun run = filled(surface, size, Interior::kLattice);
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  std::vector<double> points;
  std::vector<std::uint32_t> tetrahedra;
  for (std::uint32_t first = 0; first < run.nodeCount(); first += 501) {
    const std::vector<double> part = run.points(first, first + 501);
    points.insert(points.end(), part.begin(), part.end());
  }
  for (std::uint32_t first = 0; first < run.tetrahedronCount(); first += 1237) {
    const std::vector<std::uint32_t> part = run.tetrahedra(first, first + 1237);
    tetrahedra.insert(tetrahedra.end(), part.begin(), part.end());
  }
  const std::vector<std::uint32_t> runs = run.regionRuns();
  std::vector<std::uint32_t> regions;
  for (std::size_t i = 0; i < runs.size(); i += 2) {
    regions.insert(regions.end(), runs[i + 1], runs[i]);
  }
  const VolumeMesh& whole = run.volume();
  EXPECT_EQ(points, whole.points);
  EXPECT_EQ(tetrahedra, whole.tetrahedra);
  EXPECT_EQ(regions, whole.regions);

  const SizeField field = SizeField::uniform(size);
  QualityAnalysis inOnePass(whole, run.surface(), field);
  QualityAnalysis inPasses(whole, run.surface(), field, 1000);
  finish(inOnePass);
  finish(inPasses);
  EXPECT_EQ(inPasses.statistics().meanEdge, inOnePass.statistics().meanEdge);
  EXPECT_EQ(inPasses.statistics().edgesNearTarget, inOnePass.statistics().edgesNearTarget);
  for (std::size_t r = 0; r < inOnePass.statistics().regions.size(); ++r) {
    EXPECT_EQ(inPasses.statistics().regions[r].edge, inOnePass.statistics().regions[r].edge);
  }
  MeshVerifier verifier(whole, run.surface(), 1000);
  finish(verifier);
  EXPECT_EQ(verifier.defects().count(), 0U);
}

TEST(WithLattices, VerificationInPassesFindsAMissingElement) {
  const MeshRun run = filled(geodesicSphere(12), 0.093, Interior::kLattice);
  VolumeMesh mesh = run.volume();
  const auto last = mesh.tetrahedra.size() / 4 - 1;
  mesh.tetrahedra.resize(4 * last);
  mesh.regions.resize(last);
  MeshVerifier verifier(mesh, run.surface(), 1000);
  finish(verifier);
  EXPECT_EQ(verifier.defects().extraBoundaryFaces, 4U);
  EXPECT_EQ(verifier.defects().wrongVolume, 1U);
}

TEST(WithLattices, AMeshDuringTheRunIsValidToo) {
  const SurfaceMesh box = dividedBox({2, 1, 1}, 10);
  MeshOptions options;
  options.size = 0.1;
  options.interior = Interior::kLattice;
  MeshRun run(box.points, box.triangles, options);
  while (run.advance(4096) == MeshStatus::kRunning) {
    const VolumeMesh& mesh = run.volume();
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t node = mesh.tetrahedra[t + k];
        ASSERT_LT(3 * node, mesh.points.size());
        p[k] = {mesh.points[3 * node], mesh.points[3 * node + 1], mesh.points[3 * node + 2]};
      }
      ASSERT_GT(volumeOf(p), 0.0);
    }
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
}

}  // namespace
}  // namespace tetrafront
