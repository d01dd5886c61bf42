#pragma once

/// @file All size sources together: the smallest size + growth max(0, r - distance). A few sources
/// are visited one by one. More are stored in a tree of boxes along a Morton curve, whose branches
/// hold lower bounds of the sizes below.

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

  template <class Self, class Visit>
  static void visitMembers(Self& self, Visit& visit) {
    visit(self.sources_, self.branches_, self.firstLeaf_);
  }

  /// Returns the smaller of `size` and the size of the sources at `position`. O(log n) if few sources
  /// reach the position.
  [[nodiscard]] double cappedSize(const Vec3& position, double size) const;

 private:
  static constexpr std::uint32_t kSourcesPerLeaf = 4;
  /// At most one entry per level; 2^32 sources make 32 levels.
  static constexpr std::size_t kStack = 40;

  /// Lower bound of all sources below: size + growth max(0, r - distance), where r is the distance
  /// from the box.
  struct Branch {
    Vec3 low;
    Vec3 high;
    double size;
    double distance;
    double growth;
  };

  void buildTree();
  static void widen(Branch& branch, const Branch& by);
  static double lowerBoundAt(const Branch& branch, const Vec3& position);
  [[nodiscard]] Branch branchOf(std::size_t first, std::size_t last) const;

  std::vector<SizeSource> sources_;  ///< in the order of the leaves
  std::vector<Branch> branches_;     ///< children of n are 2n+1 and 2n+2; empty for a few sources
  std::size_t firstLeaf_ = 0;
};

/// Returns the size of one source at `position`.
[[nodiscard]] double sizeOf(const SizeSource& source, const Vec3& position);

/// Returns one diagnostic per invalid source; empty if all can be used.
[[nodiscard]] std::vector<Diagnostic> checkSizeSources(std::span<const SizeSource> sources);

}  // namespace tetrafront
