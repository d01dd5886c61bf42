// Whole runs over solids of every patch type: closed, verified by an independent checker, and of
// the volume that the divergence theorem gives for the patches themselves.

#include <gtest/gtest.h>

#include <cmath>

#include "model/patch_surface.h"
#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"

namespace tetrafront::testing {
namespace {

/// Cells per direction of the midpoint rule below; its error is of second order.
constexpr int kCells = 200;

/// Returns the flux of x / 3 through a curved patch, away from `inside`, by the midpoint rule.
double fluxThrough(const UnitSurface& surface, const Vec3& inside) {
  const bool triangle = surface.shape() == UnitShape::kTriangle;
  const double cell = 1.0 / kCells;
  double flux = 0.0;
  const auto add = [&](double xi, double eta, double weight) {
    const SurfacePoint point = surface.evaluate({xi * cell, eta * cell});
    flux += weight * cell * cell / 3.0 *
            glm::dot(point.position - inside, glm::cross(point.alongXi, point.alongEta));
  };
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < (triangle ? kCells - j : kCells); ++i) {
      if (!triangle) {
        add(i + 0.5, j + 0.5, 1.0);
        continue;
      }
      add(i + 1.0 / 3.0, j + 1.0 / 3.0, 0.5);
      if (i + j + 1 < kCells) add(i + 2.0 / 3.0, j + 2.0 / 3.0, 0.5);
    }
  }
  return std::fabs(flux);
}

/// Returns the volume of a solid whose patches all face away from the mean of its points.
double exactVolume(const Model& model) {
  Vec3 inside(0.0);
  for (const Vec3& point : model.points) inside += point;
  inside /= static_cast<double>(model.points.size());
  const ResolvedModel resolved(model);
  double volume = 0.0;
  for (const Patch& patch : model.patches)
    volume += fluxThrough(unitSurface(resolved, patch), inside);
  return volume;
}

/// Meshes the solid and returns the mesh's volume.
double meshedVolume(const Model& model, double size) {
  MeshOptions options;
  options.size = size;
  // The volume does not depend on the elements' shapes.
  options.optimization = Optimization::kNone;
  MeshRun run(model, {}, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  for (const Diagnostic& diagnostic : run.diagnostics())
    EXPECT_NE(diagnostic.severity, Severity::kError) << static_cast<int>(diagnostic.code);
  EXPECT_EQ(complaintAbout(run.volume(), run.surface()), "");
  return enclosedVolume(run.surface());
}

void expectMeshes(const Model& model) {
  const double exact = exactVolume(model);
  const double coarse = std::fabs(meshedVolume(model, 0.3) - exact);
  const double fine = std::fabs(meshedVolume(model, 0.12) - exact);
  EXPECT_LT(coarse, 0.05 * exact);
  EXPECT_LT(fine, 0.006 * exact);
}

TEST(MesherPatchTypes, TetrahedraOfTriangularPatchesMeshToTheirVolume) {
  for (const PatchType type : {PatchType::kIsoparametricTriangle,
                               PatchType::kBarnhillGregoryNielson, PatchType::kNielson}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(static_cast<int>(type) * 100 + static_cast<int>(seed));
      expectMeshes(randomBentTetrahedron(seed, 0.15, type));
    }
  }
}

TEST(MesherPatchTypes, BoxesOfQuadrilateralPatchesMeshToTheirVolume) {
  for (const PatchType type :
       {PatchType::kSerendipity, PatchType::kCoons, PatchType::kGregory, PatchType::kLoft}) {
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      SCOPED_TRACE(static_cast<int>(type) * 100 + static_cast<int>(seed));
      expectMeshes(randomBentBox(seed, 0.2, type));
    }
  }
}

}  // namespace
}  // namespace tetrafront::testing
