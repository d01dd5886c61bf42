#pragma once

/// @file The steps of a remeshing: remeshing a surface, dropping details across which triangles would be poor, and choosing the
/// best surface.

#include <vector>

#include "base/task.h"
#include "remesh/remesh_pass.h"
#include "remesh/remesh_targets.h"
#include "tetrafront/remesh.h"
#include "tetrafront/trimmed_model.h"

namespace tetrafront {

/// What all steps of a remeshing share; it must outlive them.
struct Remeshing {
  const TrackedSurface& given;
  const ReferenceSurface& reference;  ///< of the given surface
  GivenSizes sizes;
  const RemeshOptions& options;
  RemeshLengths lengths;
  const bool& isStopped;
  const TrimmedModel* model =
      nullptr;  ///< whose faces the given surface approximates, if that is known
};

/// A remeshed surface, from which details may have been dropped.
struct SimplifiedSurface {
  RemeshPass pass;
  double deviation = 0.0;  ///< sum over all steps
  double ofChosen = 0.0;   ///< the part of it that details below RemeshOptions::dropDetails have
  std::vector<MergedDetail> merged;
};

/// Returns true if the surface has no problems, and the work was not stopped.
bool isComplete(const SurfaceRemesh& result);

/// Remeshes the given surface and drops the details that the options say. The deviations of all steps, except the one of chosen
/// details, add up to at most the tolerance.
Task<SimplifiedSurface> remeshAndDrop(Work& work, const Remeshing& remeshing);

}  // namespace tetrafront
