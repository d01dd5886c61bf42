#include "field/size_sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "search/morton.h"

namespace tetrafront {
SizeSites::SizeSites(std::span<const Vec3> points, std::span<const double> sizes, double growth)
    : growth_(growth) {
  std::vector<Site> used;
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(sizes[i] > 0.0)) continue;
    used.push_back({points[i], sizes[i]});
    places.push_back(points[i]);
  }
  sites_.reserve(used.size());
  for (const std::uint32_t i : mortonOrder(places)) sites_.push_back(used[i]);
  buildBoxes();
}

void SizeSites::buildBoxes() {
  const auto count = static_cast<std::uint32_t>(sites_.size());
  std::uint32_t leaves = 1;
  while (leaves * kSitesPerLeaf < count) leaves *= 2;
  firstLeaf_ = leaves - 1;
  const double far = std::numeric_limits<double>::max();
  // Empty leaves keep a size no bound can pass.
  boxes_.assign(2 * std::size_t{leaves} - 1, Box{Vec3(far), Vec3(-far), far, 0.0, 0});
  for (std::uint32_t i = 0; i < count; ++i) {
    Box& box = boxes_[firstLeaf_ + i / kSitesPerLeaf];
    for (int a = 0; a < 3; ++a) {
      box.lower[a] = std::min(box.lower[a], sites_[i].place[a]);
      box.upper[a] = std::max(box.upper[a], sites_[i].place[a]);
    }
    if (sites_[i].size < box.size) {
      box.size = sites_[i].size;
      box.site = i;
    }
  }
  for (std::uint32_t b = firstLeaf_; b-- > 0;) {
    const Box& left = boxes_[2 * std::size_t{b} + 1];
    const Box& right = boxes_[2 * std::size_t{b} + 2];
    for (int a = 0; a < 3; ++a) {
      boxes_[b].lower[a] = std::min(left.lower[a], right.lower[a]);
      boxes_[b].upper[a] = std::max(left.upper[a], right.upper[a]);
    }
    const Box& least = right.size < left.size ? right : left;
    boxes_[b].size = least.size;
    boxes_[b].site = least.site;
  }
  for (Box& box : boxes_) {
    const Vec3 d = box.upper - box.lower;
    if (box.size < far) box.diagonal = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  }
}

namespace {

/// Squared distance between two boxes; 0 if they overlap.
double gapSquared(const Vec3& lowerA, const Vec3& upperA, const Vec3& lowerB, const Vec3& upperB) {
  const double dx = std::max({lowerA.x - upperB.x, lowerB.x - upperA.x, 0.0});
  const double dy = std::max({lowerA.y - upperB.y, lowerB.y - upperA.y, 0.0});
  const double dz = std::max({lowerA.z - upperB.z, lowerB.z - upperA.z, 0.0});
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace

double SizeSites::cone(std::uint32_t site, const Vec3& place) const {
  const Vec3 d = place - sites_[site].place;
  return sites_[site].size + growth_ * std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

/// The least value of the cone in the range.
double SizeSites::cone(std::uint32_t site, const Range& range) const {
  const Vec3& place = sites_[site].place;
  return sites_[site].size +
         growth_ * std::sqrt(gapSquared(place, place, range.lower, range.upper));
}

/// size + growth * distance < limit, without the root.
bool SizeSites::liesBelow(double size, double squaredDistance, double limit) const {
  const double room = limit - size;
  return room > 0.0 && growth_ * growth_ * squaredDistance < room * room;
}

double SizeSites::squaredDistance(std::uint32_t box, const Range& range) const {
  return gapSquared(boxes_[box].lower, boxes_[box].upper, range.lower, range.upper);
}

/// Calls visit(first, last) for runs of sites that may fall below `limit` in the range, nearer
/// branches first; `limit` may sink meanwhile. Boxes over which a cone changes by less than
/// `merge` are visited through their smallest site alone. Stops when visit returns false.
template <class Visit>
void SizeSites::visitBoxes(const Range& range, const double& limit, const double& merge,
                           Visit visit) const {
  struct Open {
    std::uint32_t box;
    double squaredDistance;
  };
  std::array<Open, 64> stack;  // at most one entry per level waits
  std::size_t waiting = 0;
  stack[waiting++] = {0, squaredDistance(0, range)};
  while (waiting > 0) {
    const Open open = stack[--waiting];
    const Box& box = boxes_[open.box];
    if (!liesBelow(box.size, open.squaredDistance, limit)) continue;
    if (growth_ * box.diagonal < merge) {
      if (!visit(box.site, box.site + 1)) return;
      continue;
    }
    if (open.box >= firstLeaf_) {
      const std::uint32_t first = (open.box - firstLeaf_) * kSitesPerLeaf;
      if (!visit(first, std::min(first + kSitesPerLeaf, static_cast<std::uint32_t>(sites_.size()))))
        return;
      continue;
    }
    const Open left{2 * open.box + 1, squaredDistance(2 * open.box + 1, range)};
    const Open right{2 * open.box + 2, squaredDistance(2 * open.box + 2, range)};
    const bool leftFirst = left.squaredDistance <= right.squaredDistance;
    stack[waiting++] = leftFirst ? right : left;
    stack[waiting++] = leftFirst ? left : right;
  }
}

SizeSites::Value SizeSites::at(const Vec3& place, std::uint32_t guess) const {
  Value best{cone(guess, place), guess};
  double limit = best.size * (1.0 - kSlack);
  double merge = best.size * kMerge;
  visitBoxes({place, place}, limit, merge, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) {
      const double size = cone(i, place);
      if (size < best.size) best = {size, i};
    }
    limit = best.size * (1.0 - kSlack);
    merge = best.size * kMerge;
    return true;
  });
  return best;
}

SizeSites::Value SizeSites::at(const Vec3& place, std::uint32_t guess,
                               std::span<const std::uint32_t> list) const {
  Value best{cone(guess, place), guess};
  for (const std::uint32_t i : list) {
    const Vec3 d = place - sites_[i].place;
    if (liesBelow(sites_[i].size, d.x * d.x + d.y * d.y + d.z * d.z, best.size)) {
      best = {cone(i, place), i};
    }
  }
  return best;
}

double SizeSites::leastIn(const Range& range, double limit) const {
  double least = limit;
  double worthwhile = least * (1.0 - kSlack);
  double merge = least * kMerge;
  visitBoxes(range, worthwhile, merge, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) least = std::min(least, cone(i, range));
    worthwhile = least * (1.0 - kSlack);
    merge = least * kMerge;
    return true;
  });
  return least;
}

double SizeSites::collect(const Range& range, double limit, std::size_t maxCount,
                          std::vector<std::uint32_t>& list) const {
  list.clear();
  double least = limit;
  visitBoxes(range, limit, 0.0, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) {
      const double size = cone(i, range);
      if (size >= limit) continue;
      least = std::min(least, size);
      list.push_back(i);
    }
    return list.size() <= maxCount;
  });
  return least;
}

double SizeSites::collect(const Range& range, double limit, std::span<const std::uint32_t> among,
                          std::vector<std::uint32_t>& list) const {
  list.clear();
  double least = limit;
  for (const std::uint32_t i : among) {
    const Vec3& place = sites_[i].place;
    const double gap = gapSquared(place, place, range.lower, range.upper);
    if (!liesBelow(sites_[i].size, gap, limit)) continue;
    least = std::min(least, cone(i, range));
    list.push_back(i);
  }
  return least;
}

}  // namespace tetrafront
