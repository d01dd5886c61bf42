/// @file Properties of a surface after every single operation of the remesher, and its envelope.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <vector>

#include "base/task.h"
#include "geom/intersect.h"
#include "geom/measure.h"
#include "remesh/envelope.h"
#include "remesh/guarded_surface.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_schedule.h"
#include "remesh/surface_editor.h"
#include "remesh/triangle_parts.h"
#include "support/hard_shapes.h"
#include "support/part_shapes.h"
#include "support/remeshed.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront::testing {
namespace {

using Corners = std::array<Vec3, 3>;

/// A surface with an editor, for tests that make random operations.
class EditedSurface {
 public:
  EditedSurface(const SurfaceMesh& mesh, double tolerance, double size,
                const std::vector<std::uint8_t>& isSettled = {})
      : mesh_(mesh), reference_(mesh_, FeatureRules{}), sizes_(SizeField::uniform(size)) {
    Job<> job([this](Work& work) { return reference_.prepare(work); });
    job.finish();
    SurfaceLimits limits;
    limits.tolerance = tolerance;
    surface_.emplace(reference_, limits, size);
    editor_.emplace(*surface_, sizes_, isSettled);
  }

  [[nodiscard]] const SurfaceComplex& complex() const { return surface_->complex(); }
  [[nodiscard]] const ReferenceSurface& reference() const { return reference_; }
  [[nodiscard]] SurfaceEditor& editor() { return *editor_; }

 private:
  SurfaceMesh mesh_;
  ReferenceSurface reference_;
  RemeshSizes sizes_;
  std::optional<GuardedSurface> surface_;
  std::optional<SurfaceEditor> editor_;
};

/// Returns true if two triangles of the surface intersect: tests all pairs.
bool anyIntersect(const SurfaceMesh& mesh) {
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    for (std::uint32_t u = 0; u < t; ++u) {
      if (intersectImproperly(numberedTriangle(mesh, TriangleId(t)),
                              numberedTriangle(mesh, TriangleId(u))))
        return true;
    }
  }
  return false;
}

/// Returns true if the triangles at a feature edge enclose at least half the angle with this cosine.
bool isSharp(const SurfaceComplex& complex, HalfEdgeId halfEdge, double creaseCosine) {
  const auto [from, to, apex] = complex.nodesOf(halfEdge);
  std::vector<HalfEdgeId> edge;
  complex.collectEdge(from, to, edge);
  if (edge.size() != 2) return true;
  std::array<Vec3, 2> normals{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [a, b, c] = complex.cornersOf(triangleOf(edge[i]));
    normals[i] = glm::normalize(glm::cross(b - a, c - a));
  }
  const double angle = std::acos(std::clamp(glm::dot(normals[0], normals[1]), -1.0, 1.0));
  return angle >= 0.5 * std::acos(creaseCosine) - 1e-9;
}

/// Makes all changes of a remeshing.
void remeshAll(EditedSurface& edited) {
  RemeshSchedule schedule(edited.editor());
  Job<> job([&](Work& work) { return schedule.run(work); });
  job.finish();
}

/// The triangles of a sphere are a third of the target size.
TEST(RemeshSchedule, LeavesSettledTriangles) {
  const SurfaceMesh given = geodesicSphere(12);
  EditedSurface all(given, 1e-2, 0.4);
  remeshAll(all);
  EXPECT_LT(surfaceOf(all.complex()).triangles.size(), given.triangles.size() / 2);

  std::vector<std::uint8_t> isSettled(given.points.size() / 3, 1);
  EditedSurface none(given, 1e-2, 0.4, isSettled);
  remeshAll(none);
  EXPECT_EQ(surfaceOf(none.complex()).points, given.points);
  EXPECT_EQ(surfaceOf(none.complex()).triangles, given.triangles);
}

/// A sphere with triangles of the target size, sheared around one pole.
TEST(RemeshSchedule, ChangesOnlyWhatIsNotSettled) {
  SurfaceMesh given = geodesicSphere(12);
  std::vector<std::uint8_t> isSettled(given.points.size() / 3, 1);
  for (const NodeId node : IdRange<NodeId>(isSettled.size())) {
    const Vec3 p = pointOf(given, node);
    const double turn = 10.0 * (p.z - 0.9);
    if (turn <= 0.0) continue;
    isSettled[node.index()] = 0;
    given.points[3 * node.index()] = p.x * std::cos(turn) - p.y * std::sin(turn);
    given.points[3 * node.index() + 1] = p.x * std::sin(turn) + p.y * std::cos(turn);
  }
  EditedSurface edited(given, 2e-2, 0.1, isSettled);
  remeshAll(edited);
  const SurfaceMesh made = surfaceOf(edited.complex());
  const auto poorest = [](const SurfaceMesh& mesh) {
    double largest = 0.0;
    for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh)))
      largest = std::max(largest, largestCosineOf(cornersOf(mesh, t)));
    return largest;
  };
  EXPECT_LT(poorest(made), poorest(given) - 0.1);
  std::vector<Corners> before;
  std::vector<Corners> after;
  const auto collectLower = [](const SurfaceMesh& mesh, std::vector<Corners>& lower) {
    for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
      const Corners corners = cornersOf(mesh, t);
      if (std::ranges::all_of(corners, [](const Vec3& p) { return p.z < 0.0; }))
        lower.push_back(corners);
    }
  };
  collectLower(given, before);
  collectLower(made, after);
  ASSERT_FALSE(before.empty());
  EXPECT_TRUE(after == before);
}

TEST(RemeshAbsorb, PutsTheApexOnTheLine) {
  const SurfaceMesh given = cubeWithCaps(1e-5);
  EditedSurface edited(given, 1e-3, 0.2);
  const SurfaceComplex& complex = edited.complex();
  const NodeId apex(8U);
  EXPECT_EQ(complex.kindOf(apex), NodeKind::kSmooth);
  EXPECT_FALSE(edited.editor().absorb(NodeId(5U), NodeId(6U)));
  ASSERT_TRUE(edited.editor().absorb(NodeId(4U), NodeId(5U)));
  EXPECT_EQ(complex.kindOf(apex), NodeKind::kLine);
  EXPECT_FALSE(complex.areJoined(NodeId(4U), NodeId(5U)));
  const SurfaceComplex::LineNeighbours line = complex.lineNeighbours(apex);
  ASSERT_TRUE(line.areComplete());
  EXPECT_EQ(std::min(line.before, line.after), NodeId(4U));
  EXPECT_EQ(std::max(line.before, line.after), NodeId(5U));
  const SurfaceMesh now = surfaceOf(complex);
  EXPECT_TRUE(errorsOf(now, InnerShells::kCavities).empty());
  EXPECT_NEAR(enclosedVolume(now), 1.0, 1e-5);
}

/// A flat pillow: two triangles above, and four around a node below. The other diagonal of the two is below this node, so that
/// they would not intersect the four, but pass over them.
TEST(RemeshFlip, PassesOverNoNode) {
  constexpr double kHeight = 0.02;
  const auto pillow = [](double middle) {
    SurfaceMesh mesh;
    mesh.points = {-1.0,    0.0, kHeight, 0.0,      -0.6, -kHeight, 1.0,   0.0,
                   kHeight, 0.0, 0.6,     -kHeight, 0.0,  0.0,      middle};
    mesh.triangles = {0, 1, 2, 0, 2, 3, 4, 1, 0, 4, 2, 1, 4, 3, 2, 4, 0, 3};
    return mesh;
  };
  EditedSurface above(pillow(0.0), 0.1, 1.0);
  EXPECT_FALSE(above.editor().flip(NodeId(0U), NodeId(2U)));
  EXPECT_GT(enclosedVolume(surfaceOf(above.complex())), 0.0);
  // The flip is possible if the node is below the other diagonal.
  EditedSurface below(pillow(-2.0 * kHeight), 0.1, 1.0);
  EXPECT_TRUE(below.editor().flip(NodeId(0U), NodeId(2U)));
  EXPECT_GT(enclosedVolume(surfaceOf(below.complex())), 0.0);
}

class RemeshOperations : public ::testing::TestWithParam<Body> {};

TEST_P(RemeshOperations, EachKeepsTheSurfaceValid) {
  const SurfaceMesh given = GetParam().make();
  const double tolerance = 0.01 * diagonalOf(given);
  EditedSurface edited(given, tolerance, 0.1 * diagonalOf(given));
  const SurfaceComplex& complex = edited.complex();
  std::mt19937_64 random(3);
  const auto below = [&](std::size_t count) {
    return static_cast<std::uint32_t>(random() % count);
  };
  const CollapseRule anyCollapse{100.0, 0.0, false};
  int made = 0;
  for (int i = 0; i < 200; ++i) {
    const TriangleId t(below(complex.triangleSlots()));
    if (!complex.isAlive(t)) continue;
    const std::uint32_t k = below(3);
    const NodeId a = complex.nodesOf(t)[k];
    const NodeId b = complex.nodesOf(t)[(k + 1) % 3];
    bool isMade = false;
    switch (below(6)) {
      case 0:
        isMade = edited.editor().split(a, b, 0.3 + 0.1 * below(5));
        break;
      case 1:
        isMade = edited.editor().collapse(a, b, anyCollapse);
        break;
      case 2:
        isMade = edited.editor().flip(a, b);
        break;
      case 3:
        isMade = edited.editor().smooth(a);
        break;
      case 4:
        isMade = edited.editor().absorb(a, b);
        break;
      default:
        isMade = edited.editor().improve(a);
    }
    if (!isMade) continue;
    ++made;
    const SurfaceMesh now = surfaceOf(complex);
    ASSERT_FALSE(anyIntersect(now)) << "operation " << i;
    for (const auto& [edge, count] : countEdges(now)) ASSERT_EQ(count % 2, 0U) << "operation " << i;
  }
  EXPECT_GT(made, 30);
  const SurfaceMesh now = surfaceOf(complex);
  EXPECT_TRUE(errorsOf(now, InnerShells::kCavities).empty());
  EXPECT_LE(sampledDistance(now, given, 300), tolerance);
  // Given nodes are within the tolerance of the surface, and corners have not moved.
  for (const NodeId node : IdRange<NodeId>(countNodes(given))) {
    const Vec3 point = pointOf(given, node);
    EXPECT_LE(distanceTo(now, point), tolerance * (1.0 + 1e-9));
    if (edited.reference().isCorner(node)) {
      EXPECT_TRUE(complex.isUsed(node) && complex.pointOf(node) == point);
    }
  }
  // The points of every stretch of a feature line are within the tolerance of its edge.
  double length = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    for (std::uint32_t k = 0; complex.isAlive(t) && k < 3; ++k) {
      const HalfEdgeId halfEdge = halfEdgeOf(t, k);
      const StretchId id = complex.stretchOf(halfEdge);
      if (id.isNone()) continue;
      const Stretch& stretch = complex.stretch(id);
      const auto [from, to, apex] = complex.nodesOf(halfEdge);
      const NodeId begin = stretch.from;
      const NodeId end = begin == from ? to : from;
      const FeatureLine& line = edited.reference().line(stretch.line);
      EXPECT_LE(line.squaredDeviation(stretch.begin, stretch.end, complex.pointOf(begin),
                                      complex.pointOf(end)),
                tolerance * tolerance * (1.0 + 1e-9));
      length += stretch.end - stretch.begin;
      EXPECT_TRUE(isSharp(complex, halfEdge, line.creaseCosine));
    }
  }
  // The stretches cover all lines: each counts once per triangle at its edge.
  double expected = 0.0;
  for (const FeatureLine& line : edited.reference().lines()) {
    expected += line.length() * static_cast<double>(line.patches.size());
  }
  EXPECT_NEAR(length, expected, 1e-9 * expected);
}

INSTANTIATE_TEST_SUITE_P(Remesh, RemeshOperations,
                         ::testing::Values(Body{"cube", [] { return gridCube(2); }},
                                           Body{"sphere", [] { return geodesicSphere(4); }},
                                           Body{"tube", [] { return coarseTube(16, 0.6, 2.0); }},
                                           Body{"needle_plate",
                                                [] { return needlePlate(1, 12, 0.1); }},
                                           Body{"needle_star", [] { return needleDrum(40, 5); }},
                                           Body{"blade", [] { return twistedBlade(6, 3, 0.02); }},
                                           Body{"barrel",
                                                [] {
                                                  return solidOfRevolution(
                                                      {{0.8, 0.0}, {1.0, 0.5}, {0.8, 1.0}}, 24, 1);
                                                }},
                                           Body{"shared_edge", [] { return cubesSharingEdge(); }},
                                           Body{"thin_plate", [] { return thinPlate(4, 0.02); }}),
                         [](const auto& tested) { return tested.param.name; });

TEST(RemeshEnvelope, AcceptsOnlyTrianglesThatAreNearEverywhere) {
  // A cylinder of 24 facets. Random triangles near it: if one is accepted, every point of it is near.
  const SurfaceMesh given = coarseTube(24, 0.6, 2.0);
  ReferenceSurface reference(given, FeatureRules{});
  Job<> job([&reference](Work& work) { return reference.prepare(work); });
  job.finish();
  const double tolerance = 0.02;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    const TriangleId t(static_cast<std::uint32_t>(random() % countTriangles(given)));
    const SmoothPatchId patch = reference.patchOf(t);
    if (reference.patch(patch).isPlanar) continue;
    const Vec3 centre = centroidOf(cornersOf(given, t));
    Corners corners{};
    for (Vec3& corner : corners) {
      const Vec3 offset(0.3 * any(random), 0.3 * any(random), 0.3 * any(random));
      corner = reference.nearest(centre + offset, patch, 10.0, t).position;
    }
    const NearestPoint below = reference.nearest(centroidOf(corners), patch, tolerance, t);
    if (!proveWithin(reference, corners, patch, tolerance, below).isProven) {
      ++refused;
      continue;
    }
    ++accepted;
    for (int n = 0; n < 50; ++n) {
      double u = 0.5 + 0.5 * any(random);
      double v = 0.5 + 0.5 * any(random);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vec3 p = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
      EXPECT_LE(distanceTo(given, p), tolerance * (1.0 + 1e-9));
    }
  }
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace tetrafront::testing
