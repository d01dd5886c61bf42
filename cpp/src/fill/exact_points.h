#pragma once

/// @file Points with exact positions that need not be doubles, and the signs of the volumes they
/// span.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "geom/dyadic.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class ExactPoints {
 public:
  NodeId add(const Vec3& position);
  NodeId add(const DyadicVec3& position);
  /// Adds another point at the same position.
  NodeId copy(NodeId node);
  void move(NodeId node, const Vec3& position);
  void dropLast() { points_.pop_back(); }

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  /// The position rounded to doubles.
  [[nodiscard]] const Vec3& position(NodeId node) const { return points_[node.index()].position; }
  /// Returns true if position() is exact.
  [[nodiscard]] bool isDouble(NodeId node) const { return points_[node.index()].exact.isNone(); }
  [[nodiscard]] DyadicVec3 exact(NodeId node) const;

  /// Returns the exact sign of (b-a) x (c-a) . (d-a).
  [[nodiscard]] int orient(NodeId a, NodeId b, NodeId c, NodeId d) const;
  /// Returns six times the volume.
  [[nodiscard]] Dyadic exactVolume(NodeId a, NodeId b, NodeId c, NodeId d) const;

  /// Cost of all signs computed so far; a measure of work that does not depend on the machine.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  using ExactId = Id<struct ExactTag>;
  struct Exact {
    DyadicVec3 position;
    Vec3 rest;  ///< exact position minus rounded position, in doubles
  };
  struct Point {
    Vec3 position;
    double error;   ///< largest distance of a coordinate from its exact value
    ExactId exact;  ///< index in exact_; none if the position is exact
  };

  [[nodiscard]] Vec3 remainderOf(const Point& point) const;
  [[nodiscard]] int signByTwofolds(const Point& a, const Point& b, const Point& c, const Point& d,
                                   double error) const;

  std::vector<Point> points_;
  std::vector<Exact> exact_;
  mutable std::uint64_t work_ = 0;
};

}  // namespace tetrafront
