#include "volume/ideal_point.h"

#include <algorithm>
#include <cmath>

#include "volume/rules.h"

namespace tetrafront {

BaseFace describeBase(const Front& front, const NodeTriple& nodes, const UnitSpace& space) {
  BaseFace base{};
  base.a = space.toUnit(front.node(nodes[0]));
  base.b = space.toUnit(front.node(nodes[1]));
  base.c = space.toUnit(front.node(nodes[2]));
  const Vec3 ab = base.b - base.a;
  const Vec3 bc = base.c - base.b;
  const Vec3 ca = base.a - base.c;
  base.normal = glm::cross(ab, base.c - base.a);
  base.doubleArea = std::sqrt(glm::dot(base.normal, base.normal));
  base.sumSquares = glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca);
  base.size = std::sqrt(base.sumSquares / 3.0);
  base.centroid = (base.a + base.b + base.c) * (1.0 / 3.0);
  base.unitNormal = base.doubleArea > 0.0 ? base.normal * (1.0 / base.doubleArea) : Vec3(0.0);
  return base;
}

UnitSpace unitSpaceOf(const Front& front, const NodeTriple& nodes, const SizeField& field,
                      FieldHint& hint, double sizeFactor) {
  const auto lookAhead = [](const BaseFace& base) {
    return base.centroid + base.unitNormal * (kFieldLookAhead * base.size);
  };
  const BaseFace plainBase = describeBase(front, nodes, UnitSpace::plain(1.0));
  if (!field.isStretched()) {
    return UnitSpace::plain(field.sizeAt(lookAhead(plainBase), hint) * sizeFactor);
  }
  // The distance ahead depends on the stretching, so query the stretching at the centroid first.
  const Vec3& origin = plainBase.centroid;
  const UnitSpace atCentroid = UnitSpace::stretched(field.tensorAt(origin, hint), origin);
  const Vec3 ahead = atCentroid.toSpace(lookAhead(describeBase(front, nodes, atCentroid)));
  return UnitSpace::stretched(field.tensorAt(ahead, hint).scaledBy(sizeFactor), origin);
}

IdealPoint placeIdealPoint(const BaseFace& base, double targetEdge) {
  const double h = std::clamp(kEdgePerTarget * targetEdge, kMinSizePerBase * base.size,
                              kMaxSizePerBase * base.size);
  const Vec3 ab = base.b - base.a;
  const Vec3 bc = base.c - base.b;
  const Vec3 ca = base.a - base.c;
  const double product =
      std::sqrt(glm::dot(ab, ab)) * std::sqrt(glm::dot(bc, bc)) * std::sqrt(glm::dot(ca, ca));
  const double maxRadius = kMaxCircumradius * h;
  // The quotient may overflow to infinity for a needle; the clamp handles infinity.
  const double circumradius = base.doubleArea > 0.0 ? product / (2.0 * base.doubleArea) : maxRadius;
  const double radius = std::clamp(circumradius, kMinCircumradius * h, maxRadius);
  const double height = std::max(std::sqrt(h * h - radius * radius), kMinIdealHeight * h);
  return {base.centroid + base.unitNormal * height, height, h};
}

double cubedMeanRatio(const BaseFace& base, const Vec3& apex) {
  const double sixVolumes = glm::dot(base.normal, apex - base.a);
  if (!(sixVolumes > 0.0)) return 0.0;
  const Vec3 pa = apex - base.a;
  const Vec3 pb = apex - base.b;
  const Vec3 pc = apex - base.c;
  const double squares = base.sumSquares + glm::dot(pa, pa) + glm::dot(pb, pb) + glm::dot(pc, pc);
  // 12^3 (3V)^2 = 432 (6V)^2.
  return 432.0 * sixVolumes * sixVolumes / (squares * squares * squares);
}

double bestCubedMeanRatio(const BaseFace& base) {
  return 12.0 * base.doubleArea * base.doubleArea / (base.sumSquares * base.sumSquares);
}

}  // namespace tetrafront
