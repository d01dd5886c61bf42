#include "field/size_sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "field/check_background_grid.h"
#include "field/size_field.h"
#include "support/models.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

SizeSource pointSource(const Vec3& position, double size, double distance, double growth) {
  return {SourceType::kPoint, {position, Vec3(0.0), Vec3(0.0)}, size, distance, growth};
}

std::vector<SizeSource> randomSources(Random& random, int count) {
  std::vector<SizeSource> sources;
  for (int i = 0; i < count; ++i) {
    SizeSource source;
    source.type = static_cast<SourceType>(random.integer(0, 2));
    const Vec3 centre = random.inBox(5.0);
    for (Vec3& point : source.points) point = centre + random.inBox();
    source.size = random.between(0.01, 0.5);
    source.distance = random.coin() ? 0.0 : random.between(0.0, 2.0);
    source.growth = random.between(0.05, 0.6);
    sources.push_back(source);
  }
  return sources;
}

/// The smallest size over a lattice of positions on the source, which grows with the distance from
/// each.
double sampledSize(const SizeSource& source, const Vec3& position) {
  constexpr int kPieces = 60;
  const auto& [a, b, c] = source.points;
  double nearest = std::numeric_limits<double>::max();
  for (int i = 0; i <= kPieces; ++i) {
    for (int j = 0; i + j <= kPieces; ++j) {
      const double u = source.type == SourceType::kPoint ? 0.0 : double{1.0} * i / kPieces;
      const double v = source.type == SourceType::kTriangle ? double{1.0} * j / kPieces : 0.0;
      nearest = std::min(nearest, glm::length(a + u * (b - a) + v * (c - a) - position));
    }
  }
  return source.size + source.growth * std::max(0.0, nearest - source.distance);
}

TEST(SizeSourcesTest, SizeHoldsUpToTheDistanceAndGrowsBeyond) {
  const SizeSource source = pointSource(Vec3(1.0, 2.0, 3.0), 0.1, 0.5, 0.2);
  EXPECT_DOUBLE_EQ(sizeOf(source, Vec3(1.0, 2.0, 3.0)), 0.1);
  EXPECT_DOUBLE_EQ(sizeOf(source, Vec3(1.4, 2.0, 3.0)), 0.1);
  EXPECT_DOUBLE_EQ(sizeOf(source, Vec3(1.0, 2.0, 5.5)), 0.1 + 0.2 * 2.0);
}

TEST(SizeSourcesTest, DistancesAreMeasuredToTheNearestPointOfTheSource) {
  Random random(911);
  for (const SizeSource& source : randomSources(random, 60)) {
    const Vec3 position = source.points[0] + random.inBox(3.0);
    const double expected = sampledSize(source, position);
    EXPECT_LE(sizeOf(source, position), expected + 1e-12);
    EXPECT_NEAR(sizeOf(source, position), expected, 0.6 * 3.5 / 60.0);
  }
}

TEST(SizeSourcesTest, TheSmallestSizeWinsForAnyNumberOfSources) {
  for (const int count : {1, 7, 9, 33, 500}) {
    Random random(static_cast<std::uint64_t>(920 + count));
    const std::vector<SizeSource> list = randomSources(random, count);
    const SizeSources sources(list);
    for (int i = 0; i < 300; ++i) {
      const Vec3 position = random.inBox(8.0);
      double expected = 0.7;
      for (const SizeSource& source : list) expected = std::min(expected, sizeOf(source, position));
      EXPECT_EQ(sources.cappedSize(position, 0.7), expected) << count << " sources";
    }
  }
}

TEST(SizeSourcesTest, WithoutGrowthTheSizeHoldsEverywhere) {
  std::vector<SizeSource> list(20, pointSource(Vec3(0.0), 0.5, 0.0, 1.0));
  list[11].growth = 0.0;
  list[11].size = 0.6;
  EXPECT_EQ(SizeSources(list).cappedSize(Vec3(1e6, 0.0, 0.0), 10.0), 0.6);
}

TEST(SizeSourcesTest, CapTheSizesOfTheGrid) {
  const BackgroundGrid grid = boxGrid(Vec3(0.0), Vec3(1.0), [](const Vec3&) { return 0.3; });
  SizeField field = SizeField::fromGrid(GridLocator(grid));
  field.addSources(std::vector{pointSource(Vec3(0.5), 0.05, 0.0, 0.5)});
  FieldHint hint;
  EXPECT_DOUBLE_EQ(field.sizeAt(Vec3(0.5), hint), 0.05);
  EXPECT_DOUBLE_EQ(field.sizeAt(Vec3(0.5, 0.5, 0.7), hint), 0.15);
  EXPECT_DOUBLE_EQ(field.sizeAt(Vec3(0.0), hint), 0.3);
  EXPECT_FALSE(field.isStretched());
  EXPECT_TRUE(field.covers(Vec3(0.5), hint));
  // Further sources leave the existing ones in place.
  field.addSources(std::vector{pointSource(Vec3(0.0), 0.1, 0.0, 0.5)});
  EXPECT_DOUBLE_EQ(field.sizeAt(Vec3(0.5), hint), 0.05);
  EXPECT_DOUBLE_EQ(field.sizeAt(Vec3(0.0), hint), 0.1);
}

TEST(SizeSourcesTest, CapEveryAxisOfAStretchedGrid) {
  BackgroundGrid grid = boxGrid(Vec3(0.0), Vec3(1.0), [](const Vec3&) { return 0.1; });
  const Vec3 direction(2.0, 2.0, 1.0);  // of length 3
  for (BackgroundNode& node : grid.nodes) {
    node.stretching = 10.0;
    node.direction = direction;
  }
  SizeField field = SizeField::fromGrid(GridLocator(grid));
  field.addSources(std::vector{pointSource(Vec3(0.5), 0.4, 0.0, 0.5)});
  FieldHint hint;
  // Across, 0.1 is below the source's size; along, 1.0 is above it.
  const SymmetricTensor tensor = field.tensorAt(Vec3(0.5), hint);
  EXPECT_NEAR(glm::length(tensor * (direction / 3.0)), 0.4, 1e-12);
  EXPECT_NEAR(glm::length(tensor * (Vec3(1.0, -1.0, 0.0) / std::sqrt(2.0))), 0.1, 1e-12);
  EXPECT_NEAR(tensor.determinant(), 0.1 * 0.1 * 0.4, 1e-12);
}

TEST(SizeSourcesTest, DiagnosticsNameTheSourceAndItsValues) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<SizeSource> invalid{
      pointSource(Vec3(1.0), 0.0, 0.0, 0.3),   pointSource(Vec3(1.0), nan, 0.0, 0.3),
      pointSource(Vec3(1.0), 0.1, -1.0, 0.3),  pointSource(Vec3(1.0), 0.1, infinity, 0.3),
      pointSource(Vec3(1.0), 0.1, 0.0, -0.01), pointSource(Vec3(1.0), 0.1, 0.0, nan)};
  const std::vector<Diagnostic> found = checkSizeSources(invalid);
  ASSERT_EQ(found.size(), invalid.size());
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].code, DiagnosticCode::kSourceOutOfRange);
    EXPECT_EQ(found[i].entities.at(0).kind, EntityKind::kSource);
    EXPECT_EQ(found[i].entities.at(0).index, i);
    EXPECT_EQ(found[i].values.size(), 3U);
    EXPECT_EQ(found[i].position, Vec3(1.0));
  }
}

TEST(SizeSourcesTest, OnlyThePointsOfTheTypeAreChecked) {
  SizeSource source = pointSource(Vec3(0.0), 0.1, 0.0, 0.3);
  source.points[1].y = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(checkSizeSources(std::vector{source}).empty());
  source.type = SourceType::kSegment;
  const std::vector<Diagnostic> found = checkSizeSources(std::vector{source});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kNotFinite);
}

TEST(SizeSourcesTest, ChecksRejectCoordinatesOutOfRangeForPredicates) {
  const std::vector<SizeSource> far{pointSource(Vec3(0.0, -0x1p101, 0.0), 0.1, 0.0, 0.3)};
  const std::vector<Diagnostic> found = checkSizeSources(far);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kNotFinite);
}

TEST(SizeSourcesTest, AreCheckedWithTheirGrid) {
  BackgroundGrid grid = boxGrid(Vec3(0.0), Vec3(1.0), [](const Vec3&) { return 0.3; });
  grid.sources.push_back(pointSource(Vec3(0.5), -1.0, 0.0, 0.3));
  ASSERT_EQ(checkBackgroundGrid(grid).size(), 1U);
  EXPECT_EQ(checkBackgroundGrid(grid)[0].code, DiagnosticCode::kSourceOutOfRange);
}

}  // namespace
}  // namespace tetrafront::testing
