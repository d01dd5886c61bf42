/// Families of solids that are hard to mesh, with seeded variations at three sizes. A default run
/// must give a complete and valid mesh, and so must the exact fill alone.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "support/hard_shapes.h"
#include "support/mesh_validator.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/stored_fingerprints.h"
#include "tetrafront/mesher.h"

namespace tetrafront {
namespace {

using testing::Diagonals;

/// `size` is 0, 1 or 2; the seed selects a variation.
struct Family {
  std::string name;
  int solids;  ///< per size
  std::function<SurfaceMesh(int size, std::uint64_t seed)> make;
};
void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

double between(std::uint64_t seed, double low, double high) {
  testing::Random random(seed * 7919 + 1);
  return random.between(low, high);
}

int oneOf(int size, std::array<int, 3> values) { return values.at(static_cast<std::size_t>(size)); }

/// Returns the solid rotated, mirrored, scaled or translated; it must be meshed equally well.
SurfaceMesh transformed(SurfaceMesh surface, std::uint64_t seed) {
  testing::rotateRandomly(surface, seed);
  if (seed % 3 == 0) testing::mirror(surface);
  if (seed % 4 == 1) testing::scale(surface, 1e-9);
  if (seed % 4 == 2) testing::scale(surface, 1e9);
  if (seed % 4 == 3) testing::translate(surface, Vec3(1e6, -2e6, 5e5));
  return surface;
}

class Regression : public ::testing::TestWithParam<Family> {};

MeshRun finishedRun(const SurfaceMesh& surface, const MeshOptions& options) {
  MeshRun run(surface.points, surface.triangles, options);
  while (run.advance(5000) == MeshStatus::kRunning) {
  }
  return run;
}

std::string complaintAboutRun(const MeshRun& run) {
  if (run.status() != MeshStatus::kDone) return "not done";
  return testing::complaintAbout(run.volume(), run.surface());
}

TEST_P(Regression, IsMeshedCompletely) {
  const Family& family = GetParam();
  for (int size = 0; size < 3; ++size) {
    // The largest solids take most of the time, so only every second variation of them is meshed.
    for (int i = 0; i < family.solids; i += size == 2 ? 2 : 1) {
      const auto seed = static_cast<std::uint64_t>(100 * size + i + 1);
      const SurfaceMesh surface = family.make(size, seed);
      const MeshRun run = finishedRun(surface, {});
      EXPECT_EQ(complaintAboutRun(run), "") << "size " << size << ", seed " << seed;
      const std::string name = family.name + "-" + std::to_string(size) + "-" + std::to_string(i);
      testing::expectStoredFingerprint(name, surface, run.fingerprint());
    }
  }
}

TEST_P(Regression, IsFilledByTheExactFillAlone) {
  const Family& family = GetParam();
  MeshOptions options;
  options.exactFillOnly = true;
  options.optimization = Optimization::kNone;
  for (int size = 0; size < 3; ++size) {
    const auto seed = static_cast<std::uint64_t>(100 * size + 1);
    const MeshRun run = finishedRun(family.make(size, seed), options);
    EXPECT_EQ(complaintAboutRun(run), "") << "size " << size;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Mesher, Regression,
    ::testing::Values(
        Family{"schoenhardt", 10,
               [](int size, std::uint64_t seed) {
                 return testing::schoenhardtTower(oneOf(size, {1, 3, 8}),
                                                  between(seed, 25.0, 59.99));
               }},
        Family{"schoenhardtPairs", 4,
               [](int size, std::uint64_t seed) {
                 return transformed(testing::schoenhardtPair(oneOf(size, {30, 50, 59})), seed);
               }},
        Family{"schoenhardtCavities", 2,
               [](int size, std::uint64_t seed) {
                 return testing::schoenhardtCavities(oneOf(size, {1, 2, 4}),
                                                     between(seed, 30.0, 55.0));
               }},
        Family{"chazelle", 2,
               [](int size, std::uint64_t seed) {
                 return testing::chazellePolyhedron(oneOf(size, {1, 3, 5}),
                                                    between(seed, 0.01, 0.3));
               }},
        Family{"saddles", 5,
               [](int size, std::uint64_t seed) {
                 return transformed(
                     testing::saddleSlab(oneOf(size, {2, 3, 5}), between(seed, 0.05, 0.6)), seed);
               }},
        Family{"wedges", 6,
               [](int size, std::uint64_t seed) {
                 constexpr std::array<double, 6> kDegrees{2.0, 0.5, 0.1, 0.01, 1e-4, 1e-6};
                 return testing::wedge(kDegrees.at(seed % 6), oneOf(size, {1, 2, 5}));
               }},
        Family{"slits", 6,
               [](int size, std::uint64_t seed) {
                 constexpr std::array<double, 6> kDegrees{2.0, 0.5, 0.1, 0.01, 1e-4, 1e-6};
                 return testing::slitBlock(kDegrees.at(seed % 6), oneOf(size, {1, 2, 4}));
               }},
        Family{"spikes", 14,
               [](int size, std::uint64_t seed) {
                 return testing::spikySphere(oneOf(size, {1, 2, 3}), 0.15, seed);
               }},
        Family{"bars", 3,
               [](int size, std::uint64_t seed) {
                 return transformed(
                     testing::coarseBar(oneOf(size, {8, 16, 32}), between(seed, 1.0, 1000.0)),
                     seed);
               }},
        Family{"tubes", 3,
               [](int size, std::uint64_t seed) {
                 return testing::coarseTube(oneOf(size, {8, 16, 32}), between(seed, 0.5, 0.97),
                                            between(seed + 7, 1.0, 1000.0));
               }},
        Family{"finePatches", 1,
               [](int size, std::uint64_t) {
                 return testing::cubeWithFinePatch(oneOf(size, {3, 6, 12}));
               }},
        Family{"graded", 2,
               [](int size, std::uint64_t seed) {
                 return testing::gradedCube(oneOf(size, {2, 3, 5}), seed % 2 == 0 ? 2 : 4);
               }},
        Family{"blocks", 14,
               [](int size, std::uint64_t seed) {
                 return testing::randomBlocks(oneOf(size, {2, 3, 4}), 0.5, seed);
               }},
        Family{"cubes", 6,
               [](int size, std::uint64_t seed) {
                 constexpr std::array<Diagonals, 4> kKinds{Diagonals::kParallel,
                                                           Diagonals::kAlternating,
                                                           Diagonals::kUnionJack,
                                                           Diagonals::kRandom};
                 return testing::gridCube(oneOf(size, {2, 3, 6}), kKinds.at(seed % 4), seed);
               }},
        Family{"movedCubes", 4,
               [](int size, std::uint64_t seed) {
                 return transformed(testing::gridCube(oneOf(size, {1, 2, 4}), Diagonals::kRandom,
                                                      seed),
                                    seed);
               }},
        Family{"plates", 3,
               [](int size, std::uint64_t seed) {
                 return testing::thinPlate(oneOf(size, {2, 4, 8}), between(seed, 0.001, 0.05));
               }},
        Family{"islands", 1,
               [](int size, std::uint64_t) {
                 return testing::blockWithIsland(oneOf(size, {1, 2, 4}));
               }},
        Family{"shells", 3,
               [](int size, std::uint64_t seed) {
                 return transformed(testing::nestedSpheres(3, oneOf(size, {1, 2, 3})), seed);
               }},
        Family{"turned", 4,
               [](int size, std::uint64_t seed) {
                 // Shoulders, cones and flat rings of very different sizes.
                 testing::Random random(seed);
                 std::vector<Vec2> profile;
                 double height = 0.0;
                 for (int i = 0; i < oneOf(size, {2, 3, 4}); ++i) {
                   const double radius = random.between(0.02, 1.0);
                   profile.emplace_back(radius, height);
                   if (i % 2 == 1) profile.emplace_back(radius * random.between(0.3, 0.9), height);
                   height += i % 2 == 0 ? random.between(0.001, 0.01) : random.between(0.1, 1.0);
                   profile.emplace_back(random.between(0.02, 1.0), height);
                   height += 0.001;
                 }
                 return testing::solidOfRevolution(profile, oneOf(size, {8, 24, 48}), seed);
               }},
        Family{"lofts", 4,
               [](int size, std::uint64_t seed) {
                 const int many = oneOf(size, {12, 60, 150});
                 return testing::loft(seed % 2 == 0 ? many : 3, seed % 2 == 0 ? 5 : many,
                                      between(seed, 0.001, 3.0), between(seed + 7, 0.01, 1.0));
               }},
        Family{"combs", 4,
               [](int size, std::uint64_t seed) {
                 constexpr std::array<double, 4> kGaps{0.1, 1e-3, 1e-5, 1e-7};
                 return transformed(
                     testing::extruded(testing::combOutline(oneOf(size, {3, 8, 20}), 0.1,
                                                            kGaps.at(seed % 4), 10.0),
                                       between(seed, 0.01, 10.0), 1, seed),
                     seed);
               }},
        Family{"distantBlocks", 3,
               [](int size, std::uint64_t seed) {
                 constexpr std::array<int, 3> kSteps{3, 8, 12};
                 return testing::distantBlocks(oneOf(size, {2, 3, 3}), kSteps.at(seed % 3), seed);
               }},
        Family{"knots", 3,
               [](int size, std::uint64_t seed) {
                 return testing::torusKnot(2, seed % 2 == 0 ? 3 : 5, oneOf(size, {60, 80, 100}),
                                           oneOf(size, {3, 4, 5}));
               }},
        Family{"tori", 4,
               [](int size, std::uint64_t seed) {
                 return transformed(testing::torus(1.0, between(seed, 0.1, 0.5),
                                                   oneOf(size, {8, 16, 24}),
                                                   oneOf(size, {4, 6, 8})),
                                    seed);
               }},
        Family{"needleSpheres", 2,
               [](int size, std::uint64_t seed) {
                 return transformed(testing::latitudeSphere(oneOf(size, {4, 6, 8}),
                                                            oneOf(size, {12, 24, 48})),
                                    seed);
               }},
        Family{"needlePlates", 3,
               [](int size, std::uint64_t seed) {
                 return transformed(testing::needlePlate(oneOf(size, {1, 2, 3}),
                                                         oneOf(size, {32, 24, 16}), 0.05),
                                    seed);
               }},
        Family{"needleGears", 3,
               [](int size, std::uint64_t seed) {
                 return transformed(
                     testing::needleGear(oneOf(size, {6, 12, 24}), between(seed, 0.01, 0.3)), seed);
               }},
        Family{"threads", 2,
               [](int size, std::uint64_t seed) {
                 return transformed(testing::screwThread(oneOf(size, {1, 2, 3}),
                                                         oneOf(size, {8, 12, 16})),
                                    seed);
               }},
        Family{"blades", 3,
               [](int size, std::uint64_t seed) {
                 return transformed(
                     testing::twistedBlade(oneOf(size, {4, 12, 20}), oneOf(size, {4, 6, 10}),
                                           between(seed, 0.002, 0.03)),
                     seed);
               }},
        Family{"bentSheets", 3,
               [](int size, std::uint64_t seed) {
                 return transformed(
                     testing::bentSheet(oneOf(size, {8, 24, 60}), between(seed, 1e-3, 0.03)), seed);
               }},
        Family{"stars", 10,
               [](int size, std::uint64_t seed) {
                 // Jagged prisms over stars with needle-like tips.
                 testing::Random random(seed);
                 std::vector<Vec2> polygon;
                 const int tips = oneOf(size, {3, 6, 10});
                 const SurfaceMesh ring = testing::coarseBar(2 * tips, 1.0);
                 for (int k = 0; k < 2 * tips; ++k) {
                   const Vec3 p = testing::pointOf(ring, static_cast<std::uint32_t>(k));
                   polygon.push_back(Vec2(p.x, p.y) *
                                     (k % 2 == 0 ? 1.0 : random.between(0.1, 0.5)));
                 }
                 return testing::extruded(polygon, random.between(0.1, 3.0), oneOf(size, {1, 2, 4}),
                                          seed);
               }}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace tetrafront
