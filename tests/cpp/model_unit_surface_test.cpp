// The mappings of the paper's appendix, eq. (11) to (15): they follow their lines, move with them,
// and reproduce the surfaces that their weights span.

#include "model/unit_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/patch_surface.h"
#include "support/models.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

constexpr std::uint64_t kSeeds = 50;
/// Models reach from about -1 to 4.
constexpr double kSize = 4.0;
constexpr double kExact = 1e-13 * kSize;

UnitSurface surfaceOf(const ResolvedModel& model) {
  const Patch& patch = model.model().patches.front();
  return {patch.type, curvesOf(model, patch.loops.front())};
}

Vec2 randomUnit(Random& random, UnitShape shape) {
  const Vec2 unit(random.unit(), random.unit());
  if (shape == UnitShape::kSquare || unit.x + unit.y <= 1.0) return unit;
  return Vec2(1.0) - unit;
}

/// Splines become parabolas, because chord-length knots do not survive an affine map.
void makeParabolic(Model& model) {
  for (Line& line : model.lines) {
    if (line.type != LineType::kSpline) continue;
    line.points = {line.points[0], line.points[1], line.points.back()};
    line.type = LineType::kParabolic;
  }
}

/// Calls `examine(model, random)` for many random models of each curved type.
template <class Examine>
void forManyPatches(Examine&& examine) {
  for (const PatchType type : kCurvedTypes) {
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      SCOPED_TRACE("type " + std::to_string(static_cast<int>(type)) + " seed " +
                   std::to_string(seed));
      Random random(seed + 1000);
      examine(randomCurvedModel(type, seed, kTypicalBend), random);
    }
  }
}

TEST(ModelUnitSurface, EdgesAreTheLines) {
  forManyPatches([](const Model& model, Random&) {
    const ResolvedModel resolved(model);
    const UnitSurface surface = surfaceOf(resolved);
    const std::vector<OrientedCurve> lines = curvesOf(resolved, model.patches.front().loops[0]);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (int step = 0; step <= 32; ++step) {
        const double t = step / 32.0;
        const SurfacePoint point = surface.evaluate(unitBorder(surface.shape(), i, t));
        const Curve::Sample onLine = lines[i].sample(t);
        EXPECT_LT(glm::length(point.position - onLine.position), kExact) << i << " at " << t;
        const Vec2 along =
            unitBorder(surface.shape(), i, 1.0) - unitBorder(surface.shape(), i, 0.0);
        const Vec3 tangent = along.x * point.alongXi + along.y * point.alongEta;
        EXPECT_LT(glm::length(tangent - onLine.derivative), 1e-11) << i << " at " << t;
      }
    }
  });
}

TEST(ModelUnitSurface, TangentsAreTheLimitOfDifferences) {
  constexpr double kStep = 1e-6;
  forManyPatches([](const Model& model, Random& random) {
    const ResolvedModel resolved(model);
    const UnitSurface surface = surfaceOf(resolved);
    for (int i = 0; i < 10; ++i) {
      const Vec2 at = randomUnit(random, surface.shape());
      const auto difference = [&](const Vec2& step) {
        return (surface.evaluate(at + step).position - surface.evaluate(at - step).position) /
               (2.0 * kStep);
      };
      const SurfacePoint here = surface.evaluate(at);
      EXPECT_LT(glm::length(here.alongXi - difference({kStep, 0})), 1e-7);
      EXPECT_LT(glm::length(here.alongEta - difference({0, kStep})), 1e-7);
    }
  });
}

TEST(ModelUnitSurface, WeightsSumToOne) {
  // An affine map of a patch is the patch of the mapped lines.
  forManyPatches([](const Model& model, Random& random) {
    const Vec3 offset = random.inBox(kSize);
    Model moved = model;
    for (Vec3& point : moved.points) point += offset;
    const ResolvedModel resolved(model);
    const ResolvedModel resolvedMoved(moved);
    const UnitSurface surface = surfaceOf(resolved);
    const Vec2 unit = randomUnit(random, surface.shape());
    const Vec3 position = surfaceOf(resolvedMoved).evaluate(unit).position;
    EXPECT_LT(glm::length(position - offset - surface.evaluate(unit).position), 3.0 * kExact);
  });
}

TEST(ModelUnitSurface, FollowsAffineMaps) {
  forManyPatches([](Model model, Random& random) {
    makeParabolic(model);
    const std::array<Vec3, 4> map{random.inBox(), random.inBox(), random.inBox(), random.inBox()};
    const auto transform = [&](const Vec3& p) {
      return map[0] + p.x * map[1] + p.y * map[2] + p.z * map[3];
    };
    Model image = model;
    for (Vec3& point : image.points) point = transform(point);
    const ResolvedModel resolved(model);
    const ResolvedModel resolvedImage(image);
    const UnitSurface surface = surfaceOf(resolved);
    const UnitSurface surfaceImage = surfaceOf(resolvedImage);
    for (int i = 0; i < 5; ++i) {
      const Vec2 unit = randomUnit(random, surface.shape());
      const Vec3 expected = transform(surface.evaluate(unit).position);
      EXPECT_LT(glm::length(surfaceImage.evaluate(unit).position - expected), 3.0 * kExact);
    }
  });
}

TEST(ModelUnitSurface, StraightLinesGiveAPlanarOrBilinearSurface) {
  forManyPatches([](Model model, Random& random) {
    const bool isParabolic = model.patches.front().type == PatchType::kIsoparametricTriangle ||
                             model.patches.front().type == PatchType::kSerendipity;
    for (Line& line : model.lines) {
      const Vec3 middle =
          0.5 * (model.points[line.points.front()] + model.points[line.points.back()]);
      line.points = {line.points.front(), line.points.back()};
      line.type = isParabolic ? LineType::kParabolic : LineType::kStraight;
      if (!isParabolic) continue;
      line.points.insert(line.points.begin() + 1, static_cast<std::uint32_t>(model.points.size()));
      model.points.push_back(middle);
    }
    const ResolvedModel resolved(model);
    const UnitSurface surface = surfaceOf(resolved);
    const std::vector<OrientedCurve> lines = curvesOf(resolved, model.patches.front().loops[0]);
    for (int i = 0; i < 10; ++i) {
      const Vec2 u = randomUnit(random, surface.shape());
      const Vec3& a = lines[0].start();
      const Vec3& b = lines[1].start();
      const Vec3& c = lines[2].start();
      const Vec3 expected = surface.shape() == UnitShape::kTriangle
                                ? a + u.x * (b - a) + u.y * (c - a)
                                : (1 - u.y) * ((1 - u.x) * a + u.x * b) +
                                      u.y * (u.x * c + (1 - u.x) * lines[3].start());
      EXPECT_LT(glm::length(surface.evaluate(u).position - expected), kExact);
    }
  });
}

// ---- what the weights span -----------------------------------------------------------------------

/// Powers of xi and eta of the terms that a type reproduces; if known, all of second degree.
std::vector<std::array<int, 2>> termsOf(PatchType type) {
  std::vector<std::array<int, 2>> terms{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {0, 2}};
  // The Barnhill-Gregory-Nielson triangle reproduces sums of a function of xi and one of eta.
  if (type == PatchType::kBarnhillGregoryNielson) return terms;
  terms.push_back({1, 1});
  if (type == PatchType::kIsoparametricTriangle) return terms;
  terms.insert(terms.end(), {{2, 1}, {1, 2}});
  return terms;
}

double power(double base, int exponent) {
  double result = 1.0;
  for (; exponent > 0; --exponent) result *= base;
  return result;
}

TEST(ModelUnitSurface, ReproducesPolynomialSurfacesFromTheirBorder) {
  for (const PatchType type : kCurvedTypes) {
    const UnitShape shape = unitShapeOf(type);
    const std::size_t lineCount = shape == UnitShape::kTriangle ? 3 : 4;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      Random random(seed);
      const std::vector<std::array<int, 2>> terms = termsOf(type);
      std::vector<Vec3> coefficients;
      for (std::size_t i = 0; i < terms.size(); ++i) coefficients.push_back(random.inBox());
      const auto polynomial = [&](const Vec2& unit) {
        Vec3 sum(0.0);
        for (std::size_t i = 0; i < terms.size(); ++i)
          sum += (power(unit.x, terms[i][0]) * power(unit.y, terms[i][1])) * coefficients[i];
        return sum;
      };
      ModelBuilder builder;
      Loop loop;
      for (std::size_t i = 0; i < lineCount; ++i)
        loop.push_back({builder.line(LineType::kParabolic, {polynomial(unitBorder(shape, i, 0.0)),
                                                            polynomial(unitBorder(shape, i, 0.5)),
                                                            polynomial(unitBorder(shape, i, 1.0))}),
                        false});
      builder.patch(type, {loop});
      const ResolvedModel resolved(builder.model);
      const UnitSurface surface = surfaceOf(resolved);
      for (int i = 0; i < 10; ++i) {
        const Vec2 unit = randomUnit(random, shape);
        EXPECT_LT(glm::length(surface.evaluate(unit).position - polynomial(unit)), 3.0 * kExact)
            << "type " << static_cast<int>(type) << " seed " << seed;
      }
    }
  }
}

// ---- the roles of the lines ----------------------------------------------------------------------

/// Returns the patch with a loop that begins `by` lines later.
Model rotated(Model model, std::size_t by) {
  Loop& loop = model.patches.front().loops.front();
  std::ranges::rotate(loop, loop.begin() + static_cast<std::ptrdiff_t>(by));
  return model;
}

/// Returns the patch with the reversed loop, from the same corner.
Model mirrored(Model model) {
  Loop& loop = model.patches.front().loops.front();
  std::ranges::reverse(loop);
  for (OrientedLine& line : loop) line.reversed = !line.reversed;
  return model;
}

/// Returns the parameters of a position of the patch if its loop begins one line later.
Vec2 afterRotation(UnitShape shape, const Vec2& unit) {
  if (shape == UnitShape::kSquare) return {unit.y, 1.0 - unit.x};
  return {unit.y, (1.0 - unit.x) - unit.y};
}

TEST(ModelUnitSurface, LoopMayHaveEitherDirection) {
  forManyPatches([](const Model& model, Random& random) {
    const Model other = mirrored(model);
    const ResolvedModel resolved(model);
    const ResolvedModel resolvedOther(other);
    const UnitSurface surface = surfaceOf(resolved);
    const Vec2 unit = randomUnit(random, surface.shape());
    const Vec3 there = surfaceOf(resolvedOther).evaluate({unit.y, unit.x}).position;
    EXPECT_LT(glm::length(surface.evaluate(unit).position - there), kExact);
  });
}

TEST(ModelUnitSurface, LoopMayBeginAnywhereExceptForTheRoleOfF2) {
  double largestChange = 0.0;
  forManyPatches([&](const Model& model, Random& random) {
    const Model other = rotated(model, 1);
    const ResolvedModel resolved(model);
    const ResolvedModel resolvedOther(other);
    const UnitSurface surface = surfaceOf(resolved);
    const UnitSurface surfaceOther = surfaceOf(resolvedOther);
    const auto change = [&](const Vec2& unit) {
      const Vec3 there = surfaceOther.evaluate(afterRotation(surface.shape(), unit)).position;
      return glm::length(surface.evaluate(unit).position - there);
    };
    const std::size_t lines = model.patches.front().loops.front().size();
    for (std::size_t i = 0; i < lines; ++i)
      EXPECT_LT(change(unitBorder(surface.shape(), i, random.unit())), kExact);
    const double inside = change(randomUnit(random, surface.shape()));
    if (model.patches.front().type == PatchType::kBarnhillGregoryNielson)
      largestChange = std::max(largestChange, inside);
    else
      EXPECT_LT(inside, kExact);
  });
  EXPECT_GT(largestChange, 0.01);
}

TEST(ModelUnitSurface, BarnhillGregoryNielsonBlendsF2AloneFromOneSide) {
  // F1 and F3 are straight along the axes of a right triangle, and F2 is bent out of its plane: the
  // bend is xi f(eta) + eta f(1 - xi). If F3 were bent instead, it would be (1 - xi) f(1 - eta) -
  // eta f(xi). Here f is 4 t (1 - t).
  ModelBuilder builder;
  const std::uint32_t bent =
      builder.line(LineType::kParabolic, {{1, 0, 0}, {0.5, 0.5, 1}, {0, 1, 0}});
  builder.patch(PatchType::kBarnhillGregoryNielson, {{builder.straight({0, 0, 0}, {1, 0, 0}),
                                                      {bent, false},
                                                      builder.straight({0, 1, 0}, {0, 0, 0})}});
  const ResolvedModel resolved(builder.model);
  const auto f = [](double t) { return 4.0 * t * (1.0 - t); };
  const Vec3 asF2 = surfaceOf(resolved).evaluate({0.25, 0.5}).position;
  EXPECT_LT(glm::length(asF2 - Vec3(0.25, 0.5, 0.25 * f(0.5) + 0.5 * f(0.75))), 1e-15);
  const Model other = rotated(builder.model, 2);
  const ResolvedModel resolvedOther(other);
  // The same position with P1 at (0, 1): a third coordinate of 0.25, and 0.25 towards (1, 0).
  const Vec3 asF3 = surfaceOf(resolvedOther).evaluate({0.25, 0.25}).position;
  EXPECT_LT(glm::length(asF3 - Vec3(0.25, 0.5, 0.75 * f(0.75) - 0.25 * f(0.25))), 1e-15);
}

}  // namespace
}  // namespace tetrafront::testing
