#pragma once

/// @file Step F5.1: where the fourth node of the element over a face would best go.

#include "tetrafront/vec3.h"
#include "volume/front.h"

namespace tetrafront {

/// The base face's measures, computed once and used by all steps.
struct BaseFace {
  Vec3 a;
  Vec3 b;
  Vec3 c;
  Vec3 normal;  ///< towards the empty side; length twice the area
  double doubleArea;
  double sumSquares;  ///< of the side lengths
  double size;        ///< root mean square of the side lengths
  Vec3 centroid;
  Vec3 unitNormal;
};

struct IdealPoint {
  Vec3 place;
  double height;  ///< above the centroid
  double size;    ///< the element size h used
};

[[nodiscard]] BaseFace describeBase(const Front& front, const NodeTriple& nodes);

/// Where the size field is to be asked for this face.
[[nodiscard]] Vec3 fieldQueryPlace(const BaseFace& base);

/// `fieldSize`: what the field asks there. For an equilateral base of that size the point makes
/// the regular tetrahedron; for others an isosceles one.
[[nodiscard]] IdealPoint placeIdealPoint(const BaseFace& base, double fieldSize);

/// Cube of the mean ratio of base and apex, 12 (3V)^(2/3) / sum of squared edges: 1 for the
/// regular tetrahedron, 0 for a flat one or one behind the base. Cubed, it needs no root.
[[nodiscard]] double cubedMeanRatio(const BaseFace& base, const Vec3& apex);

/// The greatest cubedMeanRatio that any apex over this base reaches.
[[nodiscard]] double bestCubedMeanRatio(const BaseFace& base);

}  // namespace tetrafront
