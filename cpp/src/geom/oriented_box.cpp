#include "geom/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tetrafront {
namespace {

using Axes = std::array<Vec3, 3>;

/// Upper bound of the error of a sum after some dozens of roundings, relative to its terms.
constexpr double kSumRounding = 1e-14;

/// Products below this may have lost digits to underflow.
constexpr double kUnderflowLimit = 0x1p-900;

constexpr Axes kCoordinateAxes{Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)};

Vec3 unit(const Vec3& v) { return v * (1.0 / glm::length(v)); }

/// Returns true if the axes are at right angles up to the rounding that boxOf() allows for; false
/// for NaN.
bool areUpright(const Axes& axes) {
  constexpr double kMaxAxisError = kSumRounding / 8.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::fabs(glm::dot(axes[i], axes[i]) - 1.0) < kMaxAxisError)) return false;
    if (!(std::fabs(glm::dot(axes[i], axes[(i + 1) % 3])) < kMaxAxisError)) return false;
  }
  return true;
}

/// Returns three orthogonal unit vectors: along `along`, in the plane of both directions, and
/// normal to it.
Axes axesOf(const Vec3& along, const Vec3& across) {
  const Vec3 u = unit(along);
  // If the two directions are nearly parallel, the difference is mostly rounding; the second
  // projection removes it.
  Vec3 v = unit(across - u * glm::dot(across, u));
  v = unit(v - u * glm::dot(v, u));
  return {u, v, glm::cross(u, v)};
}

/// Returns axes along `along`. If both directions are parallel, the second axis is arbitrary. If
/// the numbers are too large or too small, returns the coordinate axes.
Axes axesAlong(const Vec3& along, const Vec3& across) {
  const Axes axes = axesOf(along, across);
  if (areUpright(axes)) return axes;
  std::size_t least = 0;
  for (const int k : {1, 2}) {
    const bool isLess = std::fabs(along[k]) < std::fabs(along[static_cast<int>(least)]);
    if (isLess) least = static_cast<std::size_t>(k);
  }
  const Axes anyAcross = axesOf(along, kCoordinateAxes[least]);
  return areUpright(anyAcross) ? anyAcross : kCoordinateAxes;
}

double absoluteDot(const Vec3& a, const Vec3& b) {
  return std::fabs(a.x * b.x) + std::fabs(a.y * b.y) + std::fabs(a.z * b.z);
}

/// Returns how far a box extends along a unit vector, to either side of its centre.
double reachOf(const OrientedBox& box, const Vec3& axis) {
  double reach = 0.0;
  for (const Vec3& half : box.halves) reach += std::fabs(glm::dot(half, axis));
  return reach;
}

double largestCoordinate(const Vec3& v) {
  return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
}

/// Returns the box from low to high along each of the axes, relative to `origin`. `size` is the
/// largest magnitude that was rounded to compute them. Axes may deviate from right angles by an
/// eighth of kSumRounding; positions measured along them are off by as much of each length, and
/// their own rounding is less. A padding of four times kSumRounding covers both, and what
/// isApartAlong() neglects.
OrientedBox boxOf(const Axes& axes, const Vec3& origin, const Vec3& low, const Vec3& high,
                  double size) {
  const double lengths = largestCoordinate(low) + largestCoordinate(high);
  const double padding = 4.0 * kSumRounding * (size + lengths) + kUnderflowLimit;
  OrientedBox box{.centre = origin};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<int>(i);
    box.centre += axes[i] * (0.5 * (low[k] + high[k]));
    box.halves[i] = axes[i] * (0.5 * (high[k] - low[k]) + padding);
  }
  return box;
}

/// Returns `direction`, reversed if it points against `other`.
Vec3 turnedTo(const Vec3& direction, const Vec3& other) {
  return glm::dot(direction, other) < 0.0 ? -direction : direction;
}

bool isApartAlong(const OrientedBox& a, const OrientedBox& b, const Vec3& axis) {
  const Vec3 way = b.centre - a.centre;
  const double reach = reachOf(a, axis) + reachOf(b, axis);
  const double rounding = kSumRounding * (absoluteDot(way, axis) + reach) + kUnderflowLimit;
  return std::fabs(glm::dot(way, axis)) > reach + rounding;
}

}  // namespace

OrientedBox OrientedBox::of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Vec3, 3> corners{a, b, c};
  const std::array<Vec3, 3> edges{b - a, c - b, a - c};
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (glm::dot(edges[i], edges[i]) > glm::dot(edges[longest], edges[longest])) longest = i;
  }
  const Vec3& origin = corners[longest];
  const Axes axes = axesAlong(edges[longest], edges[(longest + 1) % 3]);
  Vec3 low(0.0);
  Vec3 high(0.0);
  double size = largestCoordinate(origin);
  for (const Vec3& corner : corners) {
    size = std::max(size, largestCoordinate(corner));
    for (int k = 0; k < 3; ++k) {
      const double position = glm::dot(corner - origin, axes[static_cast<std::size_t>(k)]);
      low[k] = std::min(low[k], position);
      high[k] = std::max(high[k], position);
    }
  }
  return boxOf(axes, origin, low, high, size);
}

OrientedBox OrientedBox::hull(const OrientedBox& a, const OrientedBox& b) {
  const Vec3 along = a.halves[0] + turnedTo(b.halves[0], a.halves[0]);
  const Vec3 way = b.centre - a.centre;
  const auto left = [&](const Vec3& v) {
    return v - along * (glm::dot(v, along) / glm::dot(along, along));
  };
  // First the axes in which the boxes are widest, side by side or each alone.
  Vec3 across = left(way);
  for (const Vec3& one : {a.halves[1], b.halves[1]}) {
    const Vec3 width = left(one);
    if (glm::dot(width, width) > glm::dot(across, across)) across = width;
  }
  const Axes axes = axesAlong(along, across);
  Vec3 low(0.0);
  Vec3 high(0.0);
  for (int k = 0; k < 3; ++k) {
    const Vec3& axis = axes[static_cast<std::size_t>(k)];
    const double position = glm::dot(way, axis);
    const double reachA = reachOf(a, axis);
    const double reachB = reachOf(b, axis);
    low[k] = std::min(-reachA, position - reachB);
    high[k] = std::max(reachA, position + reachB);
  }
  const double size = largestCoordinate(a.centre) + largestCoordinate(way);
  return boxOf(axes, a.centre, low, high, size);
}

bool OrientedBox::isApartFrom(const OrientedBox& other) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (isApartAlong(*this, other, halves[i]) || isApartAlong(*this, other, other.halves[i]))
      return true;
  }
  // Then the normal of two needles that pass each other.
  return isApartAlong(*this, other, glm::cross(halves[0], other.halves[0]));
}

}  // namespace tetrafront
