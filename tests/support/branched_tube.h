#pragma once

/// @file A solid whose patches have holes that are not planar.

#include "tetrafront/model.h"

namespace tetrafront::testing {

/// A closed tube of radius 1 about the z axis, from z = -2 to 2, from which another of radius
/// `branch` about the x axis leaves, up to x = 2.5. Where they meet is a hole of the first tube's
/// patch, bounded by a spline that is an end of the second tube's patch.
Model branchedTube(double branch);

/// Its volume, the splines of the model taken for the circles and the intersection they stand for.
double branchedTubeVolume(double branch);

}  // namespace tetrafront::testing
