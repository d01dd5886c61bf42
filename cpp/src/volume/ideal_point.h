#pragma once

/// @file Step F5.1: where the fourth node of the element over a face would best go.

#include "tetrafront/vec3.h"
#include "volume/front.h"
#include "volume/unit_space.h"

namespace tetrafront {

/// The base face's measures in unit space, computed once and used by all steps.
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
  Vec3 position;  ///< in unit space
  double height;  ///< above the centroid
  double size;    ///< the element size h used
};

[[nodiscard]] BaseFace describeBase(const Front& front, const NodeTriple& nodes,
                                    const UnitSpace& space);

/// The unit space of a face: asks the size field a little in front of its centroid, on the empty
/// side. `sizeFactor` scales what it answers.
[[nodiscard]] UnitSpace unitSpaceOf(const Front& front, const NodeTriple& nodes,
                                    const SizeField& field, FieldHint& hint, double sizeFactor);

/// `targetEdge`: what the field asks there, in unit space. For an equilateral base of that size the point makes
/// the regular tetrahedron; for others an isosceles one.
[[nodiscard]] IdealPoint placeIdealPoint(const BaseFace& base, double targetEdge);

/// Cube of the mean ratio of base and apex, 12 (3V)^(2/3) / sum of squared edges: 1 for the
/// regular tetrahedron, 0 for a flat one or one behind the base. Cubed, it needs no root.
[[nodiscard]] double cubedMeanRatio(const BaseFace& base, const Vec3& apex);

/// The maxRadius cubedMeanRatio that any apex over this base reaches.
[[nodiscard]] double bestCubedMeanRatio(const BaseFace& base);

}  // namespace tetrafront
