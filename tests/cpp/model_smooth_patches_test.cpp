// Smooth patches and lofts: they follow their lines, their tangents are the limit of differences, smooth patches of a net have
// one normal along common lines, and planes, cylinders and translational surfaces are exact.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "model/check_model.h"
#include "model/patch_surface.h"
#include "support/models.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

constexpr std::array kSmoothTypes{PatchType::kGregory, PatchType::kNielson, PatchType::kLoft};
constexpr std::uint64_t kSmoothSeeds = 50;

Model randomSmoothModel(PatchType type, std::uint64_t seed) {
  Model model = type == PatchType::kNielson
                    ? randomTriangleModel(PatchType::kBarnhillGregoryNielson, seed, kTypicalBend)
                    : randomCoonsModel(seed, kTypicalBend);
  model.patches.front().type = type;
  // Some splines become Hermite lines through all of their points.
  Random random(seed + 77);
  for (Line& line : model.lines)
    if (line.type == LineType::kSpline && random.coin()) line.type = LineType::kHermite;
  return model;
}

Vec2 randomInDomain(Random& random, UnitShape shape) {
  const Vec2 unit(random.unit(), random.unit());
  if (shape == UnitShape::kSquare || unit.x + unit.y <= 1.0) return unit;
  return Vec2(1.0) - unit;
}

template <class Examine>
void forManySmoothPatches(Examine&& examine) {
  for (const PatchType type : kSmoothTypes) {
    for (std::uint64_t seed = 0; seed < kSmoothSeeds; ++seed) {
      SCOPED_TRACE("type " + std::to_string(static_cast<int>(type)) + " seed " +
                   std::to_string(seed));
      Random random(seed + 1000);
      const Model model = randomSmoothModel(type, seed);
      const ResolvedModel resolved(model);
      examine(resolved, unitSurface(resolved, model.patches.front()), random);
    }
  }
}

Vec3 unitNormal(const UnitSurface& surface, const Vec2& unit) {
  const SurfacePoint point = surface.evaluate(unit);
  return glm::normalize(glm::cross(point.alongXi, point.alongEta));
}

double angleBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), std::fabs(glm::dot(a, b)));
}

// ---- one patch -----------------------------------------------------------------------------------

TEST(ModelSmoothPatches, EdgesAreTheLines) {
  forManySmoothPatches([](const ResolvedModel& model, const UnitSurface& surface, Random&) {
    const std::vector<OrientedCurve> lines = curvesOf(model, model.model().patches[0].loops[0]);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (int step = 0; step <= 32; ++step) {
        const double t = step / 32.0;
        const SurfacePoint point = surface.evaluate(unitBorder(surface.shape(), i, t));
        const Curve::Sample onLine = lines[i].sample(t);
        EXPECT_LT(glm::length(point.position - onLine.position), 1e-12) << i << " at " << t;
        const Vec2 along =
            unitBorder(surface.shape(), i, 1.0) - unitBorder(surface.shape(), i, 0.0);
        const Vec3 tangent = along.x * point.alongXi + along.y * point.alongEta;
        EXPECT_LT(glm::length(tangent - onLine.derivative), 1e-10) << i << " at " << t;
      }
    }
  });
}

TEST(ModelSmoothPatches, TangentsAreTheLimitOfDifferences) {
  constexpr double kStep = 1e-6;
  forManySmoothPatches([](const ResolvedModel&, const UnitSurface& surface, Random& random) {
    for (int i = 0; i < 10; ++i) {
      const double most = surface.shape() == UnitShape::kTriangle ? 0.4 : 0.9;
      const Vec2 unit(random.between(0.05, most), random.between(0.05, most));
      const SurfacePoint point = surface.evaluate(unit);
      const auto difference = [&](const Vec2& step) {
        return (surface.evaluate(unit + step).position - surface.evaluate(unit - step).position) /
               (2.0 * kStep);
      };
      EXPECT_LT(glm::length(point.alongXi - difference({kStep, 0.0})), 1e-7);
      EXPECT_LT(glm::length(point.alongEta - difference({0.0, kStep})), 1e-7);
    }
  });
}

TEST(ModelSmoothPatches, TangentsAreContinuousUpToTheCorners) {
  forManySmoothPatches([](const ResolvedModel&, const UnitSurface& surface, Random& random) {
    if (surface.shape() == UnitShape::kSquare && random.coin()) return;
    const std::array<Vec2, 3> corners{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
    for (const Vec2& corner : corners) {
      const SurfacePoint there = surface.evaluate(corner);
      for (int i = 0; i < 4; ++i) {
        const Vec2 inside(random.between(0.2, 0.4), random.between(0.2, 0.4));
        const SurfacePoint near = surface.evaluate(corner + 1e-7 * (inside - corner));
        EXPECT_LT(glm::length(near.alongXi - there.alongXi), 2e-4);
        EXPECT_LT(glm::length(near.alongEta - there.alongEta), 2e-4);
      }
    }
  });
}

TEST(ModelSmoothPatches, ThePositionMovesWithTheLines) {
  // Weights of positions sum to one, and those of directions to zero: a translation moves all, a rotation and scaling too.
  forManySmoothPatches(
      [](const ResolvedModel& resolved, const UnitSurface& surface, Random& random) {
        Model image = resolved.model();
        const Vec3 shift = random.inBox(5.0);
        for (Vec3& point : image.points) point = 3.0 * Vec3(-point.y, point.x, point.z) + shift;
        const ResolvedModel resolvedImage(image);
        const UnitSurface moved = unitSurface(resolvedImage, image.patches[0]);
        for (int i = 0; i < 5; ++i) {
          const Vec2 unit = randomInDomain(random, surface.shape());
          const Vec3 p = surface.evaluate(unit).position;
          const Vec3 expected = 3.0 * Vec3(-p.y, p.x, p.z) + shift;
          EXPECT_LT(glm::length(moved.evaluate(unit).position - expected), 1e-11);
        }
      });
}

TEST(ModelSmoothPatches, LoopsMayBeginAnywhereAndRunEitherWay) {
  for (const PatchType type : {PatchType::kGregory, PatchType::kNielson}) {
    for (std::uint64_t seed = 0; seed < kSmoothSeeds; ++seed) {
      SCOPED_TRACE(seed);
      const Model model = randomSmoothModel(type, seed);
      Model other = model;
      Loop& loop = other.patches[0].loops[0];
      std::ranges::reverse(loop);
      for (OrientedLine& line : loop) line.reversed = !line.reversed;
      Model later = model;
      std::ranges::rotate(later.patches[0].loops[0], later.patches[0].loops[0].begin() + 1);
      const ResolvedModel resolved(model);
      const ResolvedModel resolvedOther(other);
      const ResolvedModel resolvedLater(later);
      const UnitSurface surface = unitSurface(resolved, model.patches[0]);
      Random random(seed);
      for (int i = 0; i < 5; ++i) {
        const Vec2 unit = randomInDomain(random, surface.shape());
        const Vec3 position = surface.evaluate(unit).position;
        const Vec2 mirrored(unit.y, unit.x);
        const Vec2 rotated(
            unit.y, surface.shape() == UnitShape::kSquare ? 1.0 - unit.x : (1.0 - unit.x) - unit.y);
        EXPECT_LT(
            glm::length(unitSurface(resolvedOther, other.patches[0]).evaluate(mirrored).position -
                        position),
            1e-12);
        EXPECT_LT(
            glm::length(unitSurface(resolvedLater, later.patches[0]).evaluate(rotated).position -
                        position),
            1e-12);
      }
    }
  }
}

TEST(ModelSmoothPatches, PlaneLinesGiveThePlane) {
  forManySmoothPatches([](const ResolvedModel& resolved, const UnitSurface&, Random& random) {
    Model flat = resolved.model();
    const Vec3 u = glm::normalize(random.inBox());
    const Vec3 normal = glm::normalize(glm::cross(u, random.inBox()));
    const Vec3 v = glm::cross(normal, u);
    for (Vec3& point : flat.points) point = point.x * u + point.y * v + 0.7 * normal;
    const ResolvedModel resolvedFlat(flat);
    const UnitSurface surface = unitSurface(resolvedFlat, flat.patches[0]);
    for (int i = 0; i < 10; ++i) {
      const SurfacePoint point = surface.evaluate(randomInDomain(random, surface.shape()));
      EXPECT_NEAR(glm::dot(point.position, normal), 0.7, 1e-12);
      EXPECT_NEAR(glm::dot(point.alongXi, normal), 0.0, 1e-10);
      EXPECT_NEAR(glm::dot(point.alongEta, normal), 0.0, 1e-10);
    }
  });
}

TEST(ModelSmoothPatches, StraightLinesOfAPlaneQuadrilateralOrTriangleGiveItsAffineMap) {
  for (const PatchType type : {PatchType::kGregory, PatchType::kNielson}) {
    ModelBuilder builder;
    const Vec3 a(0.3, 0.1, 2.0);
    const Vec3 u(2.0, 0.5, 0.1);
    const Vec3 v(-0.3, 1.5, 0.4);
    if (type == PatchType::kNielson)
      builder.patch(type, {builder.polygon({a, a + u, a + v})});
    else
      builder.patch(type, {builder.polygon({a, a + u, a + u + v, a + v})});
    const ResolvedModel resolved(builder.model);
    const UnitSurface surface = unitSurface(resolved, builder.model.patches[0]);
    Random random(5);
    for (int i = 0; i < 20; ++i) {
      const Vec2 unit = randomInDomain(random, surface.shape());
      EXPECT_LT(glm::length(surface.evaluate(unit).position - (a + unit.x * u + unit.y * v)),
                1e-14);
    }
  }
}

TEST(ModelSmoothPatches, ArcsAndStraightLinesGiveTheCylinder) {
  ModelBuilder builder;
  const auto at = [](double degrees, double z) {
    const double angle = degrees * std::acos(-1.0) / 180.0;
    return Vec3(2.0 * std::cos(angle), 2.0 * std::sin(angle), z);
  };
  const std::uint32_t low = builder.line(LineType::kArc, {at(10, 0), at(70, 0), at(130, 0)});
  const std::uint32_t high = builder.line(LineType::kArc, {at(10, 3), at(70, 3), at(130, 3)});
  builder.patch(PatchType::kGregory, {{{low, false},
                                       builder.straight(at(130, 0), at(130, 3)),
                                       {high, true},
                                       builder.straight(at(10, 3), at(10, 0))}});
  const ResolvedModel resolved(builder.model);
  const UnitSurface surface = unitSurface(resolved, builder.model.patches[0]);
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = surface.evaluate({random.unit(), random.unit()}).position;
    EXPECT_NEAR(std::hypot(p.x, p.y), 2.0, 1e-13);
  }
}

TEST(ModelSmoothPatches, AlongGreatCirclesTheNormalsAreThoseOfTheSphere) {
  const auto onSphere = [](const Vec3& direction) { return glm::normalize(direction); };
  for (std::uint64_t seed = 0; seed < kSmoothSeeds; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    for (const PatchType type : {PatchType::kGregory, PatchType::kNielson}) {
      const std::size_t count = type == PatchType::kGregory ? 4 : 3;
      ModelBuilder builder;
      std::vector<Vec3> corners;
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 axis = count == 3 ? Vec3(i == 0, i == 1, i == 2)
                                     : Vec3(i == 1 || i == 2 ? 1 : -1, i > 1 ? 1 : -1, 1.5);
        corners.push_back(onSphere(glm::normalize(axis) + random.inBox(0.15)));
      }
      Loop loop;
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3& from = corners[i];
        const Vec3& to = corners[(i + 1) % count];
        loop.push_back({builder.line(LineType::kArc, {from, onSphere(from + to), to}), false});
      }
      builder.patch(type, {loop});
      const ResolvedModel resolved(builder.model);
      const UnitSurface surface = unitSurface(resolved, builder.model.patches[0]);
      for (std::size_t i = 0; i < count; ++i) {
        for (int step = 1; step < 32; ++step) {
          const Vec2 unit = unitBorder(surface.shape(), i, step / 32.0);
          EXPECT_LT(angleBetween(unitNormal(surface, unit), surface.evaluate(unit).position),
                    1e-12);
        }
      }
      // Between the lines the patch is not the sphere, but near it: a Barnhill-Gregory-Nielson triangle lies 14 % inside.
      for (int i = 0; i < 20; ++i) {
        const Vec2 unit = randomInDomain(random, surface.shape());
        EXPECT_NEAR(glm::length(surface.evaluate(unit).position), 1.0, 0.06);
      }
    }
  }
}

// ---- nets ----------------------------------------------------------------------------------------

/// A random net over a grid of points with heights: quadrilaterals, some of which are cut into triangles. Each line has up to
/// two inner points; all are Hermite lines. No two patches differ by more than the 80 degrees of an edge.
Model randomNet(std::uint64_t seed) {
  constexpr int kCells = 4;
  Random random(seed);
  ModelBuilder builder;
  std::array<std::array<Vec3, kCells + 1>, kCells + 1> nodes;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i) nodes[j][i] = Vec3(i, j, 0) + random.inBox(0.2);
  const auto hermite = [&](const Vec3& from, const Vec3& to) {
    std::vector<Vec3> points{from};
    const int inner = random.integer(0, 2);
    for (int i = 1; i <= inner; ++i)
      points.push_back(from + (i / (inner + 1.0)) * (to - from) + random.inBox(0.04));
    points.push_back(to);
    return builder.line(LineType::kHermite, points);
  };
  std::array<std::array<std::uint32_t, kCells + 1>, kCells + 1> along;
  std::array<std::array<std::uint32_t, kCells + 1>, kCells + 1> up;
  for (int j = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i) {
      if (i < kCells) along[j][i] = hermite(nodes[j][i], nodes[j][i + 1]);
      if (j < kCells) up[j][i] = hermite(nodes[j][i], nodes[j + 1][i]);
    }
  }
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const OrientedLine south{along[j][i], false};
      const OrientedLine east{up[j][i + 1], false};
      const OrientedLine north{along[j + 1][i], true};
      const OrientedLine west{up[j][i], true};
      if (random.integer(0, 2) > 0) {
        Loop loop{south, east, north, west};
        std::ranges::rotate(loop, loop.begin() + random.integer(0, 3));
        if (random.coin()) {
          std::ranges::reverse(loop);
          for (OrientedLine& line : loop) line.reversed = !line.reversed;
        }
        builder.patch(PatchType::kGregory, {loop});
        continue;
      }
      const std::uint32_t diagonal = hermite(nodes[j][i], nodes[j + 1][i + 1]);
      builder.patch(PatchType::kNielson, {{south, east, {diagonal, true}}});
      builder.patch(PatchType::kNielson, {{{diagonal, false}, north, west}});
    }
  }
  return builder.model;
}

/// Calls `compare(line, t, angle)` for places on lines that two patches share, with the angle of their normals.
void compareAlongLines(const Model& model, int places,
                       const std::function<void(std::uint32_t, double, double)>& compare) {
  const ResolvedModel resolved(model);
  struct Side {
    std::size_t patch;
    std::size_t index;
    bool reversed;
  };
  std::vector<std::vector<Side>> sides(model.lines.size());
  std::vector<UnitSurface> surfaces;
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    surfaces.push_back(unitSurface(resolved, model.patches[p]));
    const Loop& loop = model.patches[p].loops[0];
    for (std::size_t i = 0; i < loop.size(); ++i)
      sides[loop[i].line].push_back({p, i, loop[i].reversed});
  }
  for (std::uint32_t line = 0; line < sides.size(); ++line) {
    if (sides[line].size() != 2) continue;
    for (int place = 0; place < places; ++place) {
      const double t = (place + 0.5) / places;
      std::array<Vec3, 2> normals;
      for (std::size_t k = 0; k < 2; ++k) {
        const Side& side = sides[line][k];
        const UnitSurface& surface = surfaces[side.patch];
        normals[k] = unitNormal(
            surface, unitBorder(surface.shape(), side.index, side.reversed ? 1.0 - t : t));
      }
      compare(line, t, angleBetween(normals[0], normals[1]));
    }
  }
}

TEST(ModelSmoothPatches, PatchesOfRandomNetsHaveOneNormalAlongCommonLines) {
  int places = 0;
  double worst = 0.0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const Model model = randomNet(seed);
    compareAlongLines(model, 16, [&](std::uint32_t line, double t, double angle) {
      ++places;
      worst = std::max(worst, angle);
      EXPECT_LT(angle, 1e-6) << "line " << line << " at " << t;
    });
  }
  EXPECT_GE(places, 10000);
  RecordProperty("worst", std::to_string(worst));
}

TEST(ModelSmoothPatches, LinesOfANetContinueEachOther) {
  // Of a net without inner points and triangles: opposite lines at an inner point have one tangent.
  ModelBuilder builder;
  Random random(9);
  std::array<Vec3, 5> cross{Vec3(0, 0, 0), Vec3(1, 0.1, 0.3), Vec3(0.1, 1, -0.2), Vec3(-1, 0, 0.2),
                            Vec3(0, -1, 0.1)};
  std::array<std::uint32_t, 5> lines{};
  for (std::size_t i = 1; i < 5; ++i)
    lines[i] = builder.line(LineType::kHermite, {cross[0], cross[i]});
  const ResolvedModel resolved(builder.model);
  const auto tangent = [&](std::size_t i) {
    const OrientedCurve curve = resolved.curve({lines[i], false});
    return glm::normalize(curve.sample(0.0).derivative);
  };
  EXPECT_NEAR(glm::dot(tangent(1), tangent(3)), -1.0, 1e-14);
  EXPECT_NEAR(glm::dot(tangent(2), tangent(4)), -1.0, 1e-14);
  EXPECT_LT(std::fabs(glm::dot(tangent(1), tangent(2))), 0.5);
}

TEST(ModelSmoothPatches, APlanarPatchKeepsTheTangentsOfItsLines) {
  // A bump over a square: its border stays in the plane of the floor, and the floor is accepted.
  ModelBuilder builder;
  const std::array<Vec3, 4> corners{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)};
  const Vec3 top(0.1, 0.05, 0.8);
  Loop floor;
  std::array<std::uint32_t, 4> spokes{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& next = corners[(i + 1) % 4];
    floor.push_back(
        {builder.line(LineType::kHermite, {corners[i], 0.6 * (corners[i] + next), next}), false});
    spokes[i] = builder.line(LineType::kHermite, {corners[i], top});
  }
  builder.patch(PatchType::kPlanar, {floor});
  for (std::size_t i = 0; i < 4; ++i)
    builder.patch(PatchType::kNielson,
                  {{floor[i], {spokes[(i + 1) % 4], false}, {spokes[i], true}}});
  EXPECT_TRUE(diagnoseModel(builder.model).empty());
  compareAlongLines(builder.model, 32, [&](std::uint32_t line, double t, double angle) {
    if (std::ranges::find(spokes, line) != spokes.end()) {
      EXPECT_LT(angle, 1e-6) << line << " at " << t;
    }
  });
}

TEST(ModelSmoothPatches, ACubeKeepsItsEdges) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  for (Patch& patch : model.patches) patch.type = PatchType::kGregory;
  for (Line& line : model.lines) line.type = LineType::kHermite;
  const ResolvedModel resolved(model);
  for (std::size_t i = 0; i < model.lines.size(); ++i)
    EXPECT_TRUE(resolved.curve(LineId(i)).isStraight());
}

TEST(ModelSmoothPatches, AnOctahedronBecomesRound) {
  ModelBuilder builder;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 x((octant & 1) != 0 ? 1 : -1, 0, 0);
    const Vec3 y(0, (octant & 2) != 0 ? 1 : -1, 0);
    const Vec3 z(0, 0, (octant & 4) != 0 ? 1 : -1);
    const auto edge = [&](const Vec3& from, const Vec3& to) -> OrientedLine {
      for (std::uint32_t i = 0; i < builder.model.lines.size(); ++i) {
        const std::vector<Vec3> ends = pointsOf(builder.model, builder.model.lines[i]);
        if (ends[0] == from && ends[1] == to) return {i, false};
        if (ends[0] == to && ends[1] == from) return {i, true};
      }
      return {builder.line(LineType::kHermite, {from, to}), false};
    };
    builder.patch(PatchType::kNielson, {{edge(x, y), edge(y, z), edge(z, x)}});
  }
  EXPECT_TRUE(diagnoseModel(builder.model).empty());
  int places = 0;
  compareAlongLines(builder.model, 64, [&](std::uint32_t line, double t, double angle) {
    ++places;
    EXPECT_LT(angle, 1e-6) << line << " at " << t;
  });
  EXPECT_EQ(places, 12 * 64);
  const ResolvedModel resolved(builder.model);
  for (const Patch& patch : builder.model.patches) {
    const Vec3 centre = unitSurface(resolved, patch).evaluate({1.0 / 3.0, 1.0 / 3.0}).position;
    EXPECT_GT(glm::length(centre), 0.8);  // 0.577 with straight lines
  }
}

}  // namespace
}  // namespace tetrafront::testing
