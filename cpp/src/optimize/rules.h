#pragma once

/// @file The constants that decide what the optimizer changes and when it stops. Each was set by measurements on spheres, cubes,
/// CAD parts, and thin and graded models, by the element shapes and the time.

#include <array>
#include <cstddef>

#include "optimize/edge_removal.h"

namespace tetrafront {

// Whole meshes: which steps of the schedule are worthwhile.

/// Mean relative edge length above which edges are split from a lower limit on: the region is about
/// one and a half elements thick, or its interior began without nodes. The sum of costs alone would
/// accept too few nodes there.
inline constexpr double kSparse = 1.13;
inline constexpr double kSplitAllOfSparse = 1.4;
/// In thin walls, collapses would remove the new nodes again. Interiors with a longer mean edge are
/// not walls and have room for them.
inline constexpr double kEmpty = 1.3;
inline constexpr double kMaxEdgeInWalls = 1.65;
/// Number of elements that miss a target above which a mesh no longer counts as small.
inline constexpr double kFewMissing = 500.0;
/// Fraction of the mesh. If improvements changed more, as in gaps one edge wide, shape sweeps would
/// visit that part again and again.
inline constexpr double kMuchChanged = 0.02;

// Steps of the schedule: their repetitions, and the shares of poor elements at which they give up.

/// Largest numbers of rounds, by default and with Optimization::kThorough.
inline constexpr int kMaxRounds = 10;
inline constexpr int kMaxThoroughRounds = 8;
/// Rounds end when splits and collapses together are fewer than this fraction of the free nodes.
inline constexpr double kQuietRound = 0.1;
/// Rounds also end when they lower the mean cost by less than this fraction: in narrow gaps, splits
/// and collapses can undo each other for ever.
inline constexpr double kMinRoundGain = 0.01;
inline constexpr double kMinThoroughGain = 0.001;
/// Passes of improvements; of steps that improve few of the many elements they visit; and of the last shape sweeps.
inline constexpr int kImprovementPasses = 8;
inline constexpr int kPatientPasses = 4;
inline constexpr int kPolishPasses = 4;
/// If one element in fifty misses 18 degrees, improving them costs a surface of needles a tenth of
/// its mean radius ratio and leaves more elements below 30 than before; the lower targets are used
/// instead.
inline constexpr double kManyLow = 0.02;
/// If no more than this fraction misses 30 degrees, those elements are improved even if 18 was
/// given up.
inline constexpr double kManyHigh = 0.04;
/// The same of small meshes, which take little time anyway, and with Optimization::kThorough.
inline constexpr double kManyOfFew = 0.1;
inline constexpr double kManyThorough = 0.01;
/// If shape sweeps leave most elements flat, the boundary consists of needles: nodes between them make far more flat elements than there were.
inline constexpr double kManyFlat = 0.5;

// Tiles.

/// Largest number of elements of a tile: its nodes and elements stay in the cache of a core, and several thousand of them are worth the
/// seams around it.
inline constexpr std::size_t kTileElements = 24'000;
/// Meshes of fewer elements are optimized as a whole.
inline constexpr std::size_t kMinTiled = 60'000;
/// The part of a range of elements below a cut. The second cut, of the elements at seams, must be elsewhere.
inline constexpr double kFirstCut = 0.5;
inline constexpr double kSecondCut = 0.42;

// Density: splits and collapses of edges.

/// Edges longer than this many target lengths are split; anything in 1.15 .. 1.45 gives the same
/// meshes.
inline constexpr double kMaxSparseEdge = 1.3;
/// Much too long edges are split even if that makes elements worse, up to this cost (bulk measure:
/// a mean ratio of 0.4). The following sweeps improve their shape. Without this, interiors that
/// begin without nodes stay half empty, and others lose mean radius ratio.
inline constexpr double kBearable = 3.0;
/// New edges may have any length if the mean cost of a node's elements exceeds this (bulk measure:
/// a mean ratio of 0.2). The front may leave nodes against boundary triangles that are much larger
/// than the target size. All edges are long there, and the mesh only improves without those nodes.
inline constexpr double kHopeless = 10.0;
inline constexpr std::size_t kMaxSplitRing = kMaxRing - 1;

// Moves of nodes.

/// A move shorter than this fraction of an edge does not justify recomputing the star's costs. A
/// move longer than the second counts as a change that neighbours should visit again.
inline constexpr double kMinNodeMove = 0.0005;
inline constexpr double kChangingMove = 0.01;
/// A move must lower the cost by this fraction: far above rounding, far below what a report shows. Otherwise it is halved, up to
/// kMoveHalvings times.
inline constexpr double kMinMoveGain = 1e-6;
inline constexpr int kMoveHalvings = 4;
/// Gradients of the worst elements that decide the direction of a move.
inline constexpr std::size_t kMaxGradients = 24;

// Improvements of single elements.

/// Edges with more elements around them are not removed.
inline constexpr std::size_t kRepairRing = 9;
/// Smallest relative gains, by the worst of all elements that a change touches: of swaps and collapses, and of compound changes,
/// which spoil more elements.
inline constexpr double kRepairGain = 1e-3;
inline constexpr double kCompoundGain = 1e-2;
/// Largest number of elements that a node inserted into a poor element replaces.
inline constexpr std::size_t kMaxRepairCavity = 60;
inline constexpr EdgeRemovalOptions kRepairOptions{true, kRepairGain};

// The queue of poor elements.

/// Improvement also stops if a pass leaves more than this fraction of the poor elements that it
/// visited, and more than that fraction of all elements: in a gap or wedge without room for nodes,
/// improving one element spoils others.
inline constexpr double kMaxLeft = 0.8;
inline constexpr double kFewPoor = 0.005;
/// Compound changes per step: a fixed number, plus one per this many elements.
inline constexpr std::size_t kMinCompounds = 100;
inline constexpr std::size_t kElementsPerCompound = 200;
/// Last-resort tries per step: a fixed number, plus one per this many elements.
inline constexpr std::size_t kMinLastResortTries = 60;
inline constexpr std::size_t kElementsPerLastResortTry = 1000;

// Last resorts.

/// Edges with more elements around them are not removed.
inline constexpr std::size_t kLastResortRing = 9;
/// A change must lower the sum of the fourth powers of costs by this fraction to be worth the
/// elements that it spoils. Costs are 1 at the target, so the fraction has no unit.
inline constexpr double kLastResortGain = 1e-2;

}  // namespace tetrafront
