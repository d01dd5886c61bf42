/// What ends a front that would advance for ever, and how a stall is described.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "boundary/boundary.h"
#include "support/shapes.h"
#include "topology/tetrahedron.h"
#include "volume/front_watch.h"
#include "volume/region_mesher.h"
#include "volume/stall_diagnostic.h"
#include "volume/volume_mesher.h"

namespace tetrafront {
namespace {

SurfaceMesh withRegions(SurfaceMesh surface) {
  for (std::size_t t = 0; t < surface.triangles.size() / 3; ++t) {
    surface.triangleRegions.insert(surface.triangleRegions.end(), {0, SurfaceMesh::kNoRegion});
  }
  return surface;
}

struct StallOutcome {
  MeshStatus status;
  std::vector<Diagnostic> diagnostics;
  VolumeMesh mesh;
};

VolumeMesh meshOf(const VolumeMesher& mesher) { return toVolumeMesh(mesher.mesh()); }
VolumeMesh meshOf(const RegionMesher& mesher) { return toVolumeMesh(joined(mesher.meshes())); }

template <class Mesher>
StallOutcome runToEnd(Mesher& mesher, std::uint32_t budget) {
  Job<MeshStatus> job([&mesher](Work& work) { return mesher.run(work); });
  while (!job.advance(budget)) {
  }
  return {job.take(), mesher.diagnostics(), meshOf(mesher)};
}

StallOutcome outcomeOf(const SurfaceMesh& boundary, const MeshOptions& options,
                       std::uint32_t budget = 100) {
  const SizeField field = SizeField::uniform(0.3);
  VolumeMesher mesher(boundary, field, options);
  return runToEnd(mesher, budget);
}

/// Without a front, all triangles of an open boundary are left.
MeshOptions withoutFront() {
  MeshOptions options;
  options.exactFillOnly = true;
  return options;
}

/// Triangles of the boundary that are still in the front, in either orientation.
std::set<std::uint32_t> trianglesIn(const VolumeMesh& mesh, const SurfaceMesh& boundary) {
  const auto nodesOf = [](const std::vector<std::uint32_t>& triangles, std::size_t t) {
    return sorted(std::array{triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]});
  };
  std::set<std::array<std::uint32_t, 3>> front;
  for (std::size_t i = 0; i < mesh.front.size() / 3; ++i) front.insert(nodesOf(mesh.front, i));
  std::set<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < boundary.triangles.size() / 3; ++t) {
    if (front.contains(nodesOf(boundary.triangles, t))) triangles.insert(t);
  }
  return triangles;
}

/// The front of a tetrahedron, and elements that fill it.
struct WatchedFront {
  SizeField field = SizeField::uniform(1.0);
  Front front{1.0, Vec3(0.0), FrontOrder::kLayered};
  Elements elements;
  FrontWatch watch{field, 4, 1000};

  WatchedFront() {
    for (const Vec3& corner :
         {Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)}) {
      front.addNode(corner, 0);
    }
    for (const auto& [a, b, c] : kFaceCorners) {
      const NodeTriple inward{NodeId(std::size_t{a}), NodeId(std::size_t{c}),
                              NodeId(std::size_t{b})};
      front.addFace(inward, 0, {}, false);
    }
  }
  /// Adds the element, whose volume is a sixth, and looks.
  void fillOnce() {
    elements.add({NodeId(0U), NodeId(1U), NodeId(2U), NodeId(3U)}, 0);
    watch.look(front, elements, 1);
  }
};

TEST(FrontWatch, AllowsEachFaceOneFailurePerRuleClass) {
  WatchedFront watched;
  watched.watch.begin(watched.front, 10.0);
  watched.fillOnce();
  for (std::size_t step = 0; step < kRuleClasses.size() * 4; ++step) {
    watched.watch.look(watched.front, watched.elements, 1);
    ASSERT_TRUE(watched.watch.isRunning()) << "step " << step;
  }
  watched.watch.look(watched.front, watched.elements, 1);
  EXPECT_EQ(watched.watch.end(), FrontWatch::End::kStuck);
}

TEST(FrontWatch, AllowsRoundingButNoOverfilling) {
  // Six times the enclosed volume, and how often one may fill a sixth of a unit.
  for (const auto& [enclosed, allowed] :
       {std::pair{1.0, 1}, {1.0 - 1e-9, 1}, {2.0, 3}, {-1.0, 0}}) {
    WatchedFront watched;
    watched.watch.begin(watched.front, enclosed);
    for (int i = 0; i < allowed; ++i) watched.fillOnce();
    EXPECT_TRUE(watched.watch.isRunning()) << enclosed;
    watched.fillOnce();
    EXPECT_EQ(watched.watch.end(), FrontWatch::End::kStuck) << enclosed;
  }
}

TEST(FrontWatch, EndsAtTheLargestNumberOfElements) {
  WatchedFront watched;
  watched.watch = FrontWatch(watched.field, 4, 2);
  watched.watch.begin(watched.front, 100.0);
  for (int i = 0; i < 2; ++i) watched.fillOnce();
  EXPECT_TRUE(watched.watch.isRunning());
  watched.fillOnce();
  EXPECT_EQ(watched.watch.end(), FrontWatch::End::kTooManyElements);
  const std::vector<Diagnostic> found = watched.watch.diagnostics(watched.front, watched.elements);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].values, (std::vector{100.0, 2.0})) << "three elements fill 3 %";
}

TEST(VolumeMesher, StallsIfTheBoundaryFacesInward) {
  SurfaceMesh cube = testing::gridCube(3);
  for (std::size_t i = 0; i < cube.triangles.size(); i += 3) {
    std::swap(cube.triangles[i], cube.triangles[i + 1]);
  }
  const SurfaceMesh boundary = withRegions(std::move(cube));
  const StallOutcome outcome = outcomeOf(boundary, {});
  EXPECT_EQ(outcome.status, MeshStatus::kStalled);
  ASSERT_EQ(outcome.diagnostics.size(), 1U);
  EXPECT_EQ(outcome.diagnostics[0].code, DiagnosticCode::kStalled);
  EXPECT_EQ(outcomeOf(boundary, {}, 1).mesh.tetrahedra, outcome.mesh.tetrahedra)
      << "the stopping point must not depend on the slices";
}

SurfaceMesh openCube() {
  SurfaceMesh open = testing::gridCube(4);
  open.triangles.resize(open.triangles.size() - 3);
  return withRegions(std::move(open));
}

TEST(VolumeMesher, StallsIfTheBoundaryIsOpen) {
  const StallOutcome outcome = outcomeOf(openCube(), {});
  EXPECT_EQ(outcome.status, MeshStatus::kStalled);
  ASSERT_EQ(outcome.diagnostics.size(), 1U);
  const Diagnostic& stall = outcome.diagnostics[0];
  EXPECT_EQ(stall.code, DiagnosticCode::kStalled);
  EXPECT_EQ(stall.values, std::vector<double>{static_cast<double>(outcome.mesh.front.size() / 3)});
  EXPECT_FALSE(stall.entities.empty());
}

TEST(VolumeMesher, NamesTrianglesThatAreLeft) {
  const SurfaceMesh boundary = openCube();
  const StallOutcome outcome = outcomeOf(boundary, withoutFront());
  EXPECT_EQ(outcome.status, MeshStatus::kStalled);
  ASSERT_EQ(outcome.diagnostics.size(), 1U);
  EXPECT_EQ(outcome.diagnostics[0].entities.size(), kMaxStalledEntities);
  for (const Entity& entity : outcome.diagnostics[0].entities) {
    EXPECT_EQ(entity.kind, EntityKind::kTriangle);
  }
}

/// The front has not advanced: all triangles of the cube are left.
TEST(StallDiagnostic, NamesTheFirstTrianglesThatAreLeft) {
  const SurfaceMesh boundary = testing::gridCube(2);
  Front front(0.5, Vec3(0.0), FrontOrder::kLayered);
  for (std::uint32_t i = 0; i < testing::nodeCount(boundary); ++i) {
    front.addNode(testing::pointOf(boundary, i), 0);
  }
  std::vector<FaceId> faces;
  for (std::size_t t = 0; t < boundary.triangles.size() / 3; ++t) {
    const NodeTriple n = frontFaceOf(boundary, t);
    faces.push_back(front.addFace({n[1], n[2], n[0]}, 0, {}, false));
  }
  const Diagnostic all = describeStall(front, boundary);
  EXPECT_EQ(all.values, std::vector<double>{static_cast<double>(faces.size())});
  ASSERT_EQ(all.entities.size(), kMaxStalledEntities);
  for (std::uint32_t i = 0; i < kMaxStalledEntities; ++i) {
    EXPECT_EQ(all.entities[i].kind, EntityKind::kTriangle);
    EXPECT_EQ(all.entities[i].index, i);
  }
  for (std::size_t t = 0; t + 1 < faces.size(); ++t) front.removeFace(faces[t]);
  const Diagnostic last = describeStall(front, boundary);
  ASSERT_EQ(last.entities.size(), 1U);
  EXPECT_EQ(last.entities[0].index, faces.size() - 1);
  const NodeTriple n = front.face(faces.back()).nodes;
  const Vec3 centroid = (front.node(n[0]) + front.node(n[1]) + front.node(n[2])) / 3.0;
  EXPECT_LT(glm::length(last.position - centroid), 1e-15);

  // A face that is no triangle of the boundary: its boundary nodes are named.
  front.removeFace(faces.back());
  const NodeId inner = front.addNode(Vec3(0.5), 1);
  front.addFace({n[0], inner, n[1]}, 0, {}, false);
  const Diagnostic nodes = describeStall(front, boundary);
  ASSERT_EQ(nodes.entities.size(), 2U);
  EXPECT_EQ(nodes.entities[0].kind, EntityKind::kSurfaceNode);
  EXPECT_EQ(nodes.entities[0].index, std::min(n[0], n[1]).value);
  EXPECT_EQ(nodes.entities[1].index, std::max(n[0], n[1]).value);

  front.removeFace(front.activeFaces().front());
  EXPECT_TRUE(describeStall(front, boundary).entities.empty());
}

/// Two boxes with a common interface. The one that is meshed last lacks a triangle.
SurfaceMesh openSecondBox() {
  SurfaceMesh boundary = testing::dividedBox({2, 1, 1}, 3);
  std::vector<Diagnostic> diagnostics;
  EXPECT_TRUE(closeBoundary(boundary, BoundarySource::kGivenSurface, diagnostics).isValid);
  std::size_t hole = boundary.triangles.size() / 3;
  while (boundary.isInterface(hole - 1) || boundary.triangleRegions[2 * (hole - 1)] != 1) --hole;
  const auto erase = [&](std::vector<std::uint32_t>& values, std::ptrdiff_t each) {
    const auto first = values.begin() + each * static_cast<std::ptrdiff_t>(hole - 1);
    values.erase(first, first + each);
  };
  erase(boundary.triangles, 3);
  erase(boundary.triangleRegions, 2);
  erase(boundary.trianglePatch, 1);
  return boundary;
}

StallOutcome outcomeOfRegions(const SurfaceMesh& boundary) {
  const SizeField field = SizeField::uniform(0.3);
  const PlainFrontMaker maker;
  RegionMesher mesher(boundary, field, withoutFront(), maker);
  return runToEnd(mesher, 100);
}

TEST(RegionMesher, NamesTrianglesOfTheWholeBoundaryInAStall) {
  const SurfaceMesh boundary = openSecondBox();
  const StallOutcome outcome = outcomeOfRegions(boundary);
  EXPECT_EQ(outcome.status, MeshStatus::kStalled);
  ASSERT_EQ(outcome.diagnostics.size(), 1U);
  const std::set<std::uint32_t> left = trianglesIn(outcome.mesh, boundary);
  ASSERT_FALSE(outcome.diagnostics[0].entities.empty());
  for (const Entity& entity : outcome.diagnostics[0].entities) {
    ASSERT_EQ(entity.kind, EntityKind::kTriangle);
    EXPECT_TRUE(left.contains(entity.index)) << "triangle " << entity.index;
    EXPECT_TRUE(boundary.isInterface(entity.index) ||
                boundary.triangleRegions[2 * entity.index] == 1);
  }
}

TEST(RegionMesher, NamesEachPatchOfADrawnModelOnceInAStall) {
  SurfaceMesh boundary = openSecondBox();
  boundary.sides = {0, 1};
  for (std::uint32_t& patch : boundary.trianglePatch) patch = 42;
  const StallOutcome outcome = outcomeOfRegions(boundary);
  ASSERT_EQ(outcome.diagnostics.size(), 1U);
  ASSERT_EQ(outcome.diagnostics[0].entities.size(), 1U);
  EXPECT_EQ(outcome.diagnostics[0].entities[0].kind, EntityKind::kPatch);
  EXPECT_EQ(outcome.diagnostics[0].entities[0].index, 42U);
}

}  // namespace
}  // namespace tetrafront
