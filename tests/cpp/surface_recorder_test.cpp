// Recording lines and patches changes no bit of the surface. The events are read and checked in tests/unit/web/surface-trace.test.ts.

#include "surface/surface_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/gallery.h"
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

}  // namespace
}  // namespace tetrafront::testing
