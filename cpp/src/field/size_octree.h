#pragma once

/// @file Sizes that come from a given surface, held on an octree: what its nodes ask for, which is
/// the mean length of their edges and grows with the distance from them; and the least that can be
/// had beside its triangles, which falls with the distance.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

class SizeOctree {
 public:
  /// h(x) = min(cap, min_i h_i + growth |x - x_i|), h_i the twice averaged mean edge at node i.
  /// `cap` 0: the 90th percentile of the h_i, or their mean over the surface's area if that is more. Triangles are three positions in `points` each;
  /// nodes of no triangle are ignored. 1 to 3 µs per triangle; SizeOctreeBuilder does it in
  /// slices.
  SizeOctree(std::span<const Vec3> points, std::span<const std::uint32_t> triangles, double growth,
             double cap);

  /// Trilinear in the leaf that holds `place`; outside the box, the value at its nearest point.
  /// Not continuous from one leaf size to the next: the jump is below the leaf's own error.
  [[nodiscard]] double sizeAt(const Vec3& place) const;

  /// The largest size the field takes.
  [[nodiscard]] double cap() const { return cap_; }

  [[nodiscard]] std::size_t leafCount() const { return leaves_.size(); }

 private:
  friend class SizeOctreeBuilder;

  SizeOctree() = default;

  /// Values at the corners; corner k is at the upper end of axis a where bit a of k is set.
  using Leaf = std::array<float, 8>;

  /// What `nodes_` holds: kLeafBit and a position in leaves_, or the position of the first of
  /// eight children, ordered as the corners are.
  static constexpr std::uint32_t kLeafBit = 0x80000000U;

  /// Deepest level of a leaf; the root is level 0. Lengths down to 1/65536 of the box.
  static constexpr int kMaxLevel = 16;

  /// The upper levels are skipped through a table of 16^3 entries.
  static constexpr int kDirectoryLevel = 4;
  struct DirectoryEntry {
    std::uint32_t node = 0;
    std::uint32_t level = 0;
  };

  void fillDirectory();
  void fillDirectory(std::uint32_t node, std::uint32_t level, std::array<std::uint32_t, 3> corner);

  Vec3 origin_{0.0};
  double latticePerLength_ = 0.0;  ///< 2^kMaxLevel / edge of the box
  double cap_ = 0.0;
  std::vector<std::uint32_t> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<DirectoryEntry> directory_;
};

}  // namespace tetrafront
