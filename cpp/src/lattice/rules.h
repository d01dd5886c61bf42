#pragma once

/// @file The numbers by which the inside of a region is given to lattices.

#include <cstdint>

namespace tetrafront {

/// Distance that lattices keep from the boundary and from each other / size there. The best of 1.2, 1.6 and 2.0: a nearer
/// lattice leaves the front too little room, a farther one too much work.
inline constexpr double kLatticeDepth = 1.2;

/// Largest edge of a cube of the survey / size in it.
inline constexpr double kCubePerSize = 4.0;

/// Volume of a regular tetrahedron / cube of its edge.
inline constexpr double kVolumePerCube = 0.117851130197757934;

/// Elements that a class of sizes must be expected to have. Smaller islands save nothing.
inline constexpr double kMinElements = 500.0;

/// Expected elements of a mesh from which on lattices are used by default. Smaller ones are soon made by the front alone.
inline constexpr std::uint32_t kLatticeFrom = 10'000;

}  // namespace tetrafront
