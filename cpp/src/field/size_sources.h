#pragma once

/// @file Sources of size, asked together: the smallest size + growth max(0, r - distance) of all.
/// Up to a handful are looked at one by one; more stand in a tree of boxes along a Morton curve,
/// whose branches know what they can ask for at best.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/status.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class SizeSources {
 public:
  SizeSources() = default;

  /// `sources` must have passed checkSizeSources(). O(n log n).
  explicit SizeSources(std::span<const SizeSource> sources);

  [[nodiscard]] bool empty() const { return sources_.empty(); }

  [[nodiscard]] std::span<const SizeSource> all() const { return sources_; }

  /// The smaller of `size` and what the sources ask for at `place`. O(log n) where few reach.
  [[nodiscard]] double cappedSize(const Vec3& place, double size) const;

 private:
  static constexpr std::uint32_t kSourcesPerLeaf = 4;
  /// One entry per level waits at most; 2^32 sources make 32 levels.
  static constexpr std::size_t kStack = 40;

  /// No source below asks for less than size + growth max(0, r - distance), r the distance from
  /// the box.
  struct Branch {
    Vec3 low;
    Vec3 high;
    double size;
    double distance;
    double growth;
  };

  void buildTree();
  static void widen(Branch& branch, const Branch& by);
  static double leastOf(const Branch& branch, const Vec3& place);
  [[nodiscard]] Branch branchOf(std::size_t first, std::size_t last) const;

  std::vector<SizeSource> sources_;  ///< in the order of the leaves
  std::vector<Branch> branches_;     ///< children of n are 2n+1 and 2n+2; empty for a handful
  std::size_t firstLeaf_ = 0;
};

/// What a source asks for at `place`.
[[nodiscard]] double sizeOf(const SizeSource& source, const Vec3& place);

/// Sources whose numbers make no sense, all at once; empty if they can be used.
[[nodiscard]] std::vector<Diagnostic> checkSizeSources(std::span<const SizeSource> sources);

}  // namespace tetrafront
