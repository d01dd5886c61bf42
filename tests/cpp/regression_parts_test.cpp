/// @file Forty bodies as CAD programs export them, each hard for another reason. With the options of the package, each
/// must be remeshed and filled with the figures of its row. CPU time of all is below a minute without sanitizers;
/// scripts/lib/suites.mjs leaves them out of the run with sanitizers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "boundary/boundary.h"
#include "support/hard_shapes.h"
#include "support/mesh_validator.h"
#include "support/part_shapes.h"
#include "support/shapes.h"
#include "support/stored_fingerprints.h"
#include "support/surface_measures.h"
#include "tetrafront/mesher.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront::testing {
namespace {

/// Figures that a part must reach.
struct PartFigures {
  double dihedral = 20.0;     ///< smallest dihedral angle, at least; degrees
  double radiusRatio = 0.8;   ///< mean radius ratio, at least
  double volumeError = 5e-3;  ///< |volume / given volume - 1|, at most
};

// Exceptions from the figures above, and what forces them.

/// Most elements lie in one layer between two walls, and have all nodes on them.
const PartFigures kOneLayer{20.0, 0.65};
/// Slender, with a sharp tip.
const PartFigures kSlenderTip{8.0, 0.8};
/// Thin and curved.
const PartFigures kThinCurved{20.0, 0.7};
/// Teeth or fillets with feature lines that are near to each other, or angles below 60 degrees.
const PartFigures kSharp{8.0, 0.75};
/// The wall narrows to a 200th of the radius, and the poor elements there are among few others.
const PartFigures kCrescent{8.0, 0.72};
/// The thread runs out in edges of a few degrees.
const PartFigures kRunOut{4.0, 0.75};

/// Faces meet at this angle, in degrees.
PartFigures atKnifeEdge(double angle) { return {0.4 * angle, 0.5}; }

struct Part {
  std::string name;
  std::function<SurfaceMesh()> make;
  PartFigures figures;
};

std::ostream& operator<<(std::ostream& out, const Part& part) { return out << part.name; }

// ---- the parts -------------------------------------------------------------------------------------

/// A block whose top has steps of these heights, each one further down.
SurfaceMesh staircase(const std::vector<double>& heights) {
  Outline outline{{0.0, 0.0}, {4.0, 0.0}};
  double y = 1.0;
  const auto count = static_cast<double>(heights.size() + 1);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double x = 4.0 * (1.0 - static_cast<double>(i + 1) / count);
    if (i == 0) outline.emplace_back(4.0, y);
    outline.emplace_back(x, y);
    y += heights[i];
    outline.emplace_back(x, y);
  }
  outline.emplace_back(0.0, y);
  return prism({outline, {}}, 2.0);
}

/// The arc around `centre` from one angle to another, in degrees.
Outline arc(const Vec2& centre, double radius, double from, double to, int pieces) {
  Outline result;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = (from + (to - from) * i / pieces) * std::numbers::pi / 180.0;
    result.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return result;
}

Outline joinedOutlines(Outline first, const Outline& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Two shells: the second bounds a cavity or a second body.
SurfaceMesh withShell(SurfaceMesh outer, SurfaceMesh inner, bool isCavity) {
  if (isCavity) turnInsideOut(inner);
  append(outer, inner);
  return outer;
}

SurfaceMesh ball(const Vec3& centre, double radius, int n) {
  SurfaceMesh mesh = geodesicSphere(n);
  scale(mesh, radius);
  translate(mesh, centre);
  return mesh;
}

/// A box with 2 x 2 round cavities.
SurfaceMesh boxWithCavities() {
  SurfaceMesh mesh = gridBox(Vec3(0.0), Vec3(2.0, 2.0, 1.0), {1, 1, 1});
  for (int i = 0; i < 4; ++i) {
    const Vec3 centre(0.5 + i % 2, 0.5 + i / 2, 0.5);
    mesh = withShell(mesh, ball(centre, 0.4, 4), true);
  }
  return mesh;
}

/// Two round disks that meet along a narrow neck: their cylinders are nearly tangent.
SurfaceMesh tangentDisks() {
  const double degrees = std::acos(0.998) * 180.0 / std::numbers::pi;
  const Outline right = arc({0.998, 0.0}, 1.0, degrees - 180.0, 180.0 - degrees, 60);
  // The two arcs share their ends.
  const Outline inner(right.begin() + 1, right.end() - 1);
  return prism({joinedOutlines(arc({-0.998, 0.0}, 1.0, degrees, 360.0 - degrees, 60), inner), {}},
               0.5);
}

/// A cylinder that touches a plate tangentially, with material in the cusps on both sides.
SurfaceMesh cylinderOnPlate() {
  Outline outline{{-2.0, -0.5}, {2.0, -0.5}, {2.0, 0.0}};
  return prism({joinedOutlines(outline, joinedOutlines(arc({0.0, 0.999}, 1.0, -87.5, 267.5, 72),
                                                       {{-2.0, 0.0}})),
                {}},
               1.0);
}

/// The material between a plane and a cylinder that is tangent to it.
SurfaceMesh cusp() {
  Outline outline = arc({0.0, 1.0}, 1.0, -45.0, -90.0, 24);
  outline.emplace_back(std::sqrt(0.5), 0.0);
  return prism({outline, {}}, 0.5);
}

/// Letters of straight strokes on a grid of unit squares, five high.
FlatFace letter(char name) {
  switch (name) {
    case 'E':
      return {{{0, 0},
               {3, 0},
               {3, 1},
               {1, 1},
               {1, 2},
               {2.5, 2},
               {2.5, 3},
               {1, 3},
               {1, 4},
               {3, 4},
               {3, 5},
               {0, 5}},
              {}};
    case 'F':
      return {{{0, 0}, {1, 0}, {1, 2}, {2.5, 2}, {2.5, 3}, {1, 3}, {1, 4}, {3, 4}, {3, 5}, {0, 5}},
              {}};
    case 'A':
      return {{{0, 0}, {0.8, 0}, {1.1, 1}, {1.9, 1}, {2.2, 0}, {3, 0}, {2, 5}, {1, 5}},
              {{{1.25, 1.8}, {1.75, 1.8}, {1.5, 3.8}}}};
    case 'O':
      return {filleted(rectangle({0, 0}, {3, 5}), 1.4, 8),
              {filleted(rectangle({0.8, 0.8}, {2.2, 4.2}), 0.65, 8)}};
    default:
      return {{{1, 0}, {2, 0}, {2, 4}, {3, 4}, {3, 5}, {0, 5}, {0, 4}, {1, 4}}, {}};
  }
}

std::vector<FlatFace> textOf(const std::string& letters) {
  std::vector<FlatFace> text;
  double x = 1.0;
  for (const char name : letters) {
    FlatFace face = letter(name);
    face.outline = shifted(face.outline, {x, 1.0});
    for (Outline& hole : face.holes) hole = shifted(hole, {x, 1.0});
    text.push_back(std::move(face));
    x += 4.0;
  }
  return text;
}

/// A lattice of square struts: `cells` cells along each axis, of size 1.
SurfaceMesh lattice(int cells, double strut) {
  std::vector<double> grid;
  for (int i = 0; i <= cells; ++i) grid.insert(grid.end(), {i - 0.5 * strut, i + 0.5 * strut});
  return blocks(grid, grid, grid, [](int i, int j, int k) {
    // Odd cells of the grid are between struts.
    return i % 2 + j % 2 + k % 2 <= 1;
  });
}

/// A wheel with a round rim, a thin web and a hub.
SurfaceMesh wheel() {
  Outline section{{0.35, 0.15},  {0.2, 0.15},   {0.2, -0.15},
                  {0.35, -0.15}, {0.35, -0.02}, {0.88, -0.02}};
  section = joinedOutlines(section, arc({1.0, 0.0}, 0.12, -162.0, 162.0, 18));
  return revolved(joinedOutlines(section, {{0.88, 0.02}, {0.35, 0.02}}), 90);
}

SurfaceMesh spring(const Outline& section, double pitch, int turns) {
  return swept({section, {}}, 24 * turns,
               [=](double at) { return helixFrame(1.0, pitch, at * turns); });
}

SurfaceMesh helicalGear() {
  const Outline teeth = gear(16, {{0.0, 0.85}, {0.3, 0.85}, {0.42, 1.0}, {0.68, 1.0}, {0.8, 0.85}});
  return swept({teeth, {circle(Vec2(0.0), 0.3, 32)}}, 6, [](double at) {
    const double angle = 0.5 * at;
    return SectionFrame{Vec3(0.0, 0.0, 0.8 * at), Vec3(std::cos(angle), std::sin(angle), 0.0),
                        Vec3(-std::sin(angle), std::cos(angle), 0.0)};
  });
}

/// A quarter of a ring of pipe.
SurfaceMesh pipeBend(double wall) {
  return swept({circle(Vec2(0.0), 0.5, 40), {circle(Vec2(0.0), 0.5 - wall, 40)}}, 16,
               [](double at) {
                 SectionFrame frame = helixFrame(2.0, 0.0, 0.25 * at);
                 return frame;
               });
}

SurfaceMesh perforatedPlate() {
  FlatFace plate{rectangle({0.0, 0.0}, {5.0, 3.0}), {}};
  for (int i = 0; i < 15; ++i) {
    plate.holes.push_back(circle({0.5 + i % 5, 0.5 + i / 5}, 0.42, 24));
  }
  return prism(plate, 0.2);
}

/// A shaft with shoulders; their inner corners have fillets of this radius.
SurfaceMesh shaft(double fillet) {
  Outline section{{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}};
  section = joinedOutlines(section, arc({0.3 + fillet, 0.5 + fillet}, fillet, 270.0, 180.0, 6));
  return revolved(joinedOutlines(section, {{0.3, 1.0}, {0.0, 1.0}}), 40);
}

const std::vector<Part> kParts{
    // Needles.
    {"round_bar", [] { return coarseBar(200, 4.0); }, {}},
    {"slender_cone", [] { return revolved({{0.0, 0.0}, {0.3, 0.0}, {0.0, 4.0}}, 60); },
     kSlenderTip},
    {"latitude_sphere", [] { return latitudeSphere(24, 96); }, {}},
    {"needle_plate", [] { return needlePlate(3, 48, 0.1); }, kOneLayer},
    {"perforated_plate", perforatedPlate, kThinCurved},
    // Fillets.
    {"fillets_1e4",
     [] { return prism({filleted(rectangle({0, 0}, {2, 1}), 1e-4, 8), {}}, 0.5); },
     {}},
    {"fillets_1e2",
     [] { return prism({filleted(rectangle({0, 0}, {2, 1}), 1e-2, 8), {}}, 0.5); },
     {}},
    {"shaft_fillet_1e4", [] { return shaft(1e-4); }, {}},
    {"shaft_fillet_2e2", [] { return shaft(2e-2); }, kSharp},
    // Thin walls.
    {"thin_tube", [] { return coarseTube(100, 0.95, 0.5); }, kOneLayer},
    {"thin_plate", [] { return gridBox(Vec3(0.0), Vec3(1.0, 1.0, 0.02), {1, 1, 1}); }, kOneLayer},
    {"thin_shell", [] { return withShell(geodesicSphere(10), ball(Vec3(0.0), 0.92, 10), true); },
     kThinCurved},
    {"wheel", wheel, kThinCurved},
    {"bent_sheet", [] { return bentSheet(60, 0.08); }, kOneLayer},
    {"pipe_bend", [] { return pipeBend(0.08); }, kThinCurved},
    // Sheets that nearly touch.
    {"comb", [] { return prism({combOutline(2, 0.1, 1e-3, 0.3), {}}, 0.02); }, kSharp},
    {"blocks_1e5_apart",
     [] {
       return withShell(gridBox(Vec3(0.0), Vec3(1.0), {1, 1, 1}),
                        gridBox(Vec3(1.00001, 0.2, 0.1), Vec3(1.8, 0.9, 1.2), {1, 1, 1}), false);
     },
     {}},
    {"balls_1e4_apart",
     [] { return withShell(ball(Vec3(0.0), 1.0, 8), ball(Vec3(2.0001, 0.0, 0.0), 1.0, 8), false); },
     {}},
    {"slit", [] { return slitBlock(1.0, 1); }, {}},
    // Tangent cylinders and cusps.
    {"tangent_disks", tangentDisks, kSharp},
    {"cylinder_on_plate", cylinderOnPlate, kSharp},
    {"cusp", cusp, atKnifeEdge(0.9)},
    {"eccentric_bore",
     [] { return prism({circle(Vec2(0.0), 1.0, 80), {circle({0.295, 0.0}, 0.7, 80)}}, 0.4); },
     kCrescent},
    // Threads, springs and gears.
    {"thread", [] { return screwThread(1, 16); }, kRunOut},
    {"spring", [] { return spring(circle(Vec2(0.0), 0.15, 12), 0.5, 2); }, {}},
    {"flat_spring", [] { return spring(rectangle({-0.2, -0.04}, {0.2, 0.04}), 0.1, 2); },
     kOneLayer},
    {"spur_gear",
     [] {
       return prism({gear(24, {{0.0, 0.85}, {0.3, 0.85}, {0.42, 1.0}, {0.58, 1.0}, {0.7, 0.85}}),
                     {circle(Vec2(0.0), 0.3, 48)}},
                    0.2);
     },
     kOneLayer},
    {"helical_gear", helicalGear, kSharp},
    {"ratchet", [] { return prism({gear(24, {{0.0, 0.85}, {0.05, 1.0}}), {}}, 0.2); }, kSharp},
    // Text.
    {"embossed_text",
     [] { return embossed(rectangle({0, 0}, {21, 7}), textOf("TEFAO"), 2.0, 0.5); }, kSharp},
    {"engraved_text", [] { return embossed(rectangle({0, 0}, {9, 7}), textOf("FO"), 1.0, -0.05); },
     kSharp},
    // Lattices and cavities.
    {"lattice", [] { return lattice(2, 0.2); }, kOneLayer},
    {"cavities", boxWithCavities, {}},
    {"island", [] { return blockWithIsland(1); }, {}},
    // Steps.
    {"step_1e5", [] { return staircase({1e-5}); }, {}},
    {"steps_1e2_to_1e4", [] { return staircase({1e-2, 1e-3, 1e-4}); }, {}},
    // Knife edges and tips.
    {"wedge", [] { return wedge(4.0, 1); }, atKnifeEdge(4.0)},
    {"lens",
     [] {
       return prism(
           {joinedOutlines(arc({0.0, -2.0}, 2.05, 77.0, 103.0, 40),
                           {{0.0, 2.05 * std::sin(77.0 * std::numbers::pi / 180.0) - 2.0}}),
            {}},
           0.5);
     },
     atKnifeEdge(13.0)},
    {"blade", [] { return twistedBlade(8, 8, 0.04); }, atKnifeEdge(11.0)},
    {"bent_ring", [] { return torusKnot(1, 2, 48, 12); }, {}},
};

// ---- the test --------------------------------------------------------------------------------------

class RegressionParts : public ::testing::TestWithParam<Part> {};

double diagonalOfPart(const SurfaceMesh& mesh) {
  const Bounds bounds = boundsOf(mesh);
  return glm::length(bounds.high - bounds.low);
}

TEST_P(RegressionParts, ReachesItsFigures) {
  const SurfaceMesh given = GetParam().make();
  const PartFigures& figures = GetParam().figures;
  ASSERT_GT(enclosedVolume(given), 0.0);

  RemeshOptions automatic;
  automatic.dropPoorDetails = true;
  SurfaceRemesher remesher(given.points, given.triangles, {}, {}, automatic);
  while (!remesher.advance(1U << 16U)) {
  }
  const SurfaceRemesh& remeshed = remesher.result();
  ASSERT_TRUE(remeshed.diagnostics.empty());
  EXPECT_LE(remeshed.deviation, remeshed.tolerance);
  EXPECT_LE(remeshed.tolerance, 4.1e-3 * diagonalOfPart(given));

  SurfaceMesh surface;
  surface.points = remeshed.points;
  surface.triangles = remeshed.triangles;
  for (const auto& [edge, count] : countEdges(surface)) ASSERT_EQ(count, 2U);
  std::vector<Diagnostic> found;
  closeBoundary(surface, BoundarySource::kGivenSurface, found, InnerShells::kCavities);
  for (const Diagnostic& each : found) {
    EXPECT_NE(each.severity, Severity::kError) << static_cast<int>(each.code);
  }
  const double volumeError = std::fabs(enclosedVolume(surface) / enclosedVolume(given) - 1.0);
  EXPECT_LE(volumeError, figures.volumeError);

  MeshRun run(remeshed.points, remeshed.triangles, MeshOptions{});
  while (run.advance(5000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(complaintAbout(run.volume(), run.surface()), "");
  expectStoredFingerprint(GetParam().name, given, run.fingerprint());
  double dihedral = 180.0;
  double ratioSum = 0.0;
  double elements = 0.0;
  for (const RegionStatistics& region : run.statistics().regions) {
    dihedral = std::min(dihedral, region.minDihedral);
    ratioSum += region.meanRadiusRatio * region.tetrahedra;
    elements += region.tetrahedra;
  }
  EXPECT_GE(dihedral, figures.dihedral);
  EXPECT_GE(ratioSum / elements, figures.radiusRatio);

  RecordProperty("given triangles", static_cast<int>(countTriangles(given)));
  RecordProperty("triangles", static_cast<int>(countTriangles(surface)));
  RecordProperty("smallest angle", std::to_string(remeshed.smallestAngle));
  RecordProperty("deviation / tolerance", std::to_string(remeshed.deviation / remeshed.tolerance));
  RecordProperty("volume error", std::to_string(volumeError));
  RecordProperty("tetrahedra", static_cast<int>(elements));
  RecordProperty("smallest dihedral", std::to_string(dihedral));
  RecordProperty("mean radius ratio", std::to_string(ratioSum / elements));
}

INSTANTIATE_TEST_SUITE_P(Mesher, RegressionParts, ::testing::ValuesIn(kParts),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace tetrafront::testing
