// Thousands of randomly damaged models: the check, the preview and the run must end, and their
// diagnostics must name the damaged entity.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "support/damage.h"
#include "support/models.h"
#include "tetrafront/diagnostic_values.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"

namespace tetrafront::testing {
namespace {

constexpr int kKinds = 5;

Model validModel(std::uint64_t seed) {
  switch (seed % kKinds) {
    case 0:
      return boxModel({0, 0, 0}, {1, 2, 1.5});
    case 1:
      return randomBentBox(seed, 0.15);
    case 2:
      return randomBentBox(seed, 0.15, PatchType::kSerendipity);
    case 3:
      return randomBentTetrahedron(seed, 0.1, PatchType::kBarnhillGregoryNielson);
    default:
      return randomBentTetrahedron(seed, 0.1, PatchType::kIsoparametricTriangle);
  }
}

void damagePoint(Random& random, Model& model) {
  Vec3& point = any(random, model.points);
  switch (random.integer(0, 4)) {
    case 0:
      point[random.integer(0, 2)] = wildNumber(random);
      break;
    case 1:
      point = any(random, model.points);
      break;
    case 2:
      point += random.inBox(0.5);
      break;
    case 3:
      point += random.inBox(1e-13);
      break;
    default:
      model.points.push_back(point);
      break;
  }
}

void damageLine(Random& random, Model& model) {
  Line& line = any(random, model.lines);
  const auto somePoint = [&] {
    return static_cast<std::uint32_t>(random.bits() % (model.points.size() + 1));
  };
  switch (random.integer(0, 5)) {
    case 0:
      line.type = static_cast<LineType>(random.integer(0, 2));
      break;
    case 1:
      if (!line.points.empty()) any(random, line.points) = somePoint();
      break;
    case 2:
      std::ranges::reverse(line.points);
      break;
    case 3:
      line.points.clear();
      break;
    case 4:
      line.points.insert(line.points.begin() + (line.points.empty() ? 0 : 1), somePoint());
      break;
    default: {
      const Line copy = line;
      model.lines.push_back(copy);
      break;
    }
  }
}

void damagePatch(Random& random, Model& model) {
  Patch& patch = any(random, model.patches);
  const auto someLine = [&] {
    return static_cast<std::uint32_t>(random.bits() % (model.lines.size() + 1));
  };
  if (patch.loops.empty()) patch.loops.emplace_back();
  Loop& loop = patch.loops.front();
  switch (random.integer(0, 8)) {
    case 0:
      patch.type = static_cast<PatchType>(random.integer(0, 4));
      break;
    case 1:
      loop.push_back({someLine(), random.coin()});
      break;
    case 2:
      if (!loop.empty()) any(random, loop).line = someLine();
      break;
    case 3:
      if (!loop.empty()) any(random, loop).reversed = random.coin();
      break;
    case 4:
      for (std::size_t i = loop.size(); i > 1; --i) std::swap(loop[i - 1], loop[random.bits() % i]);
      break;
    case 5:
      patch.loops.push_back(random.coin() ? Loop{} : Loop(loop));
      break;
    case 6:
      loop.clear();
      break;
    case 7:
      model.patches.erase(model.patches.begin() +
                          static_cast<std::ptrdiff_t>(random.bits() % model.patches.size()));
      if (model.patches.empty()) model.patches.emplace_back();
      break;
    default: {
      const Patch copy = patch;
      model.patches.push_back(copy);
      break;
    }
  }
}

void damageGrid(Random& random, BackgroundGrid& grid) {
  BackgroundNode& node = any(random, grid.nodes);
  switch (random.integer(0, 6)) {
    case 0:
      node.size = wildNumber(random);
      break;
    case 1:
      node.position[random.integer(0, 2)] = wildNumber(random);
      break;
    case 2:
      node.stretching = random.coin() ? wildNumber(random) : 7.0;
      node.direction = random.coin() ? random.inBox() : Vec3(0.0);
      break;
    case 3:
      any(random, grid.tetrahedra)[random.bits() % 4] =
          static_cast<std::uint32_t>(random.bits() % 10);
      break;
    case 4:
      node.position = any(random, grid.nodes).position;
      break;
    case 5:
      grid.tetrahedra.pop_back();
      if (grid.tetrahedra.empty()) grid.tetrahedra.push_back({0, 0, 0, 0});
      break;
    default: {
      grid.sources.push_back(wildSource(random));
      break;
    }
  }
}

/// Returns whether errors of this code name entities; other errors concern the whole model.
bool namesEntities(DiagnosticCode code) {
  return code != DiagnosticCode::kEmptyModel && code != DiagnosticCode::kEmptyBackgroundGrid &&
         code != DiagnosticCode::kTooManyElements && code != DiagnosticCode::kOptionOutOfRange &&
         code != DiagnosticCode::kSizeTooLarge && code != DiagnosticCode::kStalled;
}

std::size_t countOf(EntityKind kind, const Model& model, const BackgroundGrid& grid) {
  switch (kind) {
    case EntityKind::kPoint:
      return model.points.size();
    case EntityKind::kLine:
      return model.lines.size();
    case EntityKind::kPatch:
      return model.patches.size();
    case EntityKind::kBackgroundNode:
      return grid.nodes.size();
    case EntityKind::kBackgroundTetrahedron:
      return grid.tetrahedra.size();
    case EntityKind::kSource:
      return grid.sources.size();
    case EntityKind::kTriangle:
    case EntityKind::kSurfaceNode:
    case EntityKind::kNode:
    case EntityKind::kTetrahedron:
      break;
  }
  return std::numeric_limits<std::size_t>::max();
}

void expectNamed(const std::vector<Diagnostic>& diagnostics, const Model& model,
                 const BackgroundGrid& grid, std::uint64_t seed) {
  for (const Diagnostic& diagnostic : diagnostics) {
    EXPECT_NE(diagnostic.code, DiagnosticCode::kVerificationFailed) << "seed " << seed;
    const DiagnosticValues named = valuesOf(diagnostic.code);
    EXPECT_GE(diagnostic.values.size(), named.required())
        << "seed " << seed << ", code " << static_cast<int>(diagnostic.code);
    EXPECT_LE(diagnostic.values.size(), named.size())
        << "seed " << seed << ", code " << static_cast<int>(diagnostic.code);
    if (diagnostic.severity == Severity::kError && namesEntities(diagnostic.code)) {
      EXPECT_FALSE(diagnostic.entities.empty())
          << "seed " << seed << ", code " << static_cast<int>(diagnostic.code);
    }
    for (const Entity& entity : diagnostic.entities)
      EXPECT_LT(entity.index, countOf(entity.kind, model, grid))
          << "seed " << seed << ", code " << static_cast<int>(diagnostic.code);
    if (diagnostic.hasPosition) {
      EXPECT_TRUE(
          std::isfinite(diagnostic.position.x + diagnostic.position.y + diagnostic.position.z))
          << "seed " << seed << ", code " << static_cast<int>(diagnostic.code);
    }
  }
}

bool anyError(const std::vector<Diagnostic>& diagnostics) {
  return std::ranges::any_of(diagnostics, [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::kError;
  });
}

struct Damaged {
  Model model;
  BackgroundGrid grid;
};

Damaged damaged(std::uint64_t seed) {
  Random random(seed);
  Damaged result{validModel(seed), boxGrid(Vec3(-3.0), Vec3(4.0), [](const Vec3&) { return 0.6; })};
  for (int damage = random.integer(1, 3); damage > 0; --damage) {
    switch (random.integer(0, 6)) {
      case 0:
      case 1:
        damagePoint(random, result.model);
        break;
      case 2:
      case 3:
        damageLine(random, result.model);
        break;
      case 4:
      case 5:
        damagePatch(random, result.model);
        break;
      default:
        damageGrid(random, result.grid);
        break;
    }
  }
  return result;
}

TEST(DamagedModels, ThePreviewNamesTheDamage) {
  constexpr std::uint64_t kModels = 250;
  int accepted = 0;
  for (std::uint64_t seed = 0; seed < kModels; ++seed) {
    const Damaged input = damaged(seed);
    const ModelPreview preview = previewModel(input.model, input.grid);
    expectNamed(preview.diagnostics, input.model, input.grid, seed);
    for (const double coordinate : preview.patchPoints)
      ASSERT_TRUE(std::isfinite(coordinate)) << "seed " << seed;
    if (!anyError(preview.diagnostics)) ++accepted;
  }
  EXPECT_GT(accepted, 10) << "some damage is harmless";
  EXPECT_LT(accepted, static_cast<int>(kModels) / 2);
}

TEST(DamagedModels, RunsEndWithAMeshOrANamedProblem) {
  // Coarse meshes take some tens of slices. A run that takes more than this would never end.
  constexpr int kMaxSlices = 2000;
  constexpr std::uint32_t kBudget = 500;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Damaged input = damaged(7919 * seed);
    MeshOptions options;
    options.maxTetrahedra = 20'000;
    options.optimization = Optimization::kNone;
    MeshRun run(input.model, input.grid, options);
    int slices = 0;
    while (run.advance(kBudget) == MeshStatus::kRunning && slices < kMaxSlices) ++slices;
    ASSERT_LT(slices, kMaxSlices) << "seed " << seed;
    expectNamed(run.diagnostics(), input.model, input.grid, seed);
    EXPECT_EQ(run.status() == MeshStatus::kDone, !anyError(run.diagnostics())) << "seed " << seed;
  }
}

}  // namespace
}  // namespace tetrafront::testing
