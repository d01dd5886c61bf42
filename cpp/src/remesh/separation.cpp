#include "remesh/separation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "remesh/triangle_parts.h"

namespace tetrafront {
namespace {

/// A product of three vectors, computed from rounded differences, has an error below this / product of their lengths. This
/// is 90 roundings; about 10 are needed.
constexpr double kRounding = 1e-14;

}  // namespace

void SeparationProof::begin(std::span<const NumberedTriangle> triangles) {
  triangles_ = triangles;
  for (const Node& node : nodes_) indexOf_[node.index] = kNoIndex;
  nodes_.clear();
  normal_ = Vec3(0.0);
  Vec3 sum(0.0);
  for (const NumberedTriangle& triangle : triangles) {
    normal_ += crossOf(triangle.corners);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = triangle.nodes[k];
      if (index >= indexOf_.size()) indexOf_.resize(index + 1, kNoIndex);
      if (indexOf_[index] != kNoIndex) continue;
      indexOf_[index] = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back({index, triangle.corners[k]});
      sum += triangle.corners[k];
    }
  }
  centre_ = sum / static_cast<double>(nodes_.size());
  reach_ = 0.0;
  for (const Node& node : nodes_) reach_ = std::max(reach_, glm::length(node.position - centre_));
}

// ---- the new triangles among themselves ---------------------------------------------------------

bool SeparationProof::areApart() {
  if (triangles_.size() < 2) return true;
  return std::ranges::any_of(triangles_[0].nodes, [&](std::uint32_t node) {
    return collectSpreads(node) && areTurning() && coversOnce();
  });
}

/// Returns false if a triangle does not have the node.
bool SeparationProof::collectSpreads(std::uint32_t centre) {
  spreads_.clear();
  for (const auto& [nodes, corners] : triangles_) {
    const auto at = std::ranges::find(nodes, centre);
    if (at == nodes.end()) return false;
    const auto k = static_cast<std::size_t>(at - nodes.begin());
    const std::size_t l = (k + 1) % 3;
    const std::size_t m = (k + 2) % 3;
    spreads_.push_back({nodes[l], nodes[m], corners[l] - corners[k], corners[m] - corners[k]});
  }
  return true;
}

/// Returns true if all triangles turn counter-clockwise around the common node, seen against the normal.
bool SeparationProof::areTurning() const {
  const double length = glm::length(normal_);
  return std::ranges::all_of(spreads_, [&](const Spread& spread) {
    const double margin =
        kRounding * length * glm::length(spread.toFrom) * glm::length(spread.toTo);
    return glm::dot(normal_, glm::cross(spread.toFrom, spread.toTo)) > margin;
  });
}

/// For triangles that are turning: returns true if they are one fan that goes around the node once at most.
bool SeparationProof::coversOnce() const {
  const Spread* first = nullptr;
  for (const Spread& spread : spreads_) {
    std::size_t before = 0;
    for (const Spread& other : spreads_) {
      if (other.to == spread.from) ++before;
      if (&other != &spread && other.from == spread.from) return false;
    }
    if (before > 1) return false;
    if (before == 1) continue;
    if (first != nullptr) return false;
    first = &spread;
  }
  // Every turn by 360 degrees crosses the first half of this plane through the normal once, upwards.
  const bool isClosed = first == nullptr;
  const Vec3 ahead = isClosed ? spreads_[0].toFrom : first->toFrom;
  const Vec3 up = glm::cross(normal_, ahead);
  const double length = glm::length(up);
  const auto isAbove = [&](const Vec3& edge) { return glm::dot(up, edge) > 0.0; };
  std::size_t crossings = 0;
  for (const Spread& spread : spreads_) {
    const bool isFirst = spread.from == (isClosed ? spreads_[0] : *first).from;
    const bool isLast = isClosed && spread.to == spreads_[0].from;
    // The edge ahead is on the plane.
    if (!isFirst && !isAbove(spread.toFrom) && (isLast || isAbove(spread.toTo))) ++crossings;
    if (isLast) continue;
    // Nodes that are nearly on the first half may be on either side.
    const double height = std::fabs(glm::dot(up, spread.toTo));
    if (height <= kRounding * length * glm::length(spread.toTo) &&
        glm::dot(ahead, spread.toTo) > 0.0)
      return false;
  }
  return crossings == (isClosed ? 1 : 0);
}

// ---- another triangle ---------------------------------------------------------------------------

/// Returns true if all nodes of `other` that are not shared are in front of the plane, and all nodes of the new triangles
/// behind it. Shared nodes are on the plane. `margin`: per distance from the origin.
bool SeparationProof::isBeyond(const NumberedTriangle& other, const NodeIndices& indices,
                               const Vec3& origin, const Vec3& normal, double margin) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (indices[k] != kNoIndex) continue;
    const Vec3 offset = other.corners[k] - origin;
    const double height = glm::dot(normal, offset);
    if (!(height > 0.0 && height * height > margin * margin * glm::dot(offset, offset)))
      return false;
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (i == indices[0] || i == indices[1] || i == indices[2]) continue;
    const Vec3 offset = nodes_[i].position - origin;
    const double height = glm::dot(normal, offset);
    if (!(height < 0.0 && height * height > margin * margin * glm::dot(offset, offset)))
      return false;
  }
  return true;
}

/// Returns true if a plane across the direction has all nodes of the new triangles on one side and the corners on the other.
bool SeparationProof::isApartAlong(const Vec3& direction,
                                   const std::array<Vec3, 3>& corners) const {
  double most = 0.0;
  double least = 0.0;
  for (const Node& node : nodes_) {
    const double height = glm::dot(direction, node.position - centre_);
    most = std::max(most, height);
    least = std::min(least, height);
  }
  // The centre is among the nodes, and each corner has a margin of its own.
  const double margin = kRounding * glm::length(direction);
  const auto all = [&](auto isOutside) {
    return std::ranges::all_of(corners, [&](const Vec3& corner) {
      const Vec3 offset = corner - centre_;
      return isOutside(glm::dot(direction, offset), margin * (reach_ + glm::length(offset)));
    });
  };
  return all([&](double height, double error) { return height > most + error; }) ||
         all([&](double height, double error) { return height < least - error; });
}

/// For a triangle that shares no node. Most are separated along the line between the centres. Near a crowd of long triangles, many are in
/// one plane, or at an angle.
bool SeparationProof::isFarFrom(const NumberedTriangle& other) const {
  const auto& [a, b, c] = other.corners;
  const Vec3 cross = crossOf(other.corners);
  return isApartAlong((a + b + c) / 3.0 - centre_, other.corners) ||
         isApartAlong(cross, other.corners) || isApartAlong(normal_, other.corners) ||
         isApartAlong(glm::cross(cross, b - a), other.corners) ||
         isApartAlong(glm::cross(cross, c - b), other.corners) ||
         isApartAlong(glm::cross(cross, a - c), other.corners);
}

SeparationProof::NodeIndices SeparationProof::indicesOf(const NumberedTriangle& other) const {
  NodeIndices indices;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t index = other.nodes[k];
    indices[k] = index < indexOf_.size() ? indexOf_[index] : kNoIndex;
  }
  return indices;
}

bool SeparationProof::isApart(const NumberedTriangle& other) const {
  const NodeIndices indices = indicesOf(other);
  const auto shared = 3 - std::ranges::count(indices, kNoIndex);
  if (shared == 0) return isFarFrom(other);
  if (shared == 3) return false;
  // If one corner is shared, this one; if two are shared, the one that is not.
  std::size_t odd = 0;
  while ((indices[odd] != kNoIndex) != (shared == 1)) ++odd;
  const Vec3& next = other.corners[(odd + 1) % 3];
  const Vec3& last = other.corners[(odd + 2) % 3];
  if (shared == 1) {
    const Vec3& origin = other.corners[odd];
    const Vec3 away = origin - centre_;
    const Vec3 along = 0.5 * (next + last) - origin;
    const Vec3 normal = away / glm::length(away) + along / glm::length(along);
    return isBeyond(other, indices, origin, normal, kRounding * glm::length(normal));
  }
  // The plane through the shared edge halves the angle between the triangle and the mean of the new ones.
  const Vec3 edge = last - next;
  const Vec3 cross = crossOf(other.corners);
  const Vec3 between = normal_ / glm::length(normal_) + cross / glm::length(cross);
  // `other` is on the left of its edge from next to last.
  const Vec3 normal = glm::cross(between, edge);
  return isBeyond(other, indices, next, normal,
                  kRounding * glm::length(between) * glm::length(edge));
}

}  // namespace tetrafront
