#pragma once

/// @file One documented default per field.

#include <cstdint>

namespace tetrafront {

/// In which order faces leave the front (step F4).
enum class FrontOrder : std::uint8_t {
  kLayered = 0,        ///< buckets of like size, smallest first; inside one, layer by layer
  kSmallestFirst = 1,  ///< the paper's: the face forming the smallest element is next
};

struct MeshOptions {
  /// Uniform element size, in model units, > 0. Given, it replaces the background grid of a
  /// model, and caps the interior size of a given surface. 0: not given.
  double size = 0.0;
  /// Growth of the element size per unit of distance from a given surface's edges, >= 0.
  double growth = 0.3;
  FrontOrder order = FrontOrder::kLayered;
  /// More tetrahedra than this are not attempted (kTooManyElements).
  std::uint32_t maxTetrahedra = 50'000'000;
};

}  // namespace tetrafront
