#pragma once

/// @file An octree of sizes that follow from a given surface. Either the size is the mean edge
/// length at the surface's nodes and grows with the distance from them; or it is the smallest size
/// that the triangles allow, which falls with the distance.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

class ByteReader;

class SizeOctree {
 public:
  /// h(x) = min(cap, min_i h_i + growth |x - x_i|), where h_i is the mean edge length at node i,
  /// averaged twice. `cap` 0 stands for the 90th percentile of the h_i, or their mean over the
  /// surface's area if that is larger. Three indices into `points` per triangle; ignores nodes
  /// without triangles. Takes 1 to 3 µs per triangle; SizeOctreeBuilder does it in slices.
  SizeOctree(std::span<const Vec3> points, std::span<const std::uint32_t> triangles, double growth,
             double cap);

  /// Interpolates trilinearly in the leaf that contains `position`; outside the box, returns the value
  /// at its nearest point. Leaves of different sizes do not join continuously: the jump is below
  /// the error of the leaf.
  [[nodiscard]] double sizeAt(const Vec3& position) const;

  /// Returns the largest size of the field.
  [[nodiscard]] double cap() const { return cap_; }

  [[nodiscard]] std::size_t leafCount() const { return leaves_.size(); }

  template <class Self, class Visit>
  static void visitMembers(Self& self, Visit& visit) {
    visit(self.origin_, self.latticePerLength_, self.cap_, self.nodes_, self.leaves_,
          self.directory_);
  }

 private:
  friend class SizeOctreeBuilder;
  friend class ByteReader;

  SizeOctree() = default;

  /// Values at the corners; corner k is at the upper end of axis a if bit a of k is set.
  using Leaf = std::array<float, 8>;

  /// An entry of `nodes_` is either kLeafBit and an index into leaves_, or the index of the first
  /// of eight children, in the order of the corners.
  static constexpr std::uint32_t kLeafBit = 0x80000000U;

  /// Deepest level of a leaf; the root is level 0. Resolves lengths down to 1/65536 of the box.
  static constexpr int kMaxLevel = 16;

  /// A table of 16^3 entries skips the upper levels.
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
