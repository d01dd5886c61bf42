#pragma once

/// @file Options of a run and their defaults.

#include <cstdint>

namespace tetrafront {

/// Largest growth of sizes per unit of distance. Elements could not follow a larger one.
inline constexpr double kMaxGrowth = 10.0;

/// Largest gradation: ratio of the sizes of neighbouring elements.
inline constexpr double kMaxGradation = 10.0;

/// Largest stretching. Boundary layers need far less, and squares and products of lengths with this ratio stay
/// accurate in doubles.
inline constexpr double kMaxStretching = 1e6;

/// Order in which faces leave the front (step F4).
enum class FrontOrder : std::uint8_t {
  kLayered = 0,        ///< buckets of similar size, smallest first; within a bucket layer by layer,
                       ///< and within a layer tile by tile in space
  kSmallestFirst = 1,  ///< the face that forms the smallest element is next, as in the paper
  kFirstIn = 2,        ///< the face that joined the front first is next; sizes do not count
  kRandom = 3,         ///< pseudo-random, the same in each run; sizes do not count
};

/// Effort for the shape of the elements after the front has closed.
enum class Optimization : std::uint8_t {
  kNone = 0,      ///< none: the mesh of the front
  kFast = 1,      ///< swaps and moves, then improvement of the worst elements
  kDefault = 2,   ///< also splits and collapses, until nothing improves
  kThorough = 3,  ///< more rounds, and dihedral angles of 35 to 130 degrees as the target
};

/// Meaning of a shell that lies inside a region and is not connected to the region's outer shell.
enum class InnerShells : std::uint8_t {
  kCavities = 0,  ///< bounds a cavity; a shell inside the cavity bounds a region again, and so on
  kRegions = 1,   ///< bounds a region of its own, whose mesh conforms to the region around it
  /// Bounds a region of its own if its triangles face the same way as those of the shell around it: outward, as those of
  /// every solid; else a cavity. Drawn patches, which may face any way, bound cavities.
  kByOrientation = 2,
};

/// What fills the deep inside of regions.
enum class Interior : std::uint8_t {
  kFront = 0,  ///< the front, as everywhere
  kLattice =
      1,  ///< lattices, where sizes are nearly constant over some elements and not stretched; only the rest is left to the front
  kAuto =
      2,  ///< lattices in regions that are expected to have some thousands of elements, else the front
};

struct MeshOptions {
  /// Uniform element size, in model units, > 0; 0 if there is none. It replaces the nodes and tetrahedra of the
  /// background grid, but not its sources, and caps the sizes inside a given surface.
  ///
  /// The triangles of a given surface are kept. If they are larger than the target size (by this option, a grid
  /// or sources), the elements next to them are as large, and the sizes fall inwards by `growth`, at most 0.5,
  /// per unit of distance. SurfaceRefiner splits such triangles beforehand.
  double size = 0.0;
  /// Growth of the element size per unit of distance from the edges of a given surface, up to `size` or the size
  /// of a background grid; 0 to kMaxGrowth.
  double growth = 0.3;
  /// Largest ratio of the sizes of neighbouring elements in a background grid, above 1, up to kMaxGradation. The
  /// size of each node is capped at the size of its neighbour + (gradation - 1) x distance. A grid that already
  /// satisfies this is not changed. 0: no limit. Sources have a growth of their own.
  double gradation = 1.3;
  InnerShells innerShells = InnerShells::kByOrientation;
  FrontOrder order = FrontOrder::kLayered;
  /// Uses a cheap test to discard faces that cannot cross a new element, before the full test
  /// (second section 6 (b) of the paper; the boxes of (a) are part of the search). Without the
  /// filters, the mesh is the same but takes longer; benchmarks show their effect.
  bool filters = true;
  Optimization optimization = Optimization::kDefault;
  /// Work with lattices grows with the surface rather than with the volume. A run that records its front makes none.
  Interior interior = Interior::kAuto;
  /// Largest number of tetrahedra; above it, or above what fits into the memory that a program can address, a run ends with
  /// kTooManyElements. The peak memory of a run is about 150 bytes per tetrahedron of the front and 10 bytes per tetrahedron of a
  /// lattice, and WebAssembly has at most 4 GB. The default protects native programs, whose address space is no limit.
  std::uint32_t maxTetrahedra = 20'000'000;
  /// Largest volume of a tetrahedron, in cubed model units; 0 for no limit. It caps all sizes, and tetrahedra that are
  /// larger nonetheless are split. Only tetrahedra that rounding does not allow to be split remain.
  double maxVolume = 0.0;
  /// For tests: skips the front and fills the whole volume by the exact fill, which otherwise comes last.
  bool exactFillOnly = false;
};

}  // namespace tetrafront
