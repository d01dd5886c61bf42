#include "fill/exact_points.h"

#include <algorithm>
#include <cmath>

#include "geom/predicates.h"

namespace tetrafront {
namespace {

constexpr double kRoundoff = 0x1p-53;
/// What a sign by long numbers costs, in signs by doubles; measured.
constexpr std::uint64_t kExactCost = 20;

double sumOfSizes(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// Does plain double decide the sign, for places that may be off by `error` in each coordinate?
/// The bound is generous: the plain evaluation's own (Shewchuk 1997, section 4), doubled, and twice
/// what moving each difference by the error can change.
int signByDoubles(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double error) {
  constexpr double kBound = 16.0 * kRoundoff;
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const double det = glm::dot(glm::cross(u, v), w);
  const double sizeU = sumOfSizes(u) + error;
  const double sizeV = sumOfSizes(v) + error;
  const double sizeW = sumOfSizes(w) + error;
  const double bound = kBound * sizeU * sizeV * sizeW +
                       4.0 * error * (sizeU * sizeV + sizeV * sizeW + sizeW * sizeU);
  return det > bound ? 1 : (det < -bound ? -1 : 0);
}

}  // namespace

NodeId ExactPoints::add(const Vec3& place) {
  points_.push_back({place, 0.0, kPlaceIsExact});
  return NodeId(points_.size() - 1);
}

NodeId ExactPoints::add(const DyadicVec3& place) {
  const Vec3 rounded(place[0].toDouble(), place[1].toDouble(), place[2].toDouble());
  if (toDyadic(rounded) == place) return add(rounded);
  constexpr double kRoundingOfDyadics = 4.0 * kRoundoff;
  const double error = kRoundingOfDyadics *
                       std::max({std::fabs(rounded.x), std::fabs(rounded.y), std::fabs(rounded.z)});
  points_.push_back({rounded, error, static_cast<std::uint32_t>(exact_.size())});
  exact_.push_back(place);
  return NodeId(points_.size() - 1);
}

NodeId ExactPoints::copy(NodeId node) {
  const Point point = points_[node.index()];
  points_.push_back(point);
  return NodeId(points_.size() - 1);
}

void ExactPoints::move(NodeId node, const Vec3& place) {
  points_[node.index()] = {place, 0.0, kPlaceIsExact};
}

DyadicVec3 ExactPoints::exact(NodeId node) const {
  const Point& point = points_[node.index()];
  return point.exact == kPlaceIsExact ? toDyadic(point.place) : exact_[point.exact];
}

int ExactPoints::orient(NodeId a, NodeId b, NodeId c, NodeId d) const {
  ++work_;
  const Point& pa = points_[a.index()];
  const Point& pb = points_[b.index()];
  const Point& pc = points_[c.index()];
  const Point& pd = points_[d.index()];
  const double error = pa.error + std::max({pb.error, pc.error, pd.error});
  if (error == 0.0) return orient3d(pa.place, pb.place, pc.place, pd.place);
  const int sign = signByDoubles(pa.place, pb.place, pc.place, pd.place, error);
  if (sign != 0) return sign;
  work_ += kExactCost;
  return exactVolume(a, b, c, d).sign();
}

Dyadic ExactPoints::exactVolume(NodeId a, NodeId b, NodeId c, NodeId d) const {
  return determinant(exact(a), exact(b), exact(c), exact(d));
}

}  // namespace tetrafront
