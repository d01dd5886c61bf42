// The preview of a model before it is meshed, also of an invalid model.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/check_model.h"
#include "support/models.h"
#include "support/random.h"
#include "tetrafront/preview.h"

namespace tetrafront::testing {
namespace {

BackgroundGrid grid() {
  return boxGrid({-5, -5, -5}, {5, 5, 5}, [](const Vec3&) { return 0.5; });
}

Vec3 patchPoint(const ModelPreview& preview, std::uint32_t point) {
  return {preview.patchPoints[3 * std::size_t{point}],
          preview.patchPoints[3 * std::size_t{point} + 1],
          preview.patchPoints[3 * std::size_t{point} + 2]};
}

double areaOf(const ModelPreview& preview, std::size_t patch) {
  double area = 0.0;
  for (std::uint32_t t = preview.patchOffsets[patch]; t < preview.patchOffsets[patch + 1]; ++t) {
    const auto corner = [&](std::size_t k) {
      return patchPoint(preview, preview.patchTriangles[3 * std::size_t{t} + k]);
    };
    area += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  return area;
}

void expectConsistent(const ModelPreview& preview, const Model& model) {
  ASSERT_EQ(preview.lineOffsets.size(), model.lines.size() + 1);
  ASSERT_EQ(preview.patchOffsets.size(), model.patches.size() + 1);
  EXPECT_EQ(3 * std::size_t{preview.lineOffsets.back()}, preview.linePoints.size());
  EXPECT_EQ(3 * std::size_t{preview.patchOffsets.back()}, preview.patchTriangles.size());
  for (const std::uint32_t point : preview.patchTriangles)
    ASSERT_LT(3 * std::size_t{point} + 2, preview.patchPoints.size());
  for (const double coordinate : preview.patchPoints) ASSERT_TRUE(std::isfinite(coordinate));
  for (const double coordinate : preview.linePoints) ASSERT_TRUE(std::isfinite(coordinate));
}

TEST(SurfacePreview, PlanarPatchesAreCoveredExactly) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    double area = 0.0;
    const Model model = randomPolygonModel(seed, area);
    const ModelPreview preview = previewModel(model, grid());
    expectConsistent(preview, model);
    for (const Diagnostic& diagnostic : preview.diagnostics)
      EXPECT_EQ(diagnostic.code, DiagnosticCode::kOpenEdge) << "one patch closes nothing";
    EXPECT_NEAR(areaOf(preview, 0), area, 1e-12 * area) << seed;
    EXPECT_LT(preview.patchTriangles.size() / 3, 1000U) << seed;
  }
}

TEST(SurfacePreview, LinesRunFromEndToEnd) {
  const Model model = randomCoonsModel(3, 0.2);
  const ModelPreview preview = previewModel(model, grid());
  expectConsistent(preview, model);
  for (std::size_t line = 0; line < model.lines.size(); ++line) {
    const std::size_t last = preview.lineOffsets[line + 1] - 1;
    EXPECT_GE(last, std::size_t{preview.lineOffsets[line]} + 1);
    const Vec3& end = model.points[model.lines[line].points.back()];
    const Vec3& start = model.points[model.lines[line].points.front()];
    const Vec3 drawn(preview.linePoints[3 * last], preview.linePoints[3 * last + 1],
                     preview.linePoints[3 * last + 2]);
    EXPECT_TRUE(drawn == end || drawn == start);
  }
  EXPECT_GT(areaOf(preview, 0), 0.3);
}

TEST(SurfacePreview, AnInvalidPatchIsLeftOut) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  model.patches[2].loops.front()[0].line = 500;
  model.patches[4].type = PatchType::kSerendipity;
  const ModelPreview preview = previewModel(model, grid());
  expectConsistent(preview, model);
  for (std::size_t patch = 0; patch < 6; ++patch)
    EXPECT_NEAR(areaOf(preview, patch), patch == 2 || patch == 4 ? 0.0 : 1.0, 1e-12) << patch;
  EXPECT_FALSE(preview.diagnostics.empty());
}

TEST(SurfacePreview, ReportsProblemsOfTheGridToo) {
  BackgroundGrid broken = grid();
  broken.nodes[3].size = -1.0;
  const ModelPreview preview = previewModel(boxModel({0, 0, 0}, {1, 1, 1}), broken);
  ASSERT_FALSE(preview.diagnostics.empty());
  EXPECT_EQ(preview.diagnostics.back().code, DiagnosticCode::kSizeOutOfRange);
}

TEST(SurfacePreview, ReportsOnlyProblemsOfSourcesIfTheSizeIsUniform) {
  const Model box = boxModel({0, 0, 0}, {1, 1, 1});
  BackgroundGrid broken = grid();
  broken.nodes[3].size = -1.0;
  EXPECT_TRUE(previewModel(box, broken, {.size = 0.25}).diagnostics.empty());
  EXPECT_TRUE(previewModel(box, {}, {.size = 0.25}).diagnostics.empty());
  broken.sources.emplace_back();
  const ModelPreview preview = previewModel(box, broken, {.size = 0.25});
  ASSERT_EQ(preview.diagnostics.size(), 1U);
  EXPECT_EQ(preview.diagnostics[0].code, DiagnosticCode::kSourceOutOfRange);
}

TEST(SurfacePreview, AcceptsAnyInput) {
  const std::vector<double> wild{0.0,
                                 -0.0,
                                 1e-320,
                                 1e-40,
                                 1.0,
                                 1e29,
                                 1e308,
                                 std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()};
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    Model model;
    for (int i = random.integer(0, 8); i > 0; --i) {
      Vec3 position(0.0);
      for (int k = 0; k < 3; ++k)
        position[k] = random.coin() ? random.between(-1, 1) : wild[random.bits() % wild.size()];
      model.points.push_back(position);
    }
    const auto index = [&](std::size_t count) {
      return static_cast<std::uint32_t>(random.bits() % (count + 1));
    };
    for (int i = random.integer(0, 8); i > 0; --i) {
      Line line{static_cast<LineType>(random.integer(0, 2)), {}};
      for (int k = random.integer(0, 6); k > 0; --k)
        line.points.push_back(index(model.points.size()));
      model.lines.push_back(line);
    }
    for (int i = random.integer(0, 4); i > 0; --i) {
      Patch patch{static_cast<PatchType>(random.integer(0, 4)), {}};
      for (int k = random.integer(0, 3); k > 0; --k) {
        Loop& loop = patch.loops.emplace_back();
        for (int l = random.integer(0, 5); l > 0; --l)
          loop.push_back({index(model.lines.size()), random.coin()});
      }
      model.patches.push_back(patch);
    }
    expectConsistent(previewModel(model, BackgroundGrid{}), model);
  }
}

TEST(ModelPreviewer, OfSamplesOnlyHasTheSamplesAndTheProblemsOfTheParts) {
  // An open box with a line that does not exist, and without sizes.
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  model.patches.pop_back();
  model.lines.push_back(model.lines.front());
  model.lines.back().points = {1000, 1001};
  ModelPreviewer previewer(model, BackgroundGrid{}, {}, true);
  while (!previewer.advance(1)) {
  }
  const ModelPreview whole = previewModel(model, BackgroundGrid{});
  EXPECT_EQ(previewer.result().patchPoints, whole.patchPoints);
  EXPECT_EQ(previewer.result().patchTriangles, whole.patchTriangles);
  EXPECT_EQ(previewer.result().linePoints, whole.linePoints);
  const std::vector<Diagnostic> ofParts = diagnoseModel(model);
  EXPECT_FALSE(ofParts.empty());
  EXPECT_EQ(previewer.result().diagnostics.size(), ofParts.size());
  EXPECT_LT(ofParts.size(), whole.diagnostics.size());
}

TEST(ModelPreviewer, SlicesDoNotChangeThePreview) {
  const Model model = boxModel({0, 0, 0}, {1, 1, 1});
  BackgroundGrid broken = grid();
  broken.nodes.front().size = -1.0;
  const ModelPreview whole = previewModel(model, broken);
  ModelPreviewer previewer(model, broken);
  std::size_t calls = 1;
  double before = previewer.fraction();
  while (!previewer.advance(1)) {
    ++calls;
    EXPECT_GE(previewer.fraction(), before);
    before = previewer.fraction();
  }
  // Each patch is visited twice: to check it and to sample it.
  EXPECT_GE(calls, 2 * model.patches.size());
  EXPECT_EQ(previewer.result().patchPoints, whole.patchPoints);
  EXPECT_EQ(previewer.result().patchTriangles, whole.patchTriangles);
  EXPECT_EQ(previewer.result().linePoints, whole.linePoints);
  ASSERT_EQ(previewer.result().diagnostics.size(), whole.diagnostics.size());
  EXPECT_FALSE(whole.diagnostics.empty());
  EXPECT_EQ(previewer.result().diagnostics.front().code, whole.diagnostics.front().code);
}

}  // namespace
}  // namespace tetrafront::testing
