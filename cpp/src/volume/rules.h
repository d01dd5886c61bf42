#pragma once

/// @file The numbers that steer the front. Each was set by measurement on spheres, cubes, tori,
/// thin and graded bodies, judged by what the front leaves open, its speed and the shape of the
/// elements; lengths are in units of the local size h.

#include <array>
#include <cstdint>

namespace tetrafront {

/// How strict the front is with a face; a face that fails under one class waits in the next.
struct RuleClass {
  double searchRadius;  ///< candidates come from this far around the ideal point
  double minQuality;    ///< least mean ratio, relative to the best that the base's shape admits
  double faceDistance;  ///< a new node keeps this far from faces it does not touch
  double nodeDistance;  ///< and this far from other nodes, for a full height
  bool newNodes;        ///< may new nodes be placed at all?
  std::uint32_t maxTries;
};

inline constexpr std::array<RuleClass, 5> kRuleClasses{{
    {.searchRadius = 0.9,
     .minQuality = 0.35,
     .faceDistance = 0.35,
     .nodeDistance = 0.8,
     .newNodes = true,
     .maxTries = 12},
    {.searchRadius = 2.0,
     .minQuality = 0.2,
     .faceDistance = 0.2,
     .nodeDistance = 0.57,
     .newNodes = true,
     .maxTries = 12},
    {.searchRadius = 3.0,
     .minQuality = 0.07,
     .faceDistance = 0.08,
     .nodeDistance = 0.4,
     .newNodes = true,
     .maxTries = 12},
    {.searchRadius = 5.0,
     .minQuality = 0.01,
     .faceDistance = 0.0,
     .nodeDistance = 0.4,
     .newNodes = true,
     .maxTries = 40},
    {.searchRadius = 8.0,
     .minQuality = 0.0,
     .faceDistance = 0.0,
     .nodeDistance = 0.4,
     .newNodes = false,
     .maxTries = 40},
}};

/// Peraire's clamp of the field's size by the base face's own, so that a jump in the field is met
/// step by step.
inline constexpr double kMinSizePerBase = 0.55;
inline constexpr double kMaxSizePerBase = 2.0;

/// The field is asked this far in front of the centroid, in units of the face's size.
inline constexpr double kFieldLookAhead = 0.4;

/// New edges aim at this part of the wanted length: nodes that find no room there take existing ones
/// farther away, so that the mean edge comes out longer than the one aimed at.
inline constexpr double kEdgePerTarget = 0.97;

/// The ideal point stands sqrt(h^2 - R^2) above the centroid, R the base's circumradius within
/// these bounds, and never lower than the least height.
inline constexpr double kMinCircumradius = 0.4;
inline constexpr double kMaxCircumradius = 0.95;
inline constexpr double kMinIdealHeight = 0.3;

/// Heights tried for a new node. Lower ones are a fallback: their weight falls with the sixth
/// power, else sizes shrink step by step and the front dives.
inline constexpr std::array<double, 5> kHeights{1.0, 0.85, 0.7, 0.55, 0.4};
/// Weight of a new node's mean ratio against that of existing nodes.
inline constexpr double kNewNodeWeight = 0.85;
/// Bonus on the mean ratio per side that a candidate closes, besides the base.
inline constexpr double kClosingBonus = 0.03;
/// The apex over a side whose dihedral angle is below 90 degrees comes first, down to this
/// fraction of the class's cubed quality.
inline constexpr double kWedgeQualityFactor = 0.05;
/// Added to the score, cubed mean ratios being at most about 1, so that these go first.
inline constexpr double kWedgeBonus = 1.0;
inline constexpr double kPocketBonus = 10.0;

/// Deviations from the rules for another try at a position where the front stalled.
struct RuleVariant {
  double sizeFactor = 1.0;
  double newNodeWeight = kNewNodeWeight;
  bool newNodes = true;
  bool smallestFirst = false;
};

}  // namespace tetrafront
