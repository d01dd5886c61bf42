#include "field/size_sources.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "base/ids.h"
#include "geom/coordinates.h"
#include "geom/measure.h"
#include "search/morton.h"
#include "tetrafront/options.h"

namespace tetrafront {
namespace {

/// Number of sources above which a tree is built.
constexpr std::size_t kHandful = 8;

std::size_t pointCountOf(SourceType type) { return static_cast<std::size_t>(type) + 1; }

double distanceTo(const SizeSource& source, const Vec3& position) {
  const auto& [a, b, c] = source.points;
  switch (source.type) {
    case SourceType::kPoint:
      return glm::length(position - a);
    case SourceType::kSegment:
      return std::sqrt(squaredDistanceToSegment(position, a, b));
    case SourceType::kTriangle:
      return std::sqrt(squaredDistanceToTriangle(position, a, b, c));
  }
  return 0.0;
}

double grown(double size, double growth, double beyond) {
  return size + growth * std::max(0.0, beyond);
}

}  // namespace

double sizeOf(const SizeSource& source, const Vec3& position) {
  return grown(source.size, source.growth, distanceTo(source, position) - source.distance);
}

SizeSources::SizeSources(std::span<const SizeSource> sources)
    : sources_(sources.begin(), sources.end()) {
  if (sources_.size() > kHandful) buildTree();
}

void SizeSources::buildTree() {
  std::vector<Vec3> centres;
  centres.reserve(sources_.size());
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Branch own = branchOf(i, i + 1);
    centres.push_back(0.5 * (own.low + own.high));
  }
  std::vector<SizeSource> ordered;
  ordered.reserve(sources_.size());
  for (const std::uint32_t i : mortonOrder(centres)) ordered.push_back(sources_[i]);
  sources_ = std::move(ordered);
  std::size_t leaves = 1;
  while (leaves * kSourcesPerLeaf < sources_.size()) leaves *= 2;
  firstLeaf_ = leaves - 1;
  branches_.reserve(2 * leaves - 1);
  branches_.resize(firstLeaf_);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    const std::size_t first = std::min(leaf * kSourcesPerLeaf, sources_.size());
    branches_.push_back(branchOf(first, std::min(first + kSourcesPerLeaf, sources_.size())));
  }
  for (std::size_t n = firstLeaf_; n-- > 0;) {
    branches_[n] = branches_[2 * n + 1];
    widen(branches_[n], branches_[2 * n + 2]);
  }
}

/// Returns the branch of the sources `first` to `last` - 1. Without sources, it caps nothing.
SizeSources::Branch SizeSources::branchOf(std::size_t first, std::size_t last) const {
  constexpr double kFar = std::numeric_limits<double>::max();
  Branch branch{Vec3(kFar), Vec3(-kFar), kFar, 0.0, kFar};
  for (std::size_t i = first; i < last; ++i) {
    const SizeSource& source = sources_[i];
    Branch own{source.points[0], source.points[0], source.size, source.distance, source.growth};
    for (std::size_t k = 1; k < pointCountOf(source.type); ++k) {
      own.low = glm::min(own.low, source.points[k]);
      own.high = glm::max(own.high, source.points[k]);
    }
    widen(branch, own);
  }
  return branch;
}

void SizeSources::widen(Branch& branch, const Branch& by) {
  branch.low = glm::min(branch.low, by.low);
  branch.high = glm::max(branch.high, by.high);
  branch.size = std::min(branch.size, by.size);
  branch.distance = std::max(branch.distance, by.distance);
  branch.growth = std::min(branch.growth, by.growth);
}

double SizeSources::lowerBoundAt(const Branch& branch, const Vec3& position) {
  const Vec3 gap = glm::max(glm::max(branch.low - position, position - branch.high), Vec3(0.0));
  return grown(branch.size, branch.growth, std::sqrt(glm::dot(gap, gap)) - branch.distance);
}

double SizeSources::cappedSize(const Vec3& position, double size) const {
  if (branches_.empty()) {
    for (const SizeSource& source : sources_) size = std::min(size, sizeOf(source, position));
    return size;
  }
  struct Open {
    std::size_t branch;
    double lowerBound;
  };
  std::array<Open, kStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, lowerBoundAt(branches_[0], position)};
  while (waiting > 0) {
    const Open open = stack[--waiting];
    if (!(open.lowerBound < size)) continue;
    if (open.branch < firstLeaf_) {
      const std::size_t child = 2 * open.branch + 1;
      const Open left{child, lowerBoundAt(branches_[child], position)};
      const Open right{child + 1, lowerBoundAt(branches_[child + 1], position)};
      const bool leftFirst = left.lowerBound <= right.lowerBound;
      stack[waiting++] = leftFirst ? right : left;
      stack[waiting++] = leftFirst ? left : right;
      continue;
    }
    const std::size_t first = (open.branch - firstLeaf_) * kSourcesPerLeaf;
    const std::size_t last = std::min(first + kSourcesPerLeaf, sources_.size());
    for (std::size_t i = first; i < last; ++i) size = std::min(size, sizeOf(sources_[i], position));
  }
  return size;
}

std::vector<Diagnostic> checkSizeSources(std::span<const SizeSource> sources) {
  std::vector<Diagnostic> found;
  for (const SourceId id : IdRange<SourceId>(sources.size())) {
    const SizeSource& source = sources[id.index()];
    const std::vector<Entity> entities{entityOf(id)};
    const std::size_t points = std::min(pointCountOf(source.type), source.points.size());
    const auto end = source.points.begin() + static_cast<std::ptrdiff_t>(points);
    const auto refused = std::find_if_not(source.points.begin(), end, isFinite);
    if (refused != end) {
      found.push_back(
          diagnose<DiagnosticCode::kNotFinite>(refusedCoordinate(*refused)).about(entities));
    }
    // Comparisons with NaN are false.
    const bool isValid = source.size >= kSmallestExtent && source.size <= kLargestCoordinate &&
                         source.distance >= 0.0 && source.distance <= kLargestCoordinate &&
                         source.growth >= 0.0 && source.growth <= kMaxGrowth &&
                         source.type <= SourceType::kTriangle;
    if (isValid) continue;
    Diagnostic& outOfRange = found.emplace_back(
        diagnose<DiagnosticCode::kSourceOutOfRange>(source.size, source.distance, source.growth)
            .about(entities));
    if (refused == end) outOfRange = std::move(outOfRange).at(source.points[0]);
  }
  return found;
}

}  // namespace tetrafront
