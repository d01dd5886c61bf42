#pragma once

/// @file Records the decisions of the fronts, for teaching and for finding faults. docs/TRACE.md describes the events.

#include "tetrafront/experiment.h"
#include "tetrafront/mesher.h"

namespace tetrafront {

/// Lets a run record its steps, those of lines and patches and the sweeps of the optimizer included: MeshRun::takeTrace()
/// returns them. Call it before the first MeshRun::advance(). The front fills everything, and the optimizer does not cut the
/// mesh into tiles; apart from that the mesh stays the same, bit for bit, unless `experiment` changes the rules. A step takes
/// about 40 bytes, in a stretched size field 60. Programs that do not call this function do not contain the code that records.
void recordFront(MeshRun& run, const FrontExperiment& experiment = {});

}  // namespace tetrafront
