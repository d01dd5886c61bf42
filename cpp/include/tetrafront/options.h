#pragma once

/// @file One documented default per field.

#include <cstdint>

namespace tetrafront {

/// The most by which sizes may grow per unit of distance: no element could follow more.
inline constexpr double kMostGrowth = 10.0;

/// The most by which sizes may grow from one element to the next.
inline constexpr double kMostGradation = 10.0;

/// The most by which elements may be stretched: far beyond any layer of air along a wing; squares and products of
/// such lengths stay in doubles.
inline constexpr double kMostStretching = 1e6;

/// In which order faces leave the front (step F4).
enum class FrontOrder : std::uint8_t {
  kLayered = 0,        ///< buckets of like size, smallest first; inside one, layer by layer, and
                       ///< each layer part by part of the space it is in
  kSmallestFirst = 1,  ///< the paper's: the face forming the smallest element is next
};

/// How much work goes into the shape of the elements after the front.
enum class Optimization : std::uint8_t {
  kNone = 0,      ///< the mesh as the front leaves it
  kFast = 1,      ///< swaps and moves, then repair of the worst elements
  kDefault = 2,   ///< with splits and collapses too, until they come to rest
  kThorough = 3,  ///< with more rounds, and repair towards higher angles: 35 to 130 degrees
};

/// What a closed part of the boundary bounds that lies within a body and shares no line with it.
enum class EnclosedBodies : std::uint8_t {
  kCavities = 0,  ///< an empty space; a part within that, a body again, and so on
  kRegions = 1,   ///< a region of its own: every space is filled, and fits what is around it
};

struct MeshOptions {
  /// Uniform element size, in model units, > 0. Given, it replaces the nodes and tetrahedra of the
  /// background grid, but not its sources, and caps the sizes within a given surface. 0: not given.
  ///
  /// The triangles of a given surface stay: where they are larger than wanted (by this, a grid or
  /// sources), so are the elements beside them, and sizes fall inwards by `growth` per unit of
  /// distance, at most 0.5. refineSurface() divides such triangles first.
  double size = 0.0;
  /// Growth of the element size per unit of distance from a given surface's edges, up to `size` or what a
  /// background grid asks for, 0 to kMostGrowth.
  double growth = 0.3;
  /// The most by which sizes may grow from one element to the next, above 1 and up to kMostGradation: nodes of the background
  /// grid that ask for more than their neighbours' size + (gradation - 1) times the distance are
  /// given that. Grids that change more gently are used as they are. 0: so are all. Sources have
  /// a growth of their own.
  double gradation = 1.3;
  EnclosedBodies enclosed = EnclosedBodies::kCavities;
  FrontOrder order = FrontOrder::kLayered;
  /// Whether faces that cannot cross a new element are told from the others cheaply before the
  /// analysis (second section 6 (b) of the paper; (a), boxes, goes with the search for faces). Off,
  /// all faces around are analysed: the same mesh, slower, to show what the filters are worth.
  bool filters = true;
  Optimization optimization = Optimization::kDefault;
  /// More tetrahedra than this are not attempted (kTooManyElements). A run takes about 150 bytes
  /// for each at its peak, and WebAssembly has 4 GB.
  std::uint32_t maxTetrahedra = 20'000'000;
  /// For tests: no front; the whole inside goes to the exact fill that otherwise comes last.
  bool exactFillOnly = false;
};

}  // namespace tetrafront
