#include "geom/intersect.h"

#include <algorithm>
#include <cmath>

#include "geom/predicates.h"

namespace tetrafront {
namespace {

using Triangle = std::array<Vec3, 3>;

/// Projection along a coordinate axis in which a triangle does not degenerate.
class FlatView {
 public:
  explicit FlatView(const Triangle& triangle) {
    for (int dropped = 0; dropped < 3; ++dropped) {
      i_ = (dropped + 1) % 3;
      j_ = (dropped + 2) % 3;
      if (turn(triangle[0], triangle[1], triangle[2]) != 0) return;
    }
  }
  [[nodiscard]] int turn(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return orient2d({a[i_], a[j_]}, {b[i_], b[j_]}, {c[i_], c[j_]});
  }
  /// Returns true if p, which is on the line a b, is between a and b or equal to one of them.
  [[nodiscard]] bool isBetween(const Vec3& p, const Vec3& a, const Vec3& b) const {
    const int axis = a[i_] != b[i_] ? i_ : j_;
    return std::min(a[axis], b[axis]) <= p[axis] && p[axis] <= std::max(a[axis], b[axis]);
  }

 private:
  int i_ = 0;
  int j_ = 1;
};

/// Returns true if p, which is in the plane of the triangle, is in the closed triangle.
bool holds(const FlatView& view, const Triangle& triangle, const Vec3& p) {
  bool left = false;
  bool right = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = view.turn(triangle[k], triangle[(k + 1) % 3], p);
    left = left || side > 0;
    right = right || side < 0;
  }
  return !(left && right);
}

/// Returns true if two closed segments in one plane intersect.
bool segmentsIntersect(const FlatView& view, const Vec3& a, const Vec3& b, const Vec3& c,
                       const Vec3& d) {
  const int sideC = view.turn(a, b, c);
  const int sideD = view.turn(a, b, d);
  const int sideA = view.turn(c, d, a);
  const int sideB = view.turn(c, d, b);
  if (sideC * sideD < 0 && sideA * sideB < 0) return true;
  return (sideC == 0 && view.isBetween(c, a, b)) || (sideD == 0 && view.isBetween(d, a, b)) ||
         (sideA == 0 && view.isBetween(a, c, d)) || (sideB == 0 && view.isBetween(b, c, d));
}

/// Returns true if a segment in the plane of the triangle intersects the closed triangle.
bool flatSegmentIntersects(const Triangle& triangle, const Vec3& p, const Vec3& q) {
  const FlatView view(triangle);
  if (holds(view, triangle, p) || holds(view, triangle, q)) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (segmentsIntersect(view, p, q, triangle[k], triangle[(k + 1) % 3])) return true;
  }
  return false;
}

/// `sideP` and `sideQ`: signs of the sides of the triangle's plane on which the ends of the
/// segment are.
bool segmentIntersects(const Triangle& t, const Vec3& p, const Vec3& q, int sideP, int sideQ) {
  if (sideP * sideQ > 0) return false;
  if (sideP == 0 && sideQ == 0) return flatSegmentIntersects(t, p, q);
  if (sideP == 0) return holds(FlatView(t), t, p);
  if (sideQ == 0) return holds(FlatView(t), t, q);
  const int s0 = orient3d(p, q, t[0], t[1]);
  const int s1 = orient3d(p, q, t[1], t[2]);
  if (s0 * s1 < 0) return false;
  const int s2 = orient3d(p, q, t[2], t[0]);
  return s0 * s2 >= 0 && s1 * s2 >= 0;
}

struct Sides {
  std::array<int, 3> of;
  [[nodiscard]] bool allStrictlyAlike() const {
    return of[0] != 0 && of[0] == of[1] && of[1] == of[2];
  }
  [[nodiscard]] bool allZero() const { return of[0] == 0 && of[1] == 0 && of[2] == 0; }
};

/// Returns on which side of the plane of `t` each corner of `other` is.
Sides sidesOf(const Triangle& t, const Triangle& other) {
  Sides sides{};
  for (std::size_t k = 0; k < 3; ++k) sides.of[k] = orient3d(t[0], t[1], t[2], other[k]);
  return sides;
}

bool anyEdgeIntersects(const Triangle& t, const Triangle& other, const Sides& sides) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    if (segmentIntersects(t, other[k], other[l], sides.of[k], sides.of[l])) return true;
  }
  return false;
}

/// Returns true if the direction x->p, which is in the plane of x a b, is in the closed sector
/// from x->a to x->b.
bool sectorHolds(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& p) {
  const FlatView view({x, a, b});
  const int turn = view.turn(x, a, b);
  return view.turn(x, a, p) * turn >= 0 && view.turn(x, p, b) * turn >= 0;
}

/// Returns true if the triangles x a b and x c d, which share exactly the node x, intersect
/// elsewhere. Near x both are sectors, so they do if and only if the sectors have a direction in
/// common.
bool sectorsIntersect(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int sideC = orient3d(x, a, b, c);
  const int sideD = orient3d(x, a, b, d);
  if (sideC * sideD > 0) return false;
  if (sideC == 0 && sideD == 0) {
    return sectorHolds(x, a, b, c) || sectorHolds(x, a, b, d) || sectorHolds(x, c, d, a) ||
           sectorHolds(x, c, d, b);
  }
  if (sideC == 0) return sectorHolds(x, a, b, c);
  if (sideD == 0) return sectorHolds(x, a, b, d);
  const int sideA = orient3d(x, c, d, a);
  const int sideB = orient3d(x, c, d, b);
  if (sideA * sideB > 0) return false;
  if (sideA == 0 && sideB != 0) return sectorHolds(x, c, d, a);
  if (sideB == 0 && sideA != 0) return sectorHolds(x, c, d, b);
  // Each sector crosses the plane of the other. They cross in the same direction, not in opposite
  // ones, if and only if the orientations a c b, c b d, b d a, d a c agree.
  return sideA == sideD && sideB == sideC && sideA == -sideB;
}

/// Returns true if two triangles that share the edge x y, with third corners w and v, overlap.
bool wingsOverlap(const Vec3& x, const Vec3& y, const Vec3& w, const Vec3& v) {
  if (orient3d(x, y, w, v) != 0) return false;
  const FlatView view({x, y, w});
  return view.turn(x, y, w) == view.turn(x, y, v);
}

/// Returns, per corner of `a`, the corner of `b` with the same node, or 3.
struct Sharing {
  std::array<std::size_t, 3> inB{3, 3, 3};
  std::size_t count = 0;
};

Sharing sharingOf(const NumberedTriangle& a, const NumberedTriangle& b) {
  Sharing sharing;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a.nodes[i] != b.nodes[j]) continue;
      sharing.inB[i] = j;
      ++sharing.count;
    }
  }
  return sharing;
}

}  // namespace

bool trianglesIntersect(const Triangle& a, const Triangle& b) {
  const Sides ofB = sidesOf(a, b);
  if (ofB.allStrictlyAlike()) return false;
  const Sides ofA = sidesOf(b, a);
  if (ofA.allStrictlyAlike()) return false;
  return anyEdgeIntersects(a, b, ofB) || anyEdgeIntersects(b, a, ofA);
}

bool intersectImproperly(const NumberedTriangle& a, const NumberedTriangle& b) {
  const Sharing sharing = sharingOf(a, b);
  if (sharing.count == 0) return trianglesIntersect(a.corners, b.corners);
  if (sharing.count == 3) return true;
  // If one corner is shared, this one; if two are shared, the one that is not.
  std::size_t odd = 0;
  while ((sharing.inB[odd] == 3) != (sharing.count == 2)) ++odd;
  const Vec3& next = a.corners[(odd + 1) % 3];
  const Vec3& last = a.corners[(odd + 2) % 3];
  if (sharing.count == 1) {
    const std::size_t j = sharing.inB[odd];
    return sectorsIntersect(a.corners[odd], next, last, b.corners[(j + 1) % 3],
                            b.corners[(j + 2) % 3]);
  }
  const std::size_t other = 3 - sharing.inB[(odd + 1) % 3] - sharing.inB[(odd + 2) % 3];
  return wingsOverlap(next, last, a.corners[odd], b.corners[other]);
}

}  // namespace tetrafront
