#include "base/tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/check_model.h"
#include "support/models.h"

namespace tetrafront::testing {
namespace {

constexpr int kMaxExponent = 60;

TEST(Tolerance, IsRelativeToTheDiagonalOfTheBox) {
  const Tolerance tolerance = Tolerance::ofBox(Vec3(-1, 2, 5), Vec3(1, 5, 11));
  constexpr double kDiagonal = 7.0;  // of a box of 2 x 3 x 6
  EXPECT_DOUBLE_EQ(tolerance.rounding(), 1e-12 * kDiagonal);
  EXPECT_DOUBLE_EQ(tolerance.coincidence(), 1e-9 * kDiagonal);
  EXPECT_DOUBLE_EQ(tolerance.area(), 1e-9 * kDiagonal * kDiagonal);
}

/// A power of two changes no digit, so the decisions of the checks do not depend on the unit of length.
TEST(Tolerance, ScalesExactlyWithTheBox) {
  const Vec3 low(-0.3, 0.1, 7.0 / 3.0);
  const Vec3 high(1.1, 0.7, 4.9);
  const Tolerance unscaled = Tolerance::ofBox(low, high);
  for (int exponent = -kMaxExponent; exponent <= kMaxExponent; ++exponent) {
    const double scale = std::ldexp(1.0, exponent);
    const Tolerance scaled = Tolerance::ofBox(scale * low, scale * high);
    EXPECT_EQ(scaled.rounding(), scale * unscaled.rounding()) << exponent;
    EXPECT_EQ(scaled.coincidence(), scale * unscaled.coincidence()) << exponent;
    EXPECT_EQ(scaled.area(), scale * scale * unscaled.area()) << exponent;
  }
}

TEST(Tolerance, DoesNotDependOnThePositionOfTheBox) {
  const Vec3 size(0.5, 0.25, 2.0);
  const Tolerance atOrigin = Tolerance::ofBox(Vec3(0.0), size);
  for (const Vec3& offset : {Vec3(1024.0), Vec3(-3.0, 0.5, 65536.0)}) {
    const Tolerance moved = Tolerance::ofBox(offset, offset + size);
    EXPECT_EQ(moved.rounding(), atOrigin.rounding());
    EXPECT_EQ(moved.coincidence(), atOrigin.coincidence());
    EXPECT_EQ(moved.area(), atOrigin.area());
  }
}

TEST(Tolerance, OfAFlatBoxFollowsItsOtherAxes) {
  const Tolerance flat = Tolerance::ofBox(Vec3(0, 0, 1), Vec3(3, 4, 1));
  EXPECT_DOUBLE_EQ(flat.coincidence(), 5e-9);
  EXPECT_GT(flat.area(), 0.0);
  const Tolerance line = Tolerance::ofBox(Vec3(0, 2, 1), Vec3(3, 2, 1));
  EXPECT_DOUBLE_EQ(line.coincidence(), 3e-9);
}

/// Then only equal positions are one position, and no surface has enough area.
TEST(Tolerance, IsZeroForASinglePosition) {
  const Tolerance tolerance = Tolerance::ofBox(Vec3(5, 6, 7), Vec3(5, 6, 7));
  EXPECT_EQ(tolerance.rounding(), 0.0);
  EXPECT_EQ(tolerance.coincidence(), 0.0);
  EXPECT_EQ(tolerance.area(), 0.0);
}

/// Coordinates near the far corner of the box are rounded, so equal positions may differ by some units in the last
/// place. An element may be as small as a millionth of the model.
TEST(Tolerance, LiesBetweenTheRoundingOfCoordinatesAndTheSmallestElement) {
  const Tolerance tolerance(1.0);
  EXPECT_GT(tolerance.rounding(), 1000.0 * std::numeric_limits<double>::epsilon());
  EXPECT_GT(tolerance.coincidence(), 100.0 * tolerance.rounding());
  EXPECT_LT(tolerance.coincidence(), 1e-6);
}

// The checks of a model promise what the tolerance says, at any scale and position of the model.

bool reports(const Model& model, DiagnosticCode code) {
  return std::ranges::any_of(diagnoseModel(model), [code](const Diagnostic& diagnostic) {
    return diagnostic.code == code;
  });
}

/// Maps a plane to the position and scale at which a model is drawn.
struct Frame {
  double scale;
  Vec3 offset;
  Vec3 operator()(double x, double y) const { return scale * (offset + Vec3(x, y, 0.0)); }
};

const std::vector<Frame>& frames() {
  static const std::vector<Frame> all{{1.0, Vec3(0.0)},
                                      {0x1p-30, Vec3(0.0)},
                                      {0x1p30, Vec3(0.0)},
                                      {1.0, Vec3(-16.0, 8.0, 4.0)},
                                      {0x1p-30, Vec3(-16.0, 8.0, 4.0)}};
  return all;
}

constexpr double kExtent = 5.0;

/// A rectangle of 4 x 3 whose lower side is a spline with two points that are `gap` apart.
Model rectangleWithTwoNearPoints(const Frame& at, double gap) {
  ModelBuilder builder;
  const std::uint32_t lower =
      builder.line(LineType::kSpline, {at(0, 0), at(2, 0), at(2 + gap, 0), at(4, 0)});
  builder.patch(PatchType::kPlanar, {{{lower, false},
                                      builder.straight(at(4, 0), at(4, 3)),
                                      builder.straight(at(4, 3), at(0, 3)),
                                      builder.straight(at(0, 3), at(0, 0))}});
  return builder.model;
}

TEST(ToleranceOfChecks, PointsCloserThanTheRoundingAreOnePoint) {
  const double rounding = Tolerance(kExtent).rounding();
  for (const Frame& at : frames()) {
    EXPECT_TRUE(
        reports(rectangleWithTwoNearPoints(at, 0.9 * rounding), DiagnosticCode::kCoincidentPoints))
        << at.scale;
    EXPECT_FALSE(
        reports(rectangleWithTwoNearPoints(at, 1.1 * rounding), DiagnosticCode::kCoincidentPoints))
        << at.scale;
  }
}

/// A rectangle of 4 x 3 with a triangular hole that begins `gap` above its lower side.
Model rectangleWithANearHole(const Frame& at, double gap) {
  return polygonModel({{at(0, 0), at(4, 0), at(4, 3), at(0, 3)}, {at(2, gap), at(3, 2), at(1, 2)}});
}

TEST(ToleranceOfChecks, LoopsCloserThanTheCoincidenceTouch) {
  const double coincidence = Tolerance(kExtent).coincidence();
  for (const Frame& at : frames()) {
    EXPECT_TRUE(
        reports(rectangleWithANearHole(at, 0.9 * coincidence), DiagnosticCode::kLoopsIntersect))
        << at.scale;
    EXPECT_FALSE(
        reports(rectangleWithANearHole(at, 1.1 * coincidence), DiagnosticCode::kLoopsIntersect))
        << at.scale;
  }
}

TEST(ToleranceOfChecks, APatchWithASmallerAreaIsDegenerate) {
  const auto rectangle = [](const Frame& at, double area) {
    const double height = area / kExtent;
    return polygonModel({{at(0, 0), at(kExtent, 0), at(kExtent, height), at(0, height)}});
  };
  const double area = Tolerance(kExtent).area();
  for (const Frame& at : frames()) {
    EXPECT_TRUE(reports(rectangle(at, 0.9 * area), DiagnosticCode::kDegeneratePatch)) << at.scale;
    EXPECT_FALSE(reports(rectangle(at, 1.1 * area), DiagnosticCode::kDegeneratePatch)) << at.scale;
  }
}

}  // namespace
}  // namespace tetrafront::testing
