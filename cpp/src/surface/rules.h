#pragma once

/// @file The constants that control the division of lines and the front of a patch. Each was set by measurements on curved and
/// stretched patches, by edge lengths and triangle shapes.

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/tolerance.h"

namespace tetrafront {

// Division of lines (Löhner & Parikh 1988, section 5.1).

/// Relative difference below which two steps are "about equal" (step S3).
inline constexpr double kStepTolerance = 1e-3;
/// In a smooth field, each averaging of S3 halves the error. If it has not converged after this many rounds, it
/// oscillates across a steep change of size, and bisection follows.
inline constexpr int kMaxAverages = 20;
inline constexpr int kMaxBisections = 40;
/// Limit of a step's parameter range, so that the bends of a line are sampled even in a coarse field.
inline constexpr double kMaxStep = 1.0 / 16.0;
/// Simpson's rule over a step and over its halves must agree within this number of sides.
inline constexpr double kLengthTolerance = 1e-5;
inline constexpr int kMaxStepHalvings = 10;
/// A walk with this many stations samples the rest of the line once, at kSamplesAhead parameters. It gives up if the
/// rest alone requires kCertainlyTooMany times the limit of sides.
inline constexpr std::size_t kLongTable = 1U << 14U;
inline constexpr int kSamplesAhead = 1024;
inline constexpr double kCertainlyTooMany = 4.0;

// Fewest sides of lines.

/// A closed line needs three sides to enclose an area. Two lines between the same points need two
/// sides each: one of them could have a single side, but the result must not depend on which one.
inline constexpr std::uint32_t kMinSidesOfClosedLine = 3;
inline constexpr std::uint32_t kMinSidesOfParallelLine = 2;
/// A closed line, or a rim, of a patch with a seam: with fewer sides, an edge could connect a node to both copies of a node of
/// the seam, which are the same node of the surface.
inline constexpr std::uint32_t kMinSidesAtSeam = 6;

/// Largest angle by which an edge of a trimmed face turns along one side: 60 degrees, so that a circle is a hexagon.
inline constexpr double kMaxTurningPerSide = 1.0471975511965976;

/// Growth of the size per unit of distance from an edge of a trimmed face that is divided more finely than the sizes
/// ask for: with it, a node between the two copies of a seam rarely connects to the same node of both.
inline constexpr double kBentEdgeGrowth = 0.25;

// Sizes near short lines.

/// Length of a side / length of the next line's side, below which triangles at both would have angles of less than
/// about 20 degrees.
inline constexpr double kMuchShorter = 0.35;
/// Growth of the size per unit of distance from a short line.
inline constexpr double kShortLineGrowth = 0.5;

// Sizes of tubes.

/// Sections of a tube, and positions around each, at which the size is compared with the circumference.
inline constexpr int kTubeSections = 9;
inline constexpr int kAroundSection = 24;
/// Fewest elements around a tube.
inline constexpr double kFewestAround = 6.0;
/// Growth of the size per unit of distance from a tube.
inline constexpr double kTubeGrowth = 0.5;

// Layout of patches in a plane.

/// Smallest ratio of G's eigenvalues: a triangle of the plane may be stretched 100:1 to become equilateral in
/// space. Beyond this ratio the patch is degenerate, and the shape of a triangle has no meaning.
inline constexpr double kMinEigenvalueRatio = 1e-4;

// The front of a patch.

/// Limits of new edge length / base edge length (Peraire's rule), so that sizes change gradually where the
/// boundary and the field disagree.
inline constexpr double kMinLengthRatio = 0.55;
inline constexpr double kMaxLengthRatio = 2.0;
/// A node within this distance of the ideal point, in lengths of the new edges, replaces it. With this radius
/// and kClearance the mean edge has its target length; larger values give longer edges.
inline constexpr double kCaptureRadius = 0.55;
/// Minimum distance of a new node from every edge of the front, in lengths of the new edges.
inline constexpr double kClearance = 0.55;
/// Search radius around the ideal point, in lengths of the new edges.
inline constexpr double kSearchRadius = 1.7;
/// Factor of the search radius in the second pass. The last pass searches the whole front.
inline constexpr double kSearchGrowth = 4.0;
inline constexpr std::uint8_t kLastPass = 2;
/// In the first pass, triangles of a worse shape are rejected: later more of the front is known.
inline constexpr double kMinFirstPassShape = 0.3;
/// The second height tried for a new node / ideal height.
inline constexpr double kLowerHeight = 0.6;
/// Height at which the metric is sampled / length of the new edges: about that of the triangle's centre.
inline constexpr double kCentreHeight = 0.35;
/// Margin of the search box / its width. The tree rounds; without a margin it could miss edges.
inline constexpr double kSearchBoxMargin = Tolerance::kCoincidence;

// Flips.

/// A flip must lower the cost by this fraction. Otherwise rounding could cause endless flips.
inline constexpr double kMinPlanarFlipGain = 1e-6;
/// Cosine of the angle between the normals of two triangles. A flip must not fold them more sharply than this, or
/// than before: where a bend is coarsely divided, the better shapes may cut across it.
inline constexpr double kSharpFoldCosine = 0.5;

// Removed nodes and split edges.

/// An interior node with an edge shorter than this is needless; length / target length.
inline constexpr double kShortEdge = 0.6;
/// An interior node with fewer triangles is needless: its angles are too wide.
inline constexpr std::size_t kFewTriangles = 5;
/// The removal of a node must not make an edge longer than this, unless the node had a longer one; length /
/// target length.
inline constexpr double kMaxEdgeOfFan = 1.4;
/// Longer edges are split; length / target length.
inline constexpr double kLongEdge = 1.6;
/// Triangles with a smaller angle, about 33 degrees, are improved.
inline constexpr double kPoorSine = 0.54;
/// Sine of 25 degrees. An angle this wide is good enough if the change also removes a node or splits a long edge.
inline constexpr double kFairSine = 0.42261826174069944;
/// A change must raise the smallest sine by this much.
inline constexpr double kMinSineGain = 0.01;
/// Positions tried for a new node on the way from the middle of the edge to the middle of the opposite corners.
inline constexpr std::array<double, 3> kSplitFractions{0.5, 0.35, 0.65};

// Moves of nodes.

/// Fractions of the move to the target position that are tried.
inline constexpr std::array<double, 2> kMoves{1.0, 0.4};
/// Steps of a search / shortest edge at the node.
inline constexpr std::array<double, 3> kSearchSteps{0.3, 0.12, 0.04};
/// Moves with one step length before the next length.
inline constexpr int kSearchRounds = 3;
/// A move of a search must raise the rating by this much.
inline constexpr double kMinRatingGain = 1e-3;
/// Nodes whose triangles have a higher mean cost are polished. The cost 1.1 is a mean shape of 0.95.
inline constexpr double kMaxGoodCost = 1.1;

// The surface as a whole.

/// Rounds of halving sides that intersect others because they are too coarse for the bends of their lines. Each round
/// divides the error of a chord by four; loops that still intersect do so in the model.
inline constexpr int kMaxHalvingRounds = 8;
/// Rounds of triangulating again the patches that would coincide with others. Only the chords of the patches of one
/// round can cause the next one.
inline constexpr int kMaxSeparationRounds = 3;

}  // namespace tetrafront
