#pragma once

/// @file Remeshes a surface that approximates the faces of a model: triangulates the faces on their own surfaces (Löhner &
/// Parikh 1988, sections 4 and 5.2), with the sizes of a remeshing. An order of magnitude faster than changing triangles,
/// and all nodes are on the model.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/task.h"
#include "remesh/remesh_pass.h"
#include "remesh/remesh_steps.h"

namespace tetrafront {

struct ModelRemesh {
  std::optional<RemeshPass> pass;
  std::vector<std::uint32_t> failedFaces;  ///< that cannot be triangulated; ascending
  /// Number of the last triangles, which are those of the given surface: on faces that cannot be triangulated, or that the
  /// model does not have.
  std::size_t givenTriangles = 0;
};

/// Returns the triangulated faces. None if faces cannot be triangulated and the given triangles do not replace them; if the result is
/// not a valid boundary, such as that of solids that touch each other; if the given surface is not that of the model, for example
/// because its patches divide faces; if other sizes than those of the shape are given; or if the work was stopped.
/// `remeshing.model` must not be null.
Task<ModelRemesh> remeshModel(Work& work, const Remeshing& remeshing);

}  // namespace tetrafront
