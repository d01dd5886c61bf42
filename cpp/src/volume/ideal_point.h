#pragma once

/// @file Step F5.1 (Löhner & Parikh 1988, section 2): the best position of the fourth node of an element over a face.

#include "tetrafront/vec3.h"
#include "volume/front.h"
#include "volume/unit_space.h"

namespace tetrafront {

/// Measures of the base face in unit space, computed once and used by all steps.
struct BaseFace {
  Vec3 a;
  Vec3 b;
  Vec3 c;
  Vec3 normal;  ///< towards the empty side; length: twice the area
  double doubleArea;
  double sumSquares;  ///< sum of the squared edge lengths
  double size;        ///< root mean square of the edge lengths
  Vec3 centroid;
  Vec3 unitNormal;
};

struct IdealPoint {
  Vec3 position;
  double height;  ///< above the centroid
  double size;    ///< element size h
};

[[nodiscard]] BaseFace describeBase(const Front& front, const NodeTriple& nodes,
                                    const UnitSpace& space);

/// Returns the unit space of a face. Queries the size field a short distance in front of the face's
/// centroid, on the empty side. `sizeFactor` scales the size found.
[[nodiscard]] UnitSpace unitSpaceOf(const Front& front, const NodeTriple& nodes,
                                    const SizeField& field, FieldHint& hint, double sizeFactor);

/// Returns the ideal point for a target edge length, both in unit space. If the base is equilateral
/// and of that size, the element is the regular tetrahedron; otherwise it is isosceles.
[[nodiscard]] IdealPoint placeIdealPoint(const BaseFace& base, double targetEdge);

/// Returns the cube of the mean ratio 12 (3V)^(2/3) / (sum of squared edge lengths) of base and
/// apex: 1 for the regular tetrahedron, 0 for a degenerate one and for an apex behind the base. The
/// cube needs no root.
[[nodiscard]] double cubedMeanRatio(const BaseFace& base, const Vec3& apex);

/// Returns the largest cubedMeanRatio() that any apex over this base reaches.
[[nodiscard]] double bestCubedMeanRatio(const BaseFace& base);

}  // namespace tetrafront
