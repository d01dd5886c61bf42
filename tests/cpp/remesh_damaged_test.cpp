/// @file Randomly damaged surfaces, groups, sources and options: a remeshing must end, with a valid surface or with a
/// diagnostic. TETRAFRONT_SEEDS=FIRST:COUNT selects other seeds.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "boundary/boundary.h"
#include "geom/intersect.h"
#include "support/damage.h"
#include "support/hard_shapes.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/diagnostic_values.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront::testing {
namespace {

struct DamagedInput {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> groups;
  BackgroundGrid grid;
  RemeshOptions options;
  bool isStopped = false;  ///< after some slices
};

SurfaceMesh smallBody(std::uint64_t seed) {
  switch (seed % 12) {
    case 0:
      return gridCube(1);
    case 1:
      return gridCube(2, Diagonals::kRandom, seed);
    case 2:
      return geodesicSphere(2);
    case 3:
      return coarseTube(8, 0.6, 2.0);
    case 4:
      return needlePlate(1, 12, 0.1);
    case 5:
      return cubesSharingEdge();
    case 6:
      return cubesSharingNode();
    case 7:
      return dividedBox({2, 1, 1}, 1);
    case 8:
      return cubeWithCubicCavity(1, 1);
    case 9:
      return thinPlate(2, 0.01);
    case 10:
      return wedge(5.0, 1);
    default:
      return torus(1.0, 0.4, 8, 6);
  }
}

void damageNode(Random& random, SurfaceMesh& mesh) {
  const std::size_t node = random.bits() % nodeCount(mesh);
  const auto move = [&](const Vec3& by) {
    for (std::size_t k = 0; k < 3; ++k) mesh.points[3 * node + k] += by[static_cast<int>(k)];
  };
  switch (random.integer(0, 5)) {
    case 0:
      mesh.points[3 * node + random.bits() % 3] = wildNumber(random);
      break;
    case 1:
      move(random.inBox(0.5));
      break;
    case 2:
      move(random.inBox(0.01));
      break;
    case 3:
      move(random.inBox(1e-13));
      break;
    case 4: {
      const Vec3 onto = pointOf(mesh, static_cast<std::uint32_t>(random.bits() % nodeCount(mesh)));
      for (std::size_t k = 0; k < 3; ++k) mesh.points[3 * node + k] = onto[static_cast<int>(k)];
      break;
    }
    default: {
      // All triangles at the node use another one.
      const auto other = static_cast<std::uint32_t>(random.bits() % nodeCount(mesh));
      std::ranges::replace(mesh.triangles, static_cast<std::uint32_t>(node), other);
      break;
    }
  }
}

void damageTriangle(Random& random, SurfaceMesh& mesh) {
  if (mesh.triangles.empty()) return;
  const std::size_t first = 3 * (random.bits() % (mesh.triangles.size() / 3));
  const auto begin = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first);
  switch (random.integer(0, 4)) {
    case 0:
      mesh.triangles.erase(begin, begin + 3);
      break;
    case 1: {
      const std::array<std::uint32_t, 3> copy{begin[0], begin[1], begin[2]};
      mesh.triangles.insert(mesh.triangles.end(), copy.begin(), copy.end());
      break;
    }
    case 2:
      std::swap(begin[0], begin[1]);
      break;
    case 3:
      any(random, mesh.triangles) =
          random.coin() ? 0xffffffffU
                        : static_cast<std::uint32_t>(random.bits() % (nodeCount(mesh) + 2));
      break;
    default:
      turnInsideOut(mesh);
      break;
  }
}

/// Changes that leave the surface valid, unless numbers overflow.
void changeWhole(Random& random, SurfaceMesh& mesh) {
  constexpr std::array<double, 6> kFactors{1e-200, 1e-20, 1e-3, 1e5, 1e25, 1e200};
  switch (random.integer(0, 3)) {
    case 0:
      scale(mesh, kFactors.at(random.bits() % kFactors.size()));
      break;
    case 1:
      stretch(mesh, {1.0, 1.0, random.coin() ? 1e-3 : 1e-7});
      break;
    case 2:
      translate(mesh, random.inBox(random.coin() ? 1e6 : 1e14));
      break;
    default:
      append(mesh, SurfaceMesh(mesh));
      translate(mesh, random.inBox());
      break;
  }
}

void chooseOptions(Random& random, DamagedInput& input) {
  RemeshOptions& options = input.options;
  const std::array<double RemeshOptions::*, 9> fields{
      &RemeshOptions::size,      &RemeshOptions::minSize,      &RemeshOptions::maxSize,
      &RemeshOptions::tolerance, &RemeshOptions::featureAngle, &RemeshOptions::anglePerEdge,
      &RemeshOptions::layers,    &RemeshOptions::dropDetails,  &RemeshOptions::growth};
  constexpr std::array<double, 7> kPlausible{1e-3, 0.05, 0.3, 1.0, 2.0, 30.0, 170.0};
  for (int count = random.integer(0, 3); count > 0; --count) {
    double& value = options.*fields.at(random.bits() % fields.size());
    value = random.integer(0, 5) == 0 ? wildNumber(random)
                                      : kPlausible.at(random.bits() % kPlausible.size());
  }
  options.innerShells = random.coin() ? InnerShells::kRegions : InnerShells::kCavities;
}

DamagedInput damagedInput(std::uint64_t seed) {
  Random random(seed);
  DamagedInput input;
  input.mesh = smallBody(random.bits());
  for (int damage = random.integer(0, 2); damage > 0; --damage) {
    switch (random.integer(0, 5)) {
      case 0:
      case 1:
        damageNode(random, input.mesh);
        break;
      case 2:
      case 3:
        damageTriangle(random, input.mesh);
        break;
      default:
        changeWhole(random, input.mesh);
        break;
    }
  }
  // Large sizes keep a run short.
  Vec3 low(INFINITY);
  Vec3 high(-INFINITY);
  for (std::uint32_t node = 0; node < nodeCount(input.mesh); ++node) {
    low = glm::min(low, pointOf(input.mesh, node));
    high = glm::max(high, pointOf(input.mesh, node));
  }
  const double diagonal = glm::length(high - low);
  input.options.maxTriangles = 1000;
  if (diagonal > 1e-30 && diagonal < 1e29) {
    input.options.maxSize = diagonal / 4.0;
    input.options.minSize = diagonal / 12.0;
  }
  chooseOptions(random, input);
  if (random.coin()) {
    for (std::size_t t = 0; t < triangleCount(input.mesh); ++t) {
      input.groups.push_back(random.coin() ? 0 : static_cast<std::uint32_t>(random.bits()));
    }
  }
  if (random.integer(0, 4) == 0) input.grid.sources.push_back(wildSource(random));
  input.isStopped = random.integer(0, 9) == 0;
  return input;
}

/// Returns what is wrong with the result, or an empty string.
std::string complaintAboutRemesh(const DamagedInput& input, const SurfaceRemesh& result) {
  for (const Diagnostic& each : result.diagnostics) {
    const DiagnosticValues expected = valuesOf(each.code);
    if (each.values.size() < expected.required() || each.values.size() > expected.size()) {
      return "number of values of code " + std::to_string(static_cast<int>(each.code));
    }
  }
  if (anyError(result.diagnostics)) return result.triangles.empty() ? "" : "triangles and an error";
  if (result.triangles.empty()) return "neither triangles nor an error";
  if (!std::ranges::all_of(result.points, [](double x) { return std::isfinite(x); })) {
    return "not finite";
  }
  if (!(result.deviation >= 0.0) || !std::isfinite(result.deviation)) return "deviation";
  if (result.origin.size() != result.triangles.size() / 3) return "origin";
  for (const std::uint32_t origin : result.origin) {
    if (origin >= triangleCount(input.mesh)) return "origin out of range";
  }
  SurfaceMesh made;
  made.points = result.points;
  made.triangles = result.triangles;
  for (const std::uint32_t node : made.triangles) {
    if (node >= nodeCount(made)) return "index out of range";
  }
  // All pairs.
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    for (const TriangleId u : IdRange<TriangleId>(t.value)) {
      if (intersectImproperly(numberedTriangle(made, t), numberedTriangle(made, u))) {
        return "self-intersection";
      }
    }
  }
  std::vector<Diagnostic> found;
  closeBoundary(made, BoundarySource::kGivenSurface, found, input.options.innerShells);
  for (const Diagnostic& each : found) {
    if (each.severity == Severity::kError) {
      return "boundary: code " + std::to_string(static_cast<int>(each.code));
    }
  }
  return "";
}

std::pair<std::uint64_t, std::uint64_t> chosenSeeds() {
  unsigned long long first = 0;
  unsigned long long count = 50;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread changes the environment.
  const char* chosen = std::getenv("TETRAFRONT_SEEDS");
  if (chosen != nullptr) std::sscanf(chosen, "%llu:%llu", &first, &count);
  return {first, count};
}

TEST(DamagedRemesh, EndsWithAValidSurfaceOrADiagnostic) {
  // A run of that many triangles takes some tens of slices.
  constexpr int kMaxSlices = 20'000;
  const auto [first, count] = chosenSeeds();
  std::uint64_t remeshed = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const DamagedInput input = damagedInput(seed);
    SurfaceRemesher remesher(input.mesh.points, input.mesh.triangles, input.groups, input.grid,
                             input.options);
    int slices = 0;
    while (slices < kMaxSlices && !remesher.advance(1000)) {
      if (++slices == 3 && input.isStopped) remesher.stop();
    }
    ASSERT_LT(slices, kMaxSlices) << "seed " << seed;
    EXPECT_EQ(complaintAboutRemesh(input, remesher.result()), "") << "seed " << seed;
    if (!anyError(remesher.result().diagnostics)) ++remeshed;
  }
  EXPECT_GT(remeshed, count / 5) << "some damage is harmless";
  EXPECT_LT(remeshed, count * 4 / 5);
}

}  // namespace
}  // namespace tetrafront::testing
