#include "support/meshed_models.h"

#include <gtest/gtest.h>

#include <vector>

#include "model/face_loops.h"
#include "model/parametric.h"
#include "surface/trimmed_mesher.h"

namespace tetrafront::testing {
namespace {

Vec3 positionAt(const std::vector<double>& points, std::size_t node) {
  return {points[3 * node], points[3 * node + 1], points[3 * node + 2]};
}

}  // namespace

SurfaceMesh meshOfModel(const TrimmedModel& model, double size) {
  const SizeField field = SizeField::uniform(size);
  TrimmedMesher mesher(model, field);
  while (mesher.advance(1U << 30U) == MeshStatus::kRunning) {
  }
  EXPECT_TRUE(mesher.diagnostics().empty());
  return mesher.takeMesh();
}

ModelTriangles modelTriangles(const TrimmedModel& model, double size) {
  const SurfaceMesh mesh = meshOfModel(model, size);
  std::vector<ParameterBox> boxes;
  for (const TrimmedFace& face : model.faces) boxes.push_back(FaceLoops(model, face).box());
  ModelTriangles triangles;
  for (std::uint32_t t = 0; t < mesh.trianglePatch.size(); ++t) {
    const std::uint32_t face = mesh.trianglePatch[t];
    const FaceSurface& surface = model.surfaces[model.faces[face].surface];
    const auto corner = [&](std::uint32_t k) {
      return positionAt(mesh.points, mesh.triangles[3 * t + k]);
    };
    const Vec2 middle =
        closestParameters(surface, boxes[face], (corner(0) + corner(1) + corner(2)) / 3.0);
    const Vec2 extent = boxes[face].high - boxes[face].low;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3 position = corner(k);
      const Vec2 uv = closestParametersFrom(
          surface, {boxes[face].low - extent, boxes[face].high + extent}, position, middle);
      triangles.points.insert(triangles.points.end(), {position.x, position.y, position.z});
      triangles.parameters.insert(triangles.parameters.end(), {uv.x, uv.y});
      triangles.triangles.push_back(3 * t + k);
    }
    triangles.faces.push_back(face);
  }
  return triangles;
}

}  // namespace tetrafront::testing
