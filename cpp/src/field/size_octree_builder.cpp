#include "field/size_octree_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/ids.h"

namespace tetrafront {
namespace {

/// Cell width / smallest size in the cell up to which the cell is not split.
constexpr double kCellPerSize = 1.5;
/// Relative difference of sizes below which a cell is not split.
constexpr double kFlatSpread = 0.10;
/// Far from the surface the field is nearly linear. A cell of up to this width / smallest size is
/// not split if ...
constexpr double kSmoothCellPerSize = 4.0;
/// ... the value at its centre differs from the mean of the corners by at most this fraction of the
/// smallest size.
constexpr double kFlatBend = 0.03;
/// Maximum number of cones that reach a cell with a list; larger cells query the tree.
constexpr std::size_t kMaxListLength = 128;
/// Smallest cap / edge of the box: single precision cannot distinguish a smaller one from zero.
constexpr double kMinCap = 1e-20;
/// Far below the sizes at the surface, errors are relative to this fraction of them.
constexpr float kDescentSlack = 0.01F;
/// Slack of the smallest sizes: coarser cells suffice, some dozens per triangle.
constexpr double kDeepShare = 0.25;
/// Half the diagonal of the unit cube.
constexpr double kHalfDiagonal = 0.8660254037844386;
/// Quantile of the node sizes that caps the field if no cap is given, unless the mean over the
/// surface's area is larger. A small solid with small triangles in a large box has nearly all
/// nodes, but does not represent the sizes in the rest of the box.
constexpr double kCapQuantile = 0.9;
/// Sites per unit of budget: visiting this many in order costs as much as one cell.
constexpr std::size_t kSitesPerCell = 32;
/// Margin of the box / extent of the surface, so that rounding never puts a node outside.
constexpr double kBoxMargin = 1.0 / 64.0;
/// Quantile of the node sizes that determines the edge of the box.
constexpr double kFinestQuantile = 0.2;

/// Calls use(a, b) for the edges of each triangle, in its orientation.
template <class Use>
void forEachEdge(std::span<const std::uint32_t> triangles, Use use) {
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      use(NodeId(triangles[t + k]), NodeId(triangles[t + (k + 1) % 3]));
    }
  }
}

/// Adds the edge lengths of each triangle to both of their ends. An edge of a closed surface has
/// two triangles, so every edge at a node counts twice.
std::vector<double> meanEdgeLengths(std::span<const Vec3> points,
                                    std::span<const std::uint32_t> triangles,
                                    std::span<const SymmetricTensor> views) {
  const auto lengthOf = [](const Vec3& d) { return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z); };
  std::vector<double> sum(points.size(), 0.0);
  std::vector<std::uint32_t> count(points.size(), 0);
  forEachEdge(triangles, [&](NodeId a, NodeId b) {
    const Vec3 d = points[b.index()] - points[a.index()];
    for (const NodeId node : {a, b}) {
      sum[node.index()] += lengthOf(views.empty() ? d : views[node.index()] * d);
      ++count[node.index()];
    }
  });
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (count[i] > 0) sum[i] /= count[i];
  }
  return sum;
}

/// Replaces each value by half of itself and half the mean of its neighbours.
void averageOnce(std::span<const std::uint32_t> triangles, std::vector<double>& sizes) {
  std::vector<double> sum(sizes.size(), 0.0);
  std::vector<std::uint32_t> count(sizes.size(), 0);
  forEachEdge(triangles, [&](NodeId a, NodeId b) {
    sum[a.index()] += sizes[b.index()];
    sum[b.index()] += sizes[a.index()];
    ++count[a.index()];
    ++count[b.index()];
  });
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (count[i] > 0) sizes[i] = 0.5 * (sizes[i] + sum[i] / count[i]);
  }
}

double quantile(std::span<const double> sizes, double share) {
  std::vector<double> used;
  used.reserve(sizes.size());
  for (const double size : sizes) {
    if (size > 0.0) used.push_back(size);
  }
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(used.size() - 1));
  std::nth_element(used.begin(), used.begin() + static_cast<std::ptrdiff_t>(rank), used.end());
  return used[rank];
}

/// Returns the mean of the sizes over the surface's area.
double meanOverArea(std::span<const Vec3> points, std::span<const std::uint32_t> triangles,
                    std::span<const double> sizes) {
  double sum = 0.0;
  double areas = 0.0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const NodeId a(triangles[t]);
    const NodeId b(triangles[t + 1]);
    const NodeId c(triangles[t + 2]);
    const Vec3 origin = points[a.index()];
    const Vec3 normal = glm::cross(points[b.index()] - origin, points[c.index()] - origin);
    const double area = glm::length(normal);
    sum += area * (sizes[a.index()] + sizes[b.index()] + sizes[c.index()]) / 3.0;
    areas += area;
  }
  return areas > 0.0 ? sum / areas : 0.0;
}

/// Returns an edge of the root, at least as long as `extent`, whose halves match the widest cells
/// that `size` allows. An unlucky edge leads to up to eight times as many cells.
double rootEdge(double extent, double size) {
  double edge = kCellPerSize * size;
  for (int level = 0; level < 64 && edge < extent; ++level) edge *= 2.0;
  return std::max(edge, extent);
}

}  // namespace

std::vector<double> averagedEdgeLengths(std::span<const Vec3> points,
                                        std::span<const std::uint32_t> triangles,
                                        std::span<const SymmetricTensor> views) {
  std::vector<double> sizes = meanEdgeLengths(points, triangles, views);
  averageOnce(triangles, sizes);
  averageOnce(triangles, sizes);
  return sizes;
}

SizeOctreeBuilder::SizeOctreeBuilder(std::span<const Vec3> points,
                                     std::span<const std::uint32_t> triangles, double growth,
                                     double cap) {
  const std::vector<double> sizes = averagedEdgeLengths(points, triangles);
  growFrom(points, sizes, growth,
           cap > 0.0
               ? cap
               : std::max(quantile(sizes, kCapQuantile), meanOverArea(points, triangles, sizes)));
}

SizeOctreeBuilder::SizeOctreeBuilder(std::span<const Vec3> points, std::span<const double> lengths,
                                     double growth, double cap) {
  growFrom(points, lengths, growth, cap);
}

void SizeOctreeBuilder::growFrom(std::span<const Vec3> points, std::span<const double> sizes,
                                 double growth, double cap) {
  tree_.cap_ = cap;
  placeRoot(points, sizes);
  sites_.emplace(points, sizes, growth);
}

SizeOctreeBuilder::SizeOctreeBuilder(std::span<const Vec3> positions,
                                     std::span<const double> lengths, const SizeDescent& rule)
    : rule_(rule) {
  tree_.cap_ = std::numeric_limits<double>::max();
  placeRoot(positions, lengths);
  // The maximum of falling cones is the negative minimum of rising ones.
  std::vector<double> negated;
  negated.reserve(lengths.size());
  for (const double length : lengths) negated.push_back(-length);
  sites_.emplace(positions, negated, rule.descent, kDescentSlack);
}

void SizeOctreeBuilder::placeRoot(std::span<const Vec3> points, std::span<const double> sizes) {
  Vec3 lower(std::numeric_limits<double>::max());
  Vec3 upper(-std::numeric_limits<double>::max());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(sizes[i] > 0.0)) continue;
    lower = glm::min(lower, points[i]);
    upper = glm::max(upper, points[i]);
  }
  const double extent = std::max(std::max(upper.x - lower.x, upper.y - lower.y), upper.z - lower.z);
  edge_ = rootEdge(extent * (1.0 + 2.0 * kBoxMargin), quantile(sizes, kFinestQuantile));
  tree_.origin_ = 0.5 * (lower + upper) - Vec3(0.5 * edge_);
  tree_.latticePerLength_ = static_cast<double>(1U << SizeOctree::kMaxLevel) / edge_;
  tree_.cap_ = std::max(tree_.cap_, kMinCap * edge_);
  tree_.nodes_.assign(1, 0);
  open_.reserve(SizeOctree::kMaxLevel + 1);
}

Task<> SizeOctreeBuilder::build(Work& work) {
  co_await sites_->build(work, kSitesPerCell);
  refineRoot();
  while (!open_.empty()) {
    Frame& frame = open_.back();
    if (frame.next == frame.children.size()) {
      open_.pop_back();
    } else {
      // Frames do not move: the capacity is the number of levels.
      refine(frame.children[frame.next++], frame.reaching);
    }
    co_await work.spend(1);
  }
}

SizeOctree SizeOctreeBuilder::take() {
  tree_.fillDirectory();
  return std::move(tree_);
}

void SizeOctreeBuilder::refineRoot() {
  Cell root{0, 0, tree_.origin_, {}};
  SiteId guess(0U);
  for (unsigned k = 0; k < 8; ++k) {
    root.corners[k] = sites_->at(root.lower + edge_ * Vec3(k & 1U, k >> 1U & 1U, k >> 2U), guess);
    guess = root.corners[k].site;
  }
  refine(root, nullptr);
}

double SizeOctreeBuilder::width(int level) const {
  return edge_ / static_cast<double>(std::uint64_t{1} << static_cast<unsigned>(level));
}

SizeSites::Value SizeOctreeBuilder::sample(const Vec3& position, SiteId guess,
                                           const List* reaching) const {
  return reaching != nullptr ? sites_->at(position, guess, *reaching) : sites_->at(position, guess);
}

void SizeOctreeBuilder::refine(const Cell& cell, const List* reaching) {
  const double w = width(cell.level);
  const Value centre = sample(cell.lower + Vec3(0.5 * w), cell.corners[0].site, reaching);
  if (rule_ && descentIsFine(cell, centre)) return close(cell);
  // The slope of the field is at most `growth`, which bounds it around the centre.
  const double swing = kHalfDiagonal * w * sites_->growth();
  Extremes sizes = extremesAt(cell, stored(centre));
  sizes.max = std::min(tree_.cap_, centre.size + swing);
  const SizeSites::Range range{cell.lower, cell.lower + Vec3(w)};
  List& own = lists_[static_cast<std::size_t>(cell.level)];
  own.clear();
  bool hasList = false;
  double lowerBound = std::min(sizes.max, centre.size - swing);
  if (reaching != nullptr) {
    lowerBound = sites_->collect(range, sizes.max, *reaching, own);
    hasList = true;
  } else if (estimatedReach(centre, sizes.max) < static_cast<double>(kMaxListLength)) {
    const double lowest = sites_->collect(range, sizes.max, kMaxListLength, own);
    hasList = own.size() <= kMaxListLength;
    // The lowest of only some sites is no bound.
    if (hasList) lowerBound = lowest;
  }
  // Samples may miss a small feature. If they would not split the cell, look for one.
  if (!rule_ && !hasList && isFine(w, sizes) && !isFine(w, sizes.loweredTo(lowerBound))) {
    lowerBound = sites_->minIn(range, sizes.max, centre.site);
  }
  const bool fine = !rule_ && isFine(w, sizes.loweredTo(lowerBound));
  if (fine || cell.level == SizeOctree::kMaxLevel) {
    close(cell);
  } else {
    split(cell, centre, hasList ? &own : nullptr);
  }
}

/// Returns the extremes of the stored values at the corners and of `middle`, the value at the
/// centre.
SizeOctreeBuilder::Extremes SizeOctreeBuilder::extremesAt(const Cell& cell, double middle) const {
  double lowest = middle;
  double highest = middle;
  double sum = 0.0;
  for (const Value& corner : cell.corners) {
    const double size = stored(corner);
    lowest = std::min(lowest, size);
    highest = std::max(highest, size);
    sum += size;
  }
  return {lowest, highest, lowest, std::fabs(sum / 8.0 - middle)};
}

bool SizeOctreeBuilder::isFine(double width, const Extremes& sizes) {
  if (width <= kCellPerSize * sizes.min) return true;
  if (sizes.max - sizes.min <= kFlatSpread * sizes.min) return true;
  return width <= kSmoothCellPerSize * sizes.min && sizes.bend <= kFlatBend * sizes.min &&
         sizes.sampledMin - sizes.min <= kFlatSpread * sizes.min;
}

bool SizeOctreeBuilder::descentIsFine(const Cell& cell, const Value& centre) const {
  const double w = width(cell.level);
  const Extremes sizes = extremesAt(cell, stored(centre));
  const double swing = kHalfDiagonal * w * sites_->growth();
  if (stored(centre) + swing <= rule_->minSize) return true;
  const double scale = std::max(sizes.min, kDeepShare * lengthAt(centre.site));
  if (w <= kCellPerSize * scale) return true;
  return w <= kSmoothCellPerSize * scale && sizes.bend <= kFlatBend * scale;
}

/// Estimates how many sites have cones below `limit`, as if the surface were a plane with the size
/// of the nearest site.
double SizeOctreeBuilder::estimatedReach(const Value& nearest, double limit) const {
  const double size = sites_->sizeOf(nearest.site);
  const double reach = limit - size;
  const double height = nearest.size - size;
  const double scale = lengthAt(nearest.site) * sites_->growth();
  return 4.0 * (reach * reach - height * height) / (scale * scale);
}

void SizeOctreeBuilder::close(const Cell& cell) {
  SizeOctree::Leaf leaf;
  for (unsigned k = 0; k < 8; ++k) {
    leaf[k] = static_cast<float>(stored(cell.corners[k]));
  }
  tree_.nodes_[cell.node] = SizeOctree::kLeafBit | static_cast<std::uint32_t>(tree_.leaves_.size());
  tree_.leaves_.push_back(leaf);
}

void SizeOctreeBuilder::split(const Cell& cell, const Value& centre, const List* reaching) {
  // The lattice of 3 x 3 x 3 positions; index x + 3 y + 9 z. Even coordinates are corners.
  const double half = 0.5 * width(cell.level);
  std::array<Value, 27> lattice;
  for (unsigned i = 0; i < 27; ++i) {
    const unsigned x = i % 3, y = i / 3 % 3, z = i / 9;
    const Value& corner = cell.corners[x / 2 + 2 * (y / 2) + 4 * (z / 2)];
    const bool isCorner = x != 1 && y != 1 && z != 1;
    lattice[i] = isCorner  ? corner
                 : i == 13 ? centre
                           : sample(cell.lower + half * Vec3(x, y, z), centre.site, reaching);
  }
  const auto first = static_cast<std::uint32_t>(tree_.nodes_.size());
  tree_.nodes_[cell.node] = first;
  tree_.nodes_.resize(tree_.nodes_.size() + 8);
  Frame frame;
  frame.reaching = reaching;
  for (unsigned c = 0; c < 8; ++c) {
    const unsigned x = c & 1U, y = c >> 1U & 1U, z = c >> 2U;
    Cell& child = frame.children[c];
    child = {first + c, cell.level + 1, cell.lower + half * Vec3(x, y, z), {}};
    for (unsigned k = 0; k < 8; ++k) {
      child.corners[k] = lattice[(x + (k & 1U)) + 3 * (y + (k >> 1U & 1U)) + 9 * (z + (k >> 2U))];
    }
  }
  open_.push_back(frame);
}

}  // namespace tetrafront
