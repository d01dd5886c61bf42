#include "arrangement/cut_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/sort.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

constexpr double kHalfUlp = 0x1p-53;

Vec2 seenIn(const CutView& view, const Vec3& p) {
  return {p[static_cast<int>(view.u)], p[static_cast<int>(view.v)]};
}

/// Returns the double nearest to numerator / denominator; of two at the same distance, the lower one. The result depends on
/// the value only.
double nearestDouble(const Dyadic& numerator, const Dyadic& denominator) {
  if (numerator.sign() == 0) return 0.0;
  double value = quotient(numerator, denominator);
  const Dyadic twice = numerator + numerator;
  const auto isAboveMiddle = [&](double low, double high) {
    return (twice - (Dyadic(low) + Dyadic(high)) * denominator).sign();
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (;;) {
    const double above = std::nextafter(value, kInfinity);
    const double below = std::nextafter(value, -kInfinity);
    if (isAboveMiddle(value, above) > 0) {
      value = above;
    } else if (isAboveMiddle(below, value) <= 0) {
      value = below;
    } else {
      return std::fabs(value) < kSmallestCoordinate ? 0.0 : value;
    }
  }
}

struct ExactPlane {
  DyadicVec3 normal;
  Dyadic offset;  ///< normal . position of the points of the plane
};

}  // namespace

CutPoints::CutPoints(const SurfaceMesh& mesh) : mesh_(mesh), nodeCount_(countNodes(mesh)) {
  std::vector<std::uint8_t> isUsed(nodeCount_, 0);
  for (const std::uint32_t node : mesh.triangles) isUsed[node] = 1;
  for (std::uint32_t i = 0; i < nodeCount_; ++i) {
    if (isUsed[i] != 0) sortedNodes_.emplace_back(i);
  }
  const auto keyOf = [&](NodeId node) {
    const Vec3 p = nodeAt(node);
    return Key{p.x, p.y, p.z};
  };
  stableSort(sortedNodes_, [&](NodeId a, NodeId b) { return keyOf(a) < keyOf(b); });
}

NodeId CutPoints::nodeAtPosition(const Key& position) const {
  const auto keyOf = [&](NodeId node) {
    const Vec3 p = nodeAt(node);
    return Key{p.x, p.y, p.z};
  };
  const auto found = std::ranges::lower_bound(sortedNodes_, position, {}, keyOf);
  return found != sortedNodes_.end() && keyOf(*found) == position ? *found : NodeId();
}

CutPoints::Homogeneous CutPoints::exact(CutPointId point) const {
  if (isExact(point)) return {toDyadic(rounded(point)), Dyadic(1.0)};
  return exact_[made_[point.index() - nodeCount_].exact];
}

CutPointId CutPoints::add(Homogeneous position) {
  if (position.denominator.sign() < 0) {
    position.denominator = position.denominator.negated();
    for (Dyadic& x : position.numerator) x = x.negated();
  }
  const auto& [numerator, denominator] = position;
  Vec3 rounded(0.0);
  bool isRepresentable = true;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    rounded[k] = nearestDouble(numerator[axis], denominator);
    isRepresentable =
        isRepresentable && (numerator[axis] - Dyadic(rounded[k]) * denominator).sign() == 0;
  }
  const Key key{rounded.x, rounded.y, rounded.z};
  if (isRepresentable) {
    const NodeId node = nodeAtPosition(key);
    if (!node.isNone()) return CutPointId(node.value);
  }
  std::vector<CutPointId>& candidates = byPosition_[key];
  for (const CutPointId known : candidates) {
    if (isExact(known) != isRepresentable) continue;
    if (isRepresentable) return known;
    const Homogeneous& other = exact_[made_[known.index() - nodeCount_].exact];
    bool isEqual = true;
    for (std::size_t k = 0; k < 3 && isEqual; ++k) {
      isEqual = (numerator[k] * other.denominator - other.numerator[k] * denominator).sign() == 0;
    }
    if (isEqual) return known;
  }
  const CutPointId point(size());
  candidates.push_back(point);
  made_.push_back({rounded, kNoIndex});
  if (!isRepresentable) {
    made_.back().exact = static_cast<std::uint32_t>(exact_.size());
    exact_.push_back(std::move(position));
  }
  return point;
}

CutPointId CutPoints::addHelper(const Vec3& position) {
  made_.push_back({position, kNoIndex});
  return CutPointId(size() - 1);
}

CutPointId CutPoints::addOnLine(NodeId from, NodeId to, const NodeTriple& triangle) {
  const DyadicVec3 a = toDyadic(nodeAt(triangle[0]));
  const DyadicVec3 p = toDyadic(nodeAt(from));
  const DyadicVec3 along = toDyadic(nodeAt(to)) - p;
  const DyadicVec3 normal =
      cross(toDyadic(nodeAt(triangle[1])) - a, toDyadic(nodeAt(triangle[2])) - a);
  const Dyadic denominator = dot(normal, along);
  const Dyadic share = dot(normal, a - p);
  return add({p * denominator + along * share, denominator});
}

CutPointId CutPoints::addOnPlanes(const CutPlane& a, const CutPlane& b, const CutPlane& c) {
  const DyadicVec3 origin = toDyadic(nodeAt(a.nodes[0]));
  const auto planeOf = [&](const CutPlane& plane) {
    const DyadicVec3 p = toDyadic(nodeAt(plane.nodes[0]));
    const DyadicVec3 u = toDyadic(nodeAt(plane.nodes[1])) - p;
    DyadicVec3 v{};
    if (plane.nodes[2].isNone()) {
      v[plane.parallelAxis] = Dyadic(1.0);
    } else {
      v = toDyadic(nodeAt(plane.nodes[2])) - p;
    }
    const DyadicVec3 normal = cross(u, v);
    return ExactPlane{normal, dot(normal, p - origin)};
  };
  const ExactPlane pa = planeOf(a);
  const ExactPlane pb = planeOf(b);
  const ExactPlane pc = planeOf(c);
  const DyadicVec3 bc = cross(pb.normal, pc.normal);
  const Dyadic denominator = dot(pa.normal, bc);
  // The first plane passes through the origin of these offsets.
  const DyadicVec3 numerator = cross(pc.normal, pa.normal) * pb.offset +
                               cross(pa.normal, pb.normal) * pc.offset + origin * denominator;
  return add({numerator, denominator});
}

int CutPoints::sideOf(const NodeTriple& triangle, CutPointId point) const {
  const Vec3 a = nodeAt(triangle[0]);
  const Vec3 b = nodeAt(triangle[1]);
  const Vec3 c = nodeAt(triangle[2]);
  const Vec3 d = rounded(point);
  if (isExact(point)) return orient3d(a, b, c, d);
  constexpr double kRounding = 16.0 * kHalfUlp;
  const auto sizeOf = [](const Vec3& v) {
    return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
  };
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const double error = kHalfUlp * magnitudeOf(d) + 2.0 * kSmallestCoordinate;
  const double plane = sizeOf(u) * sizeOf(v);
  const double bound = plane * (kRounding * sizeOf(w) + 4.0 * error);
  const double determinant = glm::dot(glm::cross(u, v), w);
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  const Homogeneous position = exact(point);
  const DyadicVec3 origin = toDyadic(a);
  const DyadicVec3 normal = cross(toDyadic(b) - origin, toDyadic(c) - origin);
  return dot(normal, position.numerator - origin * position.denominator).sign();
}

int CutPoints::orient(const CutView& view, CutPointId a, CutPointId b, CutPointId c) const {
  const Vec2 pa = seenIn(view, rounded(a));
  const Vec2 pb = seenIn(view, rounded(b));
  const Vec2 pc = seenIn(view, rounded(c));
  if (isExact(a) && isExact(b) && isExact(c)) return orient2d(pa, pb, pc);
  const Vec2 u = pb - pa;
  const Vec2 v = pc - pa;
  const double size =
      std::max(std::max(std::fabs(u.x), std::fabs(u.y)), std::max(std::fabs(v.x), std::fabs(v.y)));
  double largest = 2.0 * kSmallestCoordinate / kHalfUlp;
  for (const Vec2& p : {pa, pb, pc}) {
    largest = std::max(largest, std::max(std::fabs(p.x), std::fabs(p.y)));
  }
  const double error = 2.0 * kHalfUlp * largest;
  const double bound = 8.0 * size * error + 8.0 * error * error + 16.0 * kHalfUlp * size * size;
  const double determinant = u.x * v.y - u.y * v.x;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  const Homogeneous ea = exact(a);
  const Homogeneous eb = exact(b);
  const Homogeneous ec = exact(c);
  // Differences from a, times the denominators, which are above 0.
  const auto difference = [&](const Homogeneous& p, std::uint32_t axis) {
    return p.numerator[axis] * ea.denominator - ea.numerator[axis] * p.denominator;
  };
  return (difference(eb, view.u) * difference(ec, view.v) -
          difference(eb, view.v) * difference(ec, view.u))
      .sign();
}

int CutPoints::compare(std::uint32_t axis, CutPointId a, CutPointId b) const {
  if (a == b) return 0;
  // Rounding is monotonic.
  const int k = static_cast<int>(axis);
  const double pa = rounded(a)[k];
  const double pb = rounded(b)[k];
  if (pa != pb) return pa < pb ? -1 : 1;
  if (isExact(a) && isExact(b)) return 0;
  const Homogeneous ea = exact(a);
  const Homogeneous eb = exact(b);
  return (ea.numerator[axis] * eb.denominator - eb.numerator[axis] * ea.denominator).sign();
}

CutView viewOf(const SurfaceMesh& mesh, const NodeTriple& triangle) {
  const Vec3 a = pointOf(mesh, triangle[0]);
  const Vec3 b = pointOf(mesh, triangle[1]);
  const Vec3 c = pointOf(mesh, triangle[2]);
  const Vec3 normal = glm::cross(b - a, c - a);
  std::array<std::uint32_t, 3> axes{0, 1, 2};
  const auto sizeOf = [&](std::uint32_t axis) { return std::fabs(normal[static_cast<int>(axis)]); };
  sortFew(axes, [&](std::uint32_t i, std::uint32_t j) { return sizeOf(i) > sizeOf(j); });
  for (const std::uint32_t axis : axes) {
    const CutView view{(axis + 1) % 3, (axis + 2) % 3};
    const int sign = orient2d(seenIn(view, a), seenIn(view, b), seenIn(view, c));
    if (sign != 0) return sign > 0 ? view : CutView{view.v, view.u};
  }
  return {0, 1};
}

}  // namespace tetrafront
