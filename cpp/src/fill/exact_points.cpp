#include "fill/exact_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geom/predicates.h"
#include "geom/twofold.h"

namespace tetrafront {
namespace {

constexpr double kRoundoff = 0x1p-53;
/// Cost of a sign that doubles leave open, in signs decided by doubles. It is the measured cost of
/// long numbers, although only one such sign in twenty needs them.
constexpr std::uint64_t kExactCost = 20;

double sumOfSizes(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

Vec3 roundedOf(const DyadicVec3& v) { return {v[0].toDouble(), v[1].toDouble(), v[2].toDouble()}; }

/// Returns the sign of the determinant of the differences u, v, w if it is certain, else 0.
/// `roundoff` is the error of the determinant relative to the sum of the sizes of its terms. Each
/// coordinate of the differences may be off by `error`; this can change the determinant by half of
/// what the bound allows for.
int certainSign(double determinant, const Vec3& u, const Vec3& v, const Vec3& w, double roundoff,
                double error) {
  const double sizeU = sumOfSizes(u) + error;
  const double sizeV = sumOfSizes(v) + error;
  const double sizeW = sumOfSizes(w) + error;
  const double bound = roundoff * sizeU * sizeV * sizeW +
                       4.0 * error * (sizeU * sizeV + sizeV * sizeW + sizeW * sizeU);
  return determinant > bound ? 1 : (determinant < -bound ? -1 : 0);
}

/// Returns the sign in plain doubles, or 0 if it is uncertain, for positions that may be off by
/// `error` in each coordinate. The bound is twice that of the plain evaluation (Shewchuk 1997,
/// section 4).
int signByDoubles(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double error) {
  constexpr double kBound = 16.0 * kRoundoff;
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  return certainSign(glm::dot(glm::cross(u, v), w), u, v, w, kBound, error);
}

}  // namespace

NodeId ExactPoints::add(const Vec3& position) {
  points_.push_back({position, 0.0, {}});
  return NodeId(points_.size() - 1);
}

NodeId ExactPoints::add(const DyadicVec3& position) {
  const Vec3 rounded = roundedOf(position);
  const DyadicVec3 rest = position - toDyadic(rounded);
  if (rest[0].sign() == 0 && rest[1].sign() == 0 && rest[2].sign() == 0) return add(rounded);
  constexpr double kRoundingOfDyadics = 4.0 * kRoundoff;
  const double error = kRoundingOfDyadics *
                       std::max({std::fabs(rounded.x), std::fabs(rounded.y), std::fabs(rounded.z)});
  points_.push_back({rounded, error, ExactId(exact_.size())});
  exact_.push_back({position, roundedOf(rest)});
  return NodeId(points_.size() - 1);
}

NodeId ExactPoints::copy(NodeId node) {
  const Point point = points_[node.index()];
  points_.push_back(point);
  return NodeId(points_.size() - 1);
}

void ExactPoints::move(NodeId node, const Vec3& position) {
  points_[node.index()] = {position, 0.0, {}};
}

DyadicVec3 ExactPoints::exact(NodeId node) const {
  const Point& point = points_[node.index()];
  return point.exact.isNone() ? toDyadic(point.position) : exact_[point.exact.index()].position;
}

int ExactPoints::orient(NodeId a, NodeId b, NodeId c, NodeId d) const {
  ++work_;
  const Point& pa = points_[a.index()];
  const Point& pb = points_[b.index()];
  const Point& pc = points_[c.index()];
  const Point& pd = points_[d.index()];
  const double error = pa.error + std::max({pb.error, pc.error, pd.error});
  if (error == 0.0) return orient3d(pa.position, pb.position, pc.position, pd.position);
  const int sign = signByDoubles(pa.position, pb.position, pc.position, pd.position, error);
  if (sign != 0) return sign;
  work_ += kExactCost;
  const int closer = signByTwofolds(pa, pb, pc, pd, error);
  return closer != 0 ? closer : exactVolume(a, b, c, d).sign();
}

Vec3 ExactPoints::remainderOf(const Point& point) const {
  return point.exact.isNone() ? Vec3(0.0) : exact_[point.exact.index()].rest;
}

/// As signByDoubles(), with twice the digits. `error` is the error of the positions without their
/// remainders.
int ExactPoints::signByTwofolds(const Point& a, const Point& b, const Point& c, const Point& d,
                                double error) const {
  // A dozen roundings, each of a few 2^-106.
  constexpr double kBound = 0x1p-97;
  // Remainders are rounded themselves, by two units in the last place.
  constexpr double kRoundingOfRests = 0x1p-50;
  // Products of smaller numbers may lose parts by underflow.
  constexpr double kMinSize = 0x1p-250;
  const Vec3 restA = remainderOf(a);
  std::array<std::array<Twofold, 3>, 3> rows;
  std::array<Vec3, 3> sizes;
  const std::array<const Point*, 3> others{&b, &c, &d};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& p = *others[i];
    const Vec3 rest = remainderOf(p);
    auto& row = rows[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      row[k] =
          renormalized(p.position[axis], rest[axis]) - renormalized(a.position[axis], restA[axis]);
    }
    sizes[i] = {row[0].high, row[1].high, row[2].high};
    if (sumOfSizes(sizes[i]) < kMinSize) return 0;
  }
  const auto& [u, v, w] = rows;
  const Twofold determinant = u[0] * (v[1] * w[2] - v[2] * w[1]) +
                              u[1] * (v[2] * w[0] - v[0] * w[2]) +
                              u[2] * (v[0] * w[1] - v[1] * w[0]);
  return certainSign(determinant.high, sizes[0], sizes[1], sizes[2], kBound,
                     kRoundingOfRests * error);
}

Dyadic ExactPoints::exactVolume(NodeId a, NodeId b, NodeId c, NodeId d) const {
  return determinant(exact(a), exact(b), exact(c), exact(d));
}

}  // namespace tetrafront
