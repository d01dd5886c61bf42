#include "field/size_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "search/morton.h"

namespace tetrafront {
namespace {

/// Smallest extent / size: squares of sizes relative to it fit single precision.
constexpr double kMinExtentPerSize = 1e-10;

float larger(float a, float b) { return a > b ? a : b; }

/// Returns the squared distance between two boxes; 0 if they overlap.
template <class LowA, class HighA, class LowB, class HighB>
float gapSquared(const LowA& lowA, const HighA& highA, const LowB& lowB, const HighB& highB) {
  float sum = 0.0F;
  for (std::size_t k = 0; k < 3; ++k) {
    const float gap = larger(larger(lowA[k] - highB[k], lowB[k] - highA[k]), 0.0F);
    sum += gap * gap;
  }
  return sum;
}

}  // namespace

SizeSites::SizeSites(std::span<const Vec3> points, std::span<const double> sizes, double growth,
                     float slack)
    : slack_(slack), growth_(growth), squaredGrowth_(static_cast<float>(growth * growth)) {
  Vec3 lower(std::numeric_limits<double>::max());
  Vec3 upper(-std::numeric_limits<double>::max());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (sizes[i] == 0.0 || std::isnan(sizes[i])) continue;
    building_.positions.push_back(points[i]);
    building_.sizes.push_back(sizes[i]);
    lower = glm::min(lower, points[i]);
    upper = glm::max(upper, points[i]);
  }
  centre_ = 0.5 * (lower + upper);
  extent_ = std::max(std::max(upper.x - lower.x, upper.y - lower.y), upper.z - lower.z);
  // All sites may be at one position.
  for (const double size : building_.sizes) {
    extent_ = std::max(extent_, kMinExtentPerSize * std::fabs(size));
  }
}

Task<> SizeSites::build(Work& work, std::size_t visitsPerUnit) {
  work.beginPart(0.85);
  order_ = co_await mortonOrder(work, building_.positions, visitsPerUnit);
  beginTree(order_.size());
  work.beginPart(0.95);
  co_await work.forEachId<std::size_t>(
      order_.size(), [this](std::size_t i) { addSite(order_[i]); }, visitsPerUnit);
  work.beginPart(1.0);
  co_await work.forEachId<std::size_t>(
      firstLeaf_, [this](std::size_t i) { join(firstLeaf_ - 1 - i); }, visitsPerUnit);
  building_ = {};
}

std::array<float, 3> SizeSites::inward(const Vec3& position) const {
  const Vec3 p = (position - centre_) / extent_;
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

SizeSites::Reach SizeSites::inward(const Range& range) const {
  return {inward(range.lower), inward(range.upper)};
}

void SizeSites::beginTree(std::size_t count) {
  std::uint32_t leaves = 1;
  while (std::size_t{leaves} * kSitesPerLeaf < count) leaves *= 2;
  firstLeaf_ = leaves - 1;
  constexpr float kFar = std::numeric_limits<float>::max();
  // Empty leaves keep a size that is never below a limit.
  const Reach nothing{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  building_.boxes.assign(2 * std::size_t{leaves} - 1, nothing);
  building_.smallest.assign(building_.boxes.size(), kFar);
  smallest_.assign(building_.boxes.size(), SiteId(0U));
  children_.resize(firstLeaf_);
  sites_.reserve(count);
}

void SizeSites::include(std::size_t node, const Reach& reach, float size, SiteId site) {
  Reach& box = building_.boxes[node];
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], reach.low[k]);
    box.high[k] = std::max(box.high[k], reach.high[k]);
  }
  if (size >= building_.smallest[node]) return;
  building_.smallest[node] = size;
  smallest_[node] = site;
}

/// Puts the next site of the curve into its leaf.
void SizeSites::addSite(std::uint32_t given) {
  const Site site{inward(building_.positions[given]), inward(building_.sizes[given])};
  const SiteId id(sites_.size());
  sites_.push_back(site);
  include(firstLeaf_ + id.index() / kSitesPerLeaf, {site.position, site.position}, site.size, id);
}

/// Makes an inner node from its two children.
void SizeSites::join(std::size_t node) {
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t child = 2 * node + 1 + side;
    const Reach& box = building_.boxes[child];
    const float size = building_.smallest[child];
    include(node, box, size, smallest_[child]);
    float squared = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      children_[node].low[k][side] = box.low[k];
      children_[node].high[k][side] = box.high[k];
      const float width =
          size < std::numeric_limits<float>::max() ? box.high[k] - box.low[k] : 0.0F;
      squared += width * width;
    }
    children_[node].size[side] = size;
    children_[node].diagonal[side] = std::sqrt(squared);
  }
}

/// Returns the minimum of the cone in the reach.
float SizeSites::cone(SiteId site, const Reach& reach) const {
  const Site& s = sites_[site.index()];
  const float squared = gapSquared(s.position, s.position, reach.low, reach.high);
  return s.size + static_cast<float>(growth_) * std::sqrt(squared);
}

/// Returns whether size + growth * distance < limit, without a square root.
bool SizeSites::liesBelow(float size, float squaredDistance, float limit) const {
  const float margin = limit - size;
  return margin > 0.0F && squaredGrowth_ * squaredDistance < margin * margin;
}

/// Calls visit(first, last) for runs of sites that may fall below `limit` in the reach, near
/// branches first. `visit` may lower `limit`. Of a box in which a cone changes by less than
/// `merge`, visits only the site of smallest size. Stops when `visit` returns false.
template <class Visit>
void SizeSites::visitBoxes(const Reach& reach, const float& limit, const float& merge,
                           Visit visit) const {
  const auto count = static_cast<std::uint32_t>(sites_.size());
  if (firstLeaf_ == 0) {
    visit(0, count);
    return;
  }
  struct Open {
    std::uint32_t node;
    float squared;
    float size;
    float diagonal;
  };
  std::array<Open, 64> stack;  // at most one entry per level
  std::size_t waiting = 0;
  constexpr float kLargestFloat = std::numeric_limits<float>::max();
  stack[waiting++] = {0, 0.0F, -kLargestFloat, kLargestFloat};
  while (waiting > 0) {
    const Open open = stack[--waiting];
    if (!liesBelow(open.size, open.squared, limit)) continue;
    if (static_cast<float>(growth_) * open.diagonal < merge) {
      const std::uint32_t site = smallest_[open.node].value;
      if (!visit(site, site + 1)) return;
      continue;
    }
    if (open.node >= firstLeaf_) {
      const std::uint32_t first = (open.node - firstLeaf_) * kSitesPerLeaf;
      if (!visit(first, std::min(first + kSitesPerLeaf, count))) return;
      continue;
    }
    const Children& pair = children_[open.node];
    std::array<float, 2> squared{0.0F, 0.0F};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t side = 0; side < 2; ++side) {
        const float below = pair.low[k][side] - reach.high[k];
        const float above = reach.low[k] - pair.high[k][side];
        const float gap = larger(larger(below, above), 0.0F);
        squared[side] += gap * gap;
      }
    }
    const std::size_t near = squared[0] <= squared[1] ? 0 : 1;
    for (const std::size_t side : {1 - near, near}) {
      if (!liesBelow(pair.size[side], squared[side], limit)) continue;
      const std::uint32_t child = 2 * open.node + 1 + static_cast<std::uint32_t>(side);
      stack[waiting++] = {child, squared[side], pair.size[side], pair.diagonal[side]};
    }
  }
}

/// Returns the permitted error of the value of the site's cone.
float SizeSites::toleranceOf(float value, SiteId site) const {
  return slack_ * larger(std::fabs(value), std::fabs(sites_[site.index()].size));
}

/// Lowers `best`, the value of the site's cone in the reach, up to the tolerance. The tolerance
/// depends on `best`: if it falls by much, boxes that were represented by one site are visited
/// again.
void SizeSites::improve(const Reach& reach, float& best, SiteId& site) const {
  constexpr float kMuchHigher = 2.0F;
  float atFirst = 0.0F;
  float tolerance = toleranceOf(best, site);
  do {
    atFirst = tolerance;
    float limit = best - tolerance;
    visitBoxes(reach, limit, tolerance, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t i = first; i < last; ++i) {
        const float size = cone(SiteId(i), reach);
        if (size >= best) continue;
        best = size;
        site = SiteId(i);
      }
      tolerance = toleranceOf(best, site);
      limit = best - tolerance;
      return true;
    });
  } while (atFirst > kMuchHigher * tolerance);
}

SizeSites::Value SizeSites::at(const Vec3& position, SiteId guess) const {
  const std::array<float, 3> p = inward(position);
  const Reach reach{p, p};
  SiteId site = guess;
  float best = cone(guess, reach);
  improve(reach, best, site);
  return {best * extent_, site};
}

double SizeSites::coneAt(const Vec3& position, SiteId site) const {
  const std::array<float, 3> p = inward(position);
  return double{cone(site, {p, p})} * extent_;
}

SizeSites::Value SizeSites::at(const Vec3& position, SiteId guess,
                               std::span<const SiteId> list) const {
  const std::array<float, 3> p = inward(position);
  const Reach reach{p, p};
  SiteId site = guess;
  float best = cone(guess, reach);
  for (const SiteId i : list) {
    const std::array<float, 3>& q = sites_[i.index()].position;
    const float dx = p[0] - q[0];
    const float dy = p[1] - q[1];
    const float dz = p[2] - q[2];
    if (!liesBelow(sites_[i.index()].size, dx * dx + dy * dy + dz * dz, best)) continue;
    best = cone(i, reach);
    site = i;
  }
  return {best * extent_, site};
}

double SizeSites::minIn(const Range& range, double limit, SiteId guess) const {
  const Reach reach = inward(range);
  SiteId site = guess;
  float smallest = std::min(inward(limit), cone(guess, reach));
  improve(reach, smallest, site);
  return std::min(limit, smallest * extent_);
}

double SizeSites::collect(const Range& range, double limit, std::size_t maxCount,
                          std::vector<SiteId>& list) const {
  list.clear();
  const Reach reach = inward(range);
  const float highest = inward(limit);
  float smallest = highest;
  constexpr float kNoMerge = 0.0F;
  visitBoxes(reach, highest, kNoMerge, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) {
      const float size = cone(SiteId(i), reach);
      if (size >= highest) continue;
      smallest = std::min(smallest, size);
      list.emplace_back(i);
    }
    return list.size() <= maxCount;
  });
  return std::min(limit, smallest * extent_);
}

double SizeSites::collect(const Range& range, double limit, std::span<const SiteId> among,
                          std::vector<SiteId>& list) const {
  list.clear();
  const Reach reach = inward(range);
  const float highest = inward(limit);
  float smallest = highest;
  for (const SiteId i : among) {
    const std::array<float, 3>& q = sites_[i.index()].position;
    if (!liesBelow(sites_[i.index()].size, gapSquared(q, q, reach.low, reach.high), highest))
      continue;
    smallest = std::min(smallest, cone(i, reach));
    list.push_back(i);
  }
  return std::min(limit, smallest * extent_);
}

}  // namespace tetrafront
