#pragma once

/// @file A solid whose patches have holes that are not planar.

#include "tetrafront/model.h"

namespace tetrafront::testing {

/// A closed tube of radius 1 around the z axis, from z = -2 to 2. A second tube of radius `branch`
/// around the x axis branches off and ends at x = 2.5. The spline along which the tubes meet bounds
/// a hole in the patch of the first tube, and is one end of the patch of the second.
Model branchedTube(double branch);

/// Returns its volume, computed from the exact circles and the exact intersection that the splines
/// approximate.
double branchedTubeVolume(double branch);

}  // namespace tetrafront::testing
