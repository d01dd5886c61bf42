#pragma once

/// @file Nodes of a body-centred cubic lattice: the corners and the centres of equal cubes. Its tetrahedra have dihedral angles of
/// 60 and 90 degrees.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// A node of a lattice, in half lattice constants from its lowest corner, at least 0: all even (corners of cubes), or all odd
/// (their centres).
struct LatticePlace {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t z = 0;
};

class Lattice {
 public:
  /// Edges of the cubes / edges of regular tetrahedra with the volume of the lattice's tetrahedra.
  static constexpr double kConstantPerSize = 1.122;
  /// Largest number of half constants along an axis; a position is one number of 63 bits.
  static constexpr std::uint32_t kMaxSteps = 1U << 21U;

  /// `constant`: edge of the cubes, > 0. The lattice has a node at the origin of the coordinates, so that it does not depend on `low`,
  /// the lowest corner of what it covers.
  Lattice(double constant, const Vec3& low);

  [[nodiscard]] Vec3 positionOf(const LatticePlace& place) const {
    return (base_ + Vec3(place.x, place.y, place.z)) * half_;
  }
  /// Returns the first step along an axis that is not below a coordinate.
  [[nodiscard]] std::uint32_t firstFrom(double coordinate, int axis) const;
  /// Returns whether positions up to `high` have places.
  [[nodiscard]] bool reaches(const Vec3& high) const;

 private:
  double half_;
  Vec3 base_;  ///< the lowest corner, in half constants, even
};

/// A set of nodes of a lattice, each with an id: eight bytes a node.
class LatticeNodes {
 public:
  class Row;

  /// Adds a node, which must be new.
  void add(const LatticePlace& place) { keys_.push_back(keyOf(place)); }
  [[nodiscard]] std::size_t count() const { return keys_.size(); }
  void reserve(std::size_t count) { keys_.reserve(count); }

  /// Sorts the nodes, once after the last one: their order is the one of space, row by row.
  Task<> sort(Work& work);
  [[nodiscard]] LatticePlace placeOf(NodeId node) const;
  /// Returns the node at a place, or none. O(log n).
  [[nodiscard]] NodeId find(const LatticePlace& place) const;
  /// Returns the nodes of a row along x.
  [[nodiscard]] Row rowAt(std::uint32_t y, std::uint32_t z) const;
  /// The same, if it is known that firstFrom({0, y, z}) is `index`. O(1).
  [[nodiscard]] Row rowAt(std::uint32_t y, std::uint32_t z, std::size_t index) const;
  /// Returns the first node that is not before a place, or their number.
  [[nodiscard]] std::size_t firstFrom(const LatticePlace& place) const;

 private:
  using Key = std::uint64_t;
  static constexpr unsigned kBits = 21;
  [[nodiscard]] static Key keyOf(const LatticePlace& place) {
    return (Key{place.z} << kBits | place.y) << kBits | place.x;
  }

  std::vector<Key> keys_;
};

/// The nodes of a row along x. Queries must ascend.
class LatticeNodes::Row {
 public:
  Row(const std::vector<Key>& keys, Key first, std::size_t index)
      : keys_(keys.data()), end_(keys.size()), row_(first), next_(index) {}

  /// Leaves out nodes before x - 2, far faster than queries do.
  void skipTo(std::uint32_t x) {
    constexpr std::size_t kStride = 16;
    const Key key = row_ | x;
    while (next_ + kStride < end_ && keys_[next_ + kStride] + 2 < key) next_ += kStride;
  }

  /// Returns the node at x, or none. Later queries may be for x - 2 or more.
  [[nodiscard]] NodeId at(std::uint32_t x) {
    const Key key = row_ | x;
    while (next_ < end_ && keys_[next_] + 2 < key) ++next_;
    for (std::size_t i = next_; i < end_ && keys_[i] <= key; ++i) {
      if (keys_[i] == key) return NodeId(i);
    }
    return {};
  }

 private:
  const Key* keys_;
  std::size_t end_;
  Key row_;
  std::size_t next_;
};

}  // namespace tetrafront
