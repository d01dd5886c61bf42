#include "preview/source_selection.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tetrafront {
namespace {

/// A source is redundant if the kept sources ask for at most this many times its size all along it.
constexpr double kRedundantRatio = 1.25;
/// Number of sources that are kept in a list before all of them go into a tree.
constexpr std::size_t kListLength = 64;

std::size_t pointCount(SourceType type) { return static_cast<std::size_t>(type) + 1; }

}  // namespace

void SourceSelection::add(const SizeSource& source) {
  if (isRedundant(source)) return;
  kept_.push_back(source);
  if (kept_.size() - indexedCount_ < kListLength) return;
  indexed_ = SizeSources(kept_);
  indexedCount_ = kept_.size();
}

/// Tests the points of the source and their mean.
bool SourceSelection::isRedundant(const SizeSource& source) const {
  const std::size_t count = pointCount(source.type);
  const double enough = kRedundantRatio * source.size;
  std::array<Vec3, 4> positions;
  Vec3 middle(0.0);
  for (std::size_t k = 0; k < count; ++k) {
    positions[k] = source.points[k];
    middle += source.points[k] * (1.0 / static_cast<double>(count));
  }
  positions[count] = middle;
  return std::all_of(positions.begin(), positions.begin() + static_cast<std::ptrdiff_t>(count) + 1,
                     [&](const Vec3& position) { return isServed(position, enough); });
}

/// True if the kept sources ask for at most the size `enough` at `position`.
bool SourceSelection::isServed(const Vec3& position, double enough) const {
  if (indexed_.cappedSize(position, 2.0 * enough) <= enough) return true;
  return std::any_of(kept_.begin() + static_cast<std::ptrdiff_t>(indexedCount_), kept_.end(),
                     [&](const SizeSource& other) { return sizeOf(other, position) <= enough; });
}

}  // namespace tetrafront
