#pragma once

/// @file Meshes the surfaces of valid models.

#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "support/models.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"
#include "tetrafront/status.h"

namespace tetrafront::testing {

struct MeshedSurface {
  SurfaceMesh mesh;
  std::vector<PatchSummary> patches;
};

/// Meshes the surface of a model in slices of `budget`. The calling test fails if there is a diagnostic.
MeshedSurface meshSurface(const Model& model, const SizeField& field, std::uint32_t budget = 1000);

/// Returns the mesh alone.
SurfaceMesh meshOf(const Model& model, const SizeField& field, std::uint32_t budget = 1000);

/// Returns the mesh for a uniform size.
SurfaceMesh meshOf(const Model& model, double size);

}  // namespace tetrafront::testing
