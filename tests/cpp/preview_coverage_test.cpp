// The coverage of a model by the background grid, and the sizes proposed from a model's shape.

#include "preview/check_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "field/size_sources.h"
#include "support/models.h"
#include "support/slices.h"
#include "tetrafront/covering_grid.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"
#include "tetrafront/size_proposals.h"

namespace tetrafront::testing {
namespace {

SizeField unitBoxField(const Vec3& low, const Vec3& high) {
  return SizeField::fromGrid(GridLocator(boxGrid(low, high, [](const Vec3&) { return 0.2; })));
}

std::vector<Diagnostic> outside(const std::vector<Diagnostic>& all) {
  std::vector<Diagnostic> found;
  std::copy_if(all.begin(), all.end(), std::back_inserter(found), [](const Diagnostic& d) {
    return d.code == DiagnosticCode::kOutsideBackgroundGrid;
  });
  return found;
}

TEST(CoverageTest, ACoveredModelHasNoDiagnostics) {
  const Model box = boxModel(Vec3(0.0), Vec3(1.0));
  EXPECT_TRUE(checkCoverage(box, unitBoxField(Vec3(0.0), Vec3(1.0))).empty());
  EXPECT_TRUE(checkCoverage(box, SizeField::uniform(0.1)).empty());
}

TEST(CoverageTest, ReportsEveryPointOutside) {
  const Model box = boxModel(Vec3(0.0), Vec3(1.0));
  const std::vector<Diagnostic> found =
      checkCoverage(box, unitBoxField(Vec3(-0.1), Vec3(1.1, 1.1, 0.5)));
  ASSERT_EQ(found.size(), 4U);
  for (const Diagnostic& d : found) {
    ASSERT_EQ(d.entities.size(), 1U);
    EXPECT_EQ(d.entities[0].kind, EntityKind::kPoint);
    EXPECT_TRUE(d.hasPosition);
    EXPECT_EQ(d.position, box.points[d.entities[0].index]);
    EXPECT_EQ(d.position.z, 1.0);
  }
}

TEST(CoverageTest, ReportsALineThatIsOutsideBetweenItsPoints) {
  ModelBuilder builder;
  const Vec3 end(1.0, 0.25, 0.0);
  const Vec3 tip(0.5, -1.0, 0.0);
  // The line is inclined at its middle point; its highest point follows at y = 0.3223.
  const std::uint32_t arc =
      builder.line(LineType::kParabolic, {Vec3(0.0), Vec3(0.5, 0.3, 0.0), end});
  builder.patch(PatchType::kPlanar,
                {{{arc, false}, builder.straight(end, tip), builder.straight(tip, Vec3(0.0))}});
  const Vec3 low(-0.1, -1.1, -0.1);
  EXPECT_TRUE(checkCoverage(builder.model, unitBoxField(low, Vec3(1.1, 0.33, 0.1))).empty());
  const std::vector<Diagnostic> found =
      checkCoverage(builder.model, unitBoxField(low, Vec3(1.1, 0.31, 0.1)));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].entities.at(0).kind, EntityKind::kLine);
  EXPECT_EQ(found[0].entities[0].index, arc);
  EXPECT_GT(found[0].position.y, 0.31);
}

TEST(CoverageTest, ReportsAPatchWhoseBorderIsCovered) {
  ModelBuilder builder;
  const std::vector<Vec3> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  builder.patch(PatchType::kPlanar, {builder.polygon(corners)});
  // A grid that covers the border only: a box without its core.
  BackgroundGrid ring;
  for (const auto& [low, high] :
       std::vector<std::pair<Vec3, Vec3>>{{Vec3(-0.1, -0.1, -0.1), Vec3(1.1, 0.3, 0.1)},
                                          {Vec3(-0.1, 0.7, -0.1), Vec3(1.1, 1.1, 0.1)},
                                          {Vec3(-0.1, -0.1, -0.1), Vec3(0.3, 1.1, 0.1)},
                                          {Vec3(0.7, -0.1, -0.1), Vec3(1.1, 1.1, 0.1)}}) {
    const BackgroundGrid bar = boxGrid(low, high, [](const Vec3&) { return 0.2; });
    const auto first = static_cast<std::uint32_t>(ring.nodes.size());
    ring.nodes.insert(ring.nodes.end(), bar.nodes.begin(), bar.nodes.end());
    for (const auto& t : bar.tetrahedra)
      ring.tetrahedra.push_back({t[0] + first, t[1] + first, t[2] + first, t[3] + first});
  }
  const std::vector<Diagnostic> found =
      checkCoverage(builder.model, SizeField::fromGrid(GridLocator(ring)));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].entities.at(0).kind, EntityKind::kPatch);
  EXPECT_GT(found[0].position.x, 0.3);
  EXPECT_LT(found[0].position.x, 0.7);
}

TEST(CoverageTest, IsReportedByThePreviewAndEndsTheRunBeforeMeshing) {
  const Model box = boxModel(Vec3(0.0), Vec3(1.0));
  const BackgroundGrid grid =
      boxGrid(Vec3(-0.1), Vec3(1.1, 1.1, 0.5), [](const Vec3&) { return 0.2; });
  EXPECT_EQ(outside(previewModel(box, grid).diagnostics).size(), 4U);
  MeshRun run(box, grid, {});
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kInvalidInput);
  EXPECT_EQ(outside(run.diagnostics()).size(), 4U);
  EXPECT_TRUE(run.surface().triangles.empty());
}

// ---- proposals -----------------------------------------------------------------------------------

double sizeAt(const SizeProposal& proposal, const Vec3& position) {
  return SizeSources(proposal.sources).cappedSize(position, proposal.size);
}

TEST(SizeProposalTest, ABoxGetsAUniformSize) {
  const SizeProposal proposal =
      proposeSizes(boxModel(Vec3(0.0), Vec3(1.0, 2.0, 2.0)), ProposalOptions{});
  EXPECT_NEAR(proposal.size, 3.0 / 20.0, 1e-12);
  EXPECT_TRUE(proposal.sources.empty());
  EXPECT_EQ(proposeSizes(Model{}, {}).size, 0.0);
}

TEST(SizeProposalTest, BendsGetTheGivenNumberOfElementsPerCircle) {
  constexpr double kRadius = 0.25;
  const Model tube = seamedTube(kRadius, 4.0);
  ProposalOptions options;
  options.elementsPerCircle = 30.0;
  options.elementsPerGap = 0.0;
  const SizeProposal proposal = proposeSizes(tube, options);
  const double expected = 2.0 * std::numbers::pi * kRadius / 30.0;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.37 * i;
    const Vec3 position(kRadius * std::cos(angle), kRadius * std::sin(angle), 0.1 * i);
    EXPECT_NEAR(sizeAt(proposal, position), expected, 0.3 * expected) << "at z = " << position.z;
  }
  EXPECT_GT(sizeAt(proposal, Vec3(0.0, 0.0, 9.0)), 0.9 * proposal.size);
  // About one source per one or two elements of the curve, not one per sample.
  const double elements = 2.0 * std::numbers::pi * kRadius * 4.0 / (expected * expected);
  EXPECT_LT(static_cast<double>(proposal.sources.size()), elements);
  EXPECT_TRUE(checkSizeSources(proposal.sources).empty());
}

TEST(SizeProposalTest, GapsGetTheGivenNumberOfElements) {
  ProposalOptions options;
  options.elementsPerGap = 4.0;
  const Model plate = boxModel(Vec3(0.0), Vec3(1.0, 1.0, 0.02));
  const SizeProposal proposal = proposeSizes(plate, options);
  EXPECT_NEAR(sizeAt(proposal, Vec3(0.5, 0.5, 0.02)), 0.005, 1e-3);
  // The space between two thick boxes is outside, so it is no gap.
  ModelBuilder two;
  two.model = boxModel(Vec3(0.0), Vec3(1.0));
  const Model above = boxModel(Vec3(0.0, 0.0, 1.01), Vec3(1.0, 1.0, 2.0));
  const auto points = static_cast<std::uint32_t>(two.model.points.size());
  const auto lines = static_cast<std::uint32_t>(two.model.lines.size());
  for (const Vec3& point : above.points) two.model.points.push_back(point);
  for (Line line : above.lines) {
    for (std::uint32_t& point : line.points) point += points;
    two.model.lines.push_back(line);
  }
  for (Patch patch : above.patches) {
    for (OrientedLine& line : patch.loops.at(0)) line.line += lines;
    two.model.patches.push_back(patch);
  }
  EXPECT_TRUE(proposeSizes(two.model, options).sources.empty());
}

TEST(SizeProposalTest, SizesStayWithinTheGivenLimits) {
  ProposalOptions options;
  options.uniform = 0.1;
  options.smallest = 0.04;
  options.growth = 0.7;
  const SizeProposal proposal = proposeSizes(boxModel(Vec3(0.0), Vec3(1.0, 1.0, 0.01)), options);
  EXPECT_EQ(proposal.size, 0.1);
  ASSERT_FALSE(proposal.sources.empty());
  for (const SizeSource& source : proposal.sources) {
    EXPECT_GE(source.size, 0.04);
    EXPECT_LT(source.size, 0.1);
    EXPECT_EQ(source.growth, 0.7);
  }
}

TEST(SizeProposalTest, InSlicesIsTheSame) {
  const auto equal = [](const SizeSource& a, const SizeSource& b) {
    return a.type == b.type && a.points == b.points && a.size == b.size && a.growth == b.growth;
  };
  for (const bool looksAround : {true, false}) {
    ProposalOptions options;
    if (!looksAround) options.elementsPerCircle = options.elementsPerGap = 0.0;
    const Model tube = seamedTube(0.25, 4.0);
    SizeProposer proposer(tube, options);
    EXPECT_GT(slicesOf(proposer, 8), 2 * tube.patches.size() + 4);
    const SizeProposal whole = proposeSizes(tube, options);
    EXPECT_EQ(whole.sources.empty(), !looksAround);
    EXPECT_EQ(proposer.result().size, whole.size);
    EXPECT_TRUE(std::ranges::equal(proposer.result().sources, whole.sources, equal));
  }
  SizeProposer nothing(Model{}, {});
  slicesOf(nothing, 8);
  EXPECT_EQ(nothing.result().size, 0.0);
}

TEST(SizeProposalTest, AModelMeshesWithItsProposal) {
  const Model box = boxModel(Vec3(0.0), Vec3(1.0, 1.0, 0.1));
  const SizeProposal proposal = proposeSizes(box, {});
  BackgroundGrid grid = coveringGrid(box, proposal.size, CoverShape::kBox);
  grid.sources = proposal.sources;
  MeshOptions unoptimized;
  unoptimized.optimization = Optimization::kNone;
  MeshRun run(box, grid, unoptimized);
  while (run.advance(10'000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  MeshOptions uniform = unoptimized;
  uniform.size = proposal.size;
  BackgroundGrid sourcesOnly;
  sourcesOnly.sources = proposal.sources;
  MeshRun bySize(box, sourcesOnly, uniform);
  while (bySize.advance(10'000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(bySize.volume().tetrahedra.size(), run.volume().tetrahedra.size());
}

}  // namespace
}  // namespace tetrafront::testing
