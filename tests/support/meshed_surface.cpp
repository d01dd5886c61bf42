#include "support/meshed_surface.h"

#include <gtest/gtest.h>

#include "model/check_model.h"
#include "surface/surface_mesher.h"

namespace tetrafront::testing {

MeshedSurface meshSurface(const Model& model, const SizeField& field, std::uint32_t budget) {
  EXPECT_TRUE(diagnoseModel(model).empty());
  SurfaceMesher mesher(model, field);
  MeshStatus status = MeshStatus::kRunning;
  while (status == MeshStatus::kRunning) status = mesher.advance(budget);
  EXPECT_EQ(status, MeshStatus::kDone);
  EXPECT_TRUE(mesher.diagnostics().empty());
  MeshedSurface meshed{{}, mesher.patchSummaries()};
  meshed.mesh = mesher.takeMesh();
  return meshed;
}

SurfaceMesh meshOf(const Model& model, const SizeField& field, std::uint32_t budget) {
  return meshSurface(model, field, budget).mesh;
}

SurfaceMesh meshOf(const Model& model, double size) {
  return meshOf(model, SizeField::uniform(size));
}

}  // namespace tetrafront::testing
