// Recording lines and patches changes no bit of the surface. The events are read and checked in tests/unit/web/surface-trace.test.ts,
// those of a front that stalls in tests/unit/package/stalled-front.test.ts.

#include "surface/surface_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <ios>
#include <iterator>
#include <string>
#include <vector>

#include "support/gallery.h"
#include "support/models.h"
#include "surface/patch_boundary.h"
#include "surface/planar_front.h"
#include "surface/surface_mesher.h"
#include "surface/surface_trace.h"

namespace tetrafront::testing {
namespace {

/// A size of which the largest extent of the model has twelve.
SizeField coarseField(const Model& model) {
  Vec3 low = model.points.front();
  Vec3 high = low;
  for (const Vec3& point : model.points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const Vec3 extent = high - low;
  return SizeField::uniform(std::max({extent.x, extent.y, extent.z}) / 12.0);
}

template <class Mesher>
SurfaceMesh finished(Mesher& mesher) {
  while (mesher.advance(1000) == MeshStatus::kRunning) continue;
  return mesher.mesh();
}

TEST(SurfaceRecorder, RecordedSurfacesAreTheSame) {
  for (const GalleryModel& sample : galleryModels()) {
    SCOPED_TRACE(sample.name);
    const SizeField field = coarseField(sample.model);
    SurfaceMesher plain(sample.model, field);
    const SurfaceMesh expected = finished(plain);
    TraceBytes bytes;
    SurfaceRecorder recorder(bytes);
    BasicSurfaceMesher<RecordingSurfaceTrace> recording(
        sample.model, field, MeshOptions{}.maxTetrahedra, RecordingSurfaceTrace{&recorder});
    const SurfaceMesh recorded = finished(recording);
    EXPECT_EQ(recorded.points, expected.points);
    EXPECT_EQ(recorded.triangles, expected.triangles);
    EXPECT_EQ(recorded.sides, expected.sides);
    EXPECT_FALSE(bytes.take().empty());
  }
}

/// A needle, as a slender cone is cut open along a seam: both long sides are the same nodes of the surface, which no edge may connect.
/// Edges across it are much shorter than the size, so that no new node fits between them.
PatchBoundary needle() {
  constexpr int kLength = 4;
  PatchBoundary boundary;
  PlanarMesh& mesh = boundary.mesh;
  const auto add = [&](const Vec2& at, std::uint32_t surfaceNode) {
    mesh.addNode(at, Vec3(at.x, at.y, 0.0), 1.0);
    mesh.surfaceNodes.back() = NodeId(surfaceNode);
    if (surfaceNode == boundary.seam.size()) boundary.seam.push_back(mesh.positions.back());
  };
  constexpr double kSlope = 0.0625;
  for (int i = 0; i <= kLength; ++i) add(Vec2(i, -i * kSlope), static_cast<std::uint32_t>(i));
  add(Vec2(kLength + 0.25, 0.0), kLength + 1U);
  for (int i = kLength; i > 0; --i) add(Vec2(i, i * kSlope), static_cast<std::uint32_t>(i));
  mesh.boundaryCount = static_cast<std::uint32_t>(mesh.plane.size());
  for (std::uint32_t i = 0; i < mesh.boundaryCount; ++i)
    mesh.sides.push_back({PlanarNodeId(i), PlanarNodeId((i + 1) % mesh.boundaryCount)});
  return boundary;
}

/// Returns the bytes of a file of tests/fixtures, which is `made` if fingerprints are stored.
std::vector<std::uint8_t> fixture(const std::string& name, const std::vector<std::uint8_t>& made) {
  const std::string path = TETRAFRONT_FIXTURES "/" + name;
  if (std::getenv("TETRAFRONT_STORE_FINGERPRINTS") != nullptr) {
    std::ofstream file(path, std::ios::binary);
    std::ranges::copy(made, std::ostreambuf_iterator<char>(file));
  }
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(SurfaceRecorder, AStalledFrontIsRecordedToItsEnd) {
  const Model square = polygonModel({squareCorners(Vec3(0.0), 1.0)});
  const ResolvedModel resolved(square);
  const PatchSurface plane(resolved, square.patches.front());
  const SizeField field = SizeField::uniform(1.0);
  const PatchMetric metric(plane, field);
  PatchBoundary boundary = needle();
  TraceBytes bytes;
  SurfaceRecorder recorder(bytes);
  recorder.numbered(DividedLines{});
  recorder.patch(PatchId(0U), boundary, true, false);
  PlanarMesh& mesh = boundary.mesh;
  BasicPlanarFront<RecordingSurfaceTrace> front(metric, mesh, RecordingSurfaceTrace{&recorder});
  while (!front.advance(100)) continue;
  EXPECT_TRUE(front.hasStalled());
  EXPECT_FALSE(mesh.triangles.empty());
  recorder.ended(mesh, PlanarFrontEnd::kStalled);
  const std::vector<std::uint8_t> recorded = bytes.take();
  EXPECT_EQ(fixture("stalled-front.bin", recorded), recorded);
}

}  // namespace
}  // namespace tetrafront::testing
