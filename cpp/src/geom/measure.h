#pragma once

/// @file Distances, angles and volumes in plain doubles. They decide whether things are too close, never topology.

#include <algorithm>
#include <array>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns the point of the closed segment a b nearest to `p`.
[[nodiscard]] Vec3 nearestPointOfSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// Returns the point of the closed triangle a b c nearest to `p`.
[[nodiscard]] Vec3 nearestPointOfTriangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                          const Vec3& c);

/// Returns the squared distance from `p` to the closed segment a b.
[[nodiscard]] inline double squaredDistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const Vec3 ap = p - a;
  const double square = glm::dot(ab, ab);
  const double t = square > 0.0 ? std::clamp(glm::dot(ap, ab) / square, 0.0, 1.0) : 0.0;
  const Vec3 rest = ap - ab * t;
  return glm::dot(rest, rest);
}

/// Returns the squared distance from `p` to the closed triangle a b c.
[[nodiscard]] inline double squaredDistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                                      const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  const bool above = square > 0.0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0.0 &&
                     glm::dot(glm::cross(c - b, p - b), normal) >= 0.0 &&
                     glm::dot(glm::cross(a - c, p - c), normal) >= 0.0;
  if (above) {
    const double height = glm::dot(p - a, normal);
    return height * height / square;
  }
  return std::min(squaredDistanceToSegment(p, a, b),
                  std::min(squaredDistanceToSegment(p, b, c), squaredDistanceToSegment(p, c, a)));
}

/// Returns v / |v|; zero if v is zero.
[[nodiscard]] inline Vec3 unitOf(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : Vec3(0.0);
}

/// Returns the cosine of the angle between two vectors; 1 if one of them is zero.
[[nodiscard]] inline double cosineBetween(const Vec3& a, const Vec3& b) {
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0.0 ? glm::dot(a, b) / lengths : 1.0;
}

/// Returns six times the volume of the tetrahedron between a point and the triangle a b c: positive if the triangle is
/// counter-clockwise as seen from beyond it. A sum over the triangles of a closed surface is six times its volume.
[[nodiscard]] inline double sixVolumesBelow(const Vec3& point, const Vec3& a, const Vec3& b,
                                            const Vec3& c) {
  return glm::dot(a - point, glm::cross(b - point, c - point));
}

/// The same by the edges of the triangle: a small one far from the point loses little to rounding.
[[nodiscard]] inline double sixVolumesByEdges(const Vec3& point, const Vec3& a, const Vec3& b,
                                              const Vec3& c) {
  return glm::dot(a - point, glm::cross(b - a, c - a));
}

/// Returns the length of the longest edge.
[[nodiscard]] double longestEdgeLengthOf(const std::array<Vec3, 3>& corners);

/// Returns a point that two intersecting triangles have in common, up to rounding: the mean of the
/// corners of their intersection. If they are only close to each other, the point is close to
/// both.
[[nodiscard]] Vec3 intersectionPosition(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace tetrafront
