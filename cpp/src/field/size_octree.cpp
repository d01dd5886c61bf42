#include "field/size_octree.h"

#include <algorithm>

#include "field/size_octree_builder.h"

namespace tetrafront {

SizeOctree::SizeOctree(std::span<const Vec3> points, std::span<const std::uint32_t> triangles,
                       double growth, double cap) {
  constexpr std::uint32_t kSlice = 1U << 20U;
  SizeOctreeBuilder builder(points, triangles, growth, cap);
  while (!builder.advance(kSlice)) {
  }
  *this = builder.take();
}

void SizeOctree::fillDirectory() {
  constexpr std::size_t kSide = std::size_t{1} << kDirectoryLevel;
  directory_.resize(kSide * kSide * kSide);
  fillDirectory(0, 0, {0, 0, 0});
}

/// Enters the node into every directory cell that it covers. `corner` counts cells of the node's
/// own level.
void SizeOctree::fillDirectory(std::uint32_t node, std::uint32_t level,
                               std::array<std::uint32_t, 3> corner) {
  const bool isLeaf = (nodes_[node] & kLeafBit) != 0;
  if (!isLeaf && level < kDirectoryLevel) {
    for (std::uint32_t c = 0; c < 8; ++c) {
      fillDirectory(
          nodes_[node] + c, level + 1,
          {2 * corner[0] + (c & 1U), 2 * corner[1] + (c >> 1U & 1U), 2 * corner[2] + (c >> 2U)});
    }
    return;
  }
  const std::uint32_t shift = kDirectoryLevel - level;
  const std::uint32_t side = 1U << shift;
  for (std::uint32_t z = 0; z < side; ++z) {
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x) {
        const std::uint32_t row =
            ((corner[2] << shift) + z) << kDirectoryLevel | ((corner[1] << shift) + y);
        directory_[row << kDirectoryLevel | ((corner[0] << shift) + x)] = {node, level};
      }
    }
  }
}

double SizeOctree::sizeAt(const Vec3& position) const {
  constexpr double kLattice = static_cast<double>(1U << kMaxLevel);
  // Clamp before the conversion: a distant position must not overflow the integers.
  const auto clamped = [kLattice](double v) { return std::min(std::max(0.0, v), kLattice); };
  const double x = clamped((position.x - origin_.x) * latticePerLength_);
  const double y = clamped((position.y - origin_.y) * latticePerLength_);
  const double z = clamped((position.z - origin_.z) * latticePerLength_);
  constexpr std::uint32_t kLast = (1U << kMaxLevel) - 1U;
  const std::uint32_t i = std::min(static_cast<std::uint32_t>(x), kLast);
  const std::uint32_t j = std::min(static_cast<std::uint32_t>(y), kLast);
  const std::uint32_t k = std::min(static_cast<std::uint32_t>(z), kLast);
  constexpr std::uint32_t kSkip = kMaxLevel - kDirectoryLevel;
  const DirectoryEntry entry =
      directory_[((k >> kSkip) << kDirectoryLevel | (j >> kSkip)) << kDirectoryLevel |
                 (i >> kSkip)];
  std::uint32_t shift = kMaxLevel - entry.level;
  std::uint32_t node = nodes_[entry.node];
  while ((node & kLeafBit) == 0) {
    --shift;
    node = nodes_[node + ((i >> shift & 1U) | (j >> shift & 1U) << 1U | (k >> shift & 1U) << 2U)];
  }
  const Leaf& leaf = leaves_[node & ~kLeafBit];
  const double scale = 1.0 / static_cast<double>(1U << shift);
  const double u = (x - static_cast<double>(i >> shift << shift)) * scale;
  const double v = (y - static_cast<double>(j >> shift << shift)) * scale;
  const double w = (z - static_cast<double>(k >> shift << shift)) * scale;
  const auto along = [&](std::size_t c) { return leaf[c] + u * (double{leaf[c + 1]} - leaf[c]); };
  const double low = along(0) + v * (along(2) - along(0));
  const double high = along(4) + v * (along(6) - along(4));
  return low + w * (high - low);
}

}  // namespace tetrafront
