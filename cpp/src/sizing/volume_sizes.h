#pragma once

/// @file Element sizes for the largest permitted volume of a tetrahedron.

#include <span>
#include <vector>

namespace tetrafront {

/// Returns the edge length with which few tetrahedra of a mesh exceed `volume`; 0 if the volume is 0, which means no
/// limit.
[[nodiscard]] double sizeForVolume(double volume);

/// Returns the same for each volume.
[[nodiscard]] std::vector<double> sizesForVolumes(std::span<const double> volumes);

}  // namespace tetrafront
