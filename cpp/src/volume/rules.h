#pragma once

/// @file The constants that control the front. Each was set by measurements on spheres, cubes,
/// tori, and thin and graded models, by what the front leaves open, its speed and the element
/// shapes. Lengths are in units of the local size h.

#include <array>
#include <cstddef>
#include <cstdint>

namespace tetrafront {

/// How strict the front is with a face. A face that fails under one class is requeued under the
/// next.
struct RuleClass {
  double searchRadius;  ///< maximum distance of candidates from the ideal point
  double minQuality;    ///< minimum mean ratio, relative to the best possible over the base
  double faceDistance;  ///< minimum distance of a new node from faces that it does not touch
  double nodeDistance;  ///< minimum distance of a new node from other nodes, at full height
  bool newNodes;        ///< whether new nodes may be made
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

/// Peraire's clamp of the field's size by the size of the base face, so that the front follows a
/// jump in the field step by step.
inline constexpr double kMinSizePerBase = 0.55;
inline constexpr double kMaxSizePerBase = 2.0;

/// Distance in front of the centroid at which the size field is queried, in sizes of the face.
inline constexpr double kFieldLookAhead = 0.4;

/// Edge length that new nodes aim at, per target edge length. Where a new node has no room, the
/// element takes an existing node farther away, so the mean edge is longer than the length aimed
/// at.
inline constexpr double kEdgePerTarget = 0.97;

/// The ideal point is sqrt(h^2 - R^2) above the centroid, at least the minimum height. R is the
/// circumradius of the base, clamped to these limits.
inline constexpr double kMinCircumradius = 0.4;
inline constexpr double kMaxCircumradius = 0.95;
inline constexpr double kMinIdealHeight = 0.3;

/// Heights tried for a new node, per ideal height. Lower ones are a fallback, and their weight
/// falls with the sixth power: otherwise sizes would shrink step by step.
inline constexpr std::array<double, 5> kHeights{1.0, 0.85, 0.7, 0.55, 0.4};
/// Weight of the mean ratio of a new node relative to existing nodes.
inline constexpr double kNewNodeWeight = 0.85;
/// The same in some attempts at a pocket.
inline constexpr double kLowNewNodeWeight = 0.6;
/// Bonus on the mean ratio for each edge of the base at which the candidate meets an existing face.
inline constexpr double kClosingBonus = 0.03;
/// The apex of a face with a dihedral angle below 90 degrees to the base is preferred, down to this
/// fraction of the minimum cubed mean ratio of the class.
inline constexpr double kWedgeQualityFactor = 0.05;
/// Added to the score. Cubed mean ratios are at most about 1, so these candidates come first.
inline constexpr double kWedgeBonus = 1.0;
inline constexpr double kPocketBonus = 10.0;

/// Cost limits of the front and of its relaxed rules, as FrontAdvance counts cost: per
/// element, per triangle of the boundary, and a constant for small models. Well shaped boundaries
/// take 1 to 2 per element. Among needles, each face has hundreds of others near it, and the exact
/// fill closes what the rules leave there at less cost. On a plate with a hundred ear-clipped
/// holes, a fifth, a tenth and a fortieth of kFrontCost moved time from the front to the exact fill
/// without reducing the total.
struct CostLimit {
  std::uint64_t perElement;
  std::uint64_t perTriangle;
  std::uint64_t extra;
  [[nodiscard]] std::uint64_t of(std::size_t elements, std::size_t triangles) const {
    return perElement * elements + perTriangle * triangles + extra;
  }
};
inline constexpr CostLimit kRelaxedCost{16, 0, 200'000};
inline constexpr CostLimit kFrontCost{200, 10, 100'000};

/// Changes to the rules for another attempt at a pocket.
struct RuleVariant {
  double sizeFactor = 1.0;
  double newNodeWeight = kNewNodeWeight;
  bool newNodes = true;
  bool smallestFirst = false;
};

}  // namespace tetrafront
