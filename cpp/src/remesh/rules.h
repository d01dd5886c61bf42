#pragma once

/// @file The constants that decide which details a remeshing drops, and which of several remeshings it keeps. Each was set by
/// measurements on public CAD parts, STL and STEP.

namespace tetrafront {

/// Smallest angle, in degrees, below which poor details are dropped.
inline constexpr double kPoorAngle = 10.0;
/// Width of a detail / size below which triangles across it have a smaller angle: the sine of it.
inline constexpr double kPoorWidth = 0.1736;
/// Mean radius ratio below which triangles are poor everywhere, not across a few details: dropping those is of no use.
inline constexpr double kPoorRatio = 0.8;
/// Mean radius ratio that a larger smallest angle may cost.
inline constexpr double kRatioCost = 0.015;
/// Mean radius ratio from which on triangles are good enough on average.
inline constexpr double kFineRatio = 0.92;
/// Merges of poor details, each followed by a remeshing around them: a merge brings other lines closer. A remeshing may make
/// triangles better even if nothing is merged.
inline constexpr int kMaxPoorMerges = 3;
/// Smallest angle, in degrees, below which a triangle of a remeshed surface changes in the next remeshing, too; and the number
/// of layers of triangles around it that change with it.
inline constexpr double kUnsettledAngle = 20.0;
inline constexpr int kUnsettledDepth = 2;
/// Share of the given triangles at which poor details to drop are strips of needles, whose merged lines would be ragged.
inline constexpr double kNeedleShare = 0.05;
/// Details that are dropped at any share: surfaces of a few triangles have steps, too.
inline constexpr double kFewDetails = 50.0;
/// Shares of the tolerance: of the merges of details of the given surface, and of the first remeshing after them, or without
/// them; of the merges of poor details of a remeshed surface, at most, and of the remeshing around them.
inline constexpr double kGivenMergeShare = 0.2;
inline constexpr double kFirstShareAfterMerges = 0.5;
inline constexpr double kFirstShare = 0.6;
inline constexpr double kMergeShare = 0.3;
inline constexpr double kNextShare = 0.06;

}  // namespace tetrafront
