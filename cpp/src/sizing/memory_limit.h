#pragma once

/// @file How many elements fit into the memory that a program can address.

#include <cstddef>
#include <cstdint>
#include <limits>

namespace tetrafront {

/// Bytes that this program can address: 4 GB in WebAssembly.
inline constexpr double kAddressableBytes =
    static_cast<double>(std::numeric_limits<std::size_t>::max());

/// Peak memory of a run, estimated from cubes of 0.8 and 15.6 million elements: per element that the front makes, per element of a
/// lattice, and, if lattices leave only a layer at the surface to the front, per triangle of the surface.
inline constexpr double kBytesPerFrontElement = 150.0;
inline constexpr double kBytesPerLatticeElement = 10.0;
inline constexpr double kBytesPerTriangle = 2500.0;

/// Returns how many elements a run can have in this many bytes. `hasLattices`: whether lattices may fill most of the inside.
[[nodiscard]] double elementsWithin(double bytes, double triangles, bool hasLattices);

/// Returns how many elements a front can make if there are `others` already, of lattices or of other regions.
[[nodiscard]] std::uint32_t frontElementsBeside(double bytes, std::size_t others);

}  // namespace tetrafront
