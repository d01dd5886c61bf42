#include "remesh/remesh_schedule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/sort.h"

namespace tetrafront {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Numbers of rounds of collapsing, splitting and smoothing, and of passes of smoothing. More of
/// them change little.
constexpr int kRounds = 3;
constexpr int kSmoothingPassesAtLast = 2;
constexpr int kFinalSmoothingPasses = 1;
/// Edges shorter than this are collapsed, in target lengths. In the first round only much shorter
/// edges are collapsed: needles have short edges that splits will remove.
constexpr double kShort = 0.75;
constexpr double kVeryShort = 0.5;
/// Coarsening collapses edges shorter than this.
constexpr double kFine = 0.2;
/// Edges longer than this are split, in target lengths.
constexpr double kLong = 1.4;
constexpr double kLongAtLast = 1.5;
/// A pass splits only edges longer than this fraction of the longest one, so that the longest edges
/// are split first everywhere; and also edges of this fraction of the length of the pass before, so that long edges that
/// cannot be split hold back no others.
constexpr double kPassFraction = 0.6;
constexpr int kMaxPasses = 30;
/// Edges split in a pass / edges split in the pass before, for the progress: about 1 / kPassFraction^2.
constexpr double kPassGrowth = 2.8;
/// A pass is the last one if it collapses at most one in this many of the listed edges.
constexpr std::size_t kFewCollapses = 50;
constexpr int kMaxCollapsePasses = 20;
constexpr int kMaxFlipPasses = 20;
/// Work of a pass and those after it / work of the pass, for the progress: each does less than the one before.
constexpr double kWorkPerPass = 1.6;
/// Share of smoothing in the work of smoothing and flips.
constexpr double kSmoothingShare = 0.8;
/// A node nearer to an edge, in target lengths, is the apex of a cap ...
constexpr double kCapHeight = 0.25;
/// ... if its foot is this far from the ends of the edge, relative to its length.
constexpr double kMinFoot = 0.1;
/// Triangles lower than this, in target lengths, are in a strip, whose edges are split in the middle: the nodes of its two
/// lines then face each other, also where the lengths of both differ a little.
constexpr double kStripHeight = 1.0;
/// Flips around a new node.
constexpr int kFlipsAround = 60;
/// Squared sines of 38 and 32 degrees. Triangles with a smaller angle are improved one by one.
constexpr double kPoorSquaredSine = 0.37904;
constexpr double kPoorSquaredSineAtLast = 0.28081;
/// Squared sine of 20 degrees. The few triangles with a smaller angle that remain get more passes.
constexpr double kPoorestSquaredSine = 0.11698;
constexpr int kMaxPoorestPasses = 4;
/// Triangles visited per unit of budget.
constexpr std::size_t kTrianglesPerUnit = 4;

/// Returns where to split an edge of this vector and length, in target lengths, so that it can end as a whole number of equal
/// edges. Halves alone would end anywhere between 0.7 and 1.4. Depends on the edge, and not on the order of its nodes.
double evenPart(const Vec3& vector, double length) {
  const double pieces = std::max(2.0, std::round(length));
  const double part = std::floor(0.5 * pieces) / pieces;
  glm::length_t axis = 0;
  for (const glm::length_t k : {1, 2}) {
    if (std::abs(vector[k]) > std::abs(vector[axis])) axis = k;
  }
  return vector[axis] > 0.0 ? part : 1.0 - part;
}

}  // namespace

Task<> RemeshSchedule::run(Work& work) {
  work.beginPart(0.05);
  co_await flipAll(work);
  for (int round = 0; round < kRounds; ++round) {
    const bool isLast = round + 1 == kRounds;
    const double begin = 0.05 + 0.25 * round;
    const double shortest = round == 0 ? kVeryShort : kShort;
    const double longest = isLast ? kLongAtLast : kLong;
    work.beginPart(begin + 0.05);
    co_await collapseShort(work, shortest, kLong);
    co_await flipAll(work);
    work.beginPart(begin + 0.2);
    co_await splitLong(work, longest);
    co_await flipAll(work);
    work.beginPart(begin + 0.25);
    co_await smoothAndFlip(work, isLast ? kSmoothingPassesAtLast : 1);
  }
  for (const double squaredSine : {kPoorSquaredSine, kPoorSquaredSineAtLast}) {
    work.beginPart(squaredSine == kPoorSquaredSine ? 0.9 : 1.0);
    co_await improvePoor(work, squaredSine);
    co_await smoothAndFlip(work, kFinalSmoothingPasses);
  }
  for (int pass = 0; pass < kMaxPoorestPasses; ++pass) {
    co_await improvePoor(work, kPoorestSquaredSine);
    if (!isImproved_) break;
    co_await smoothAndFlip(work, 1);
  }
}

Task<> RemeshSchedule::coarsen(Work& work) {
  work.beginPart(0.8);
  co_await collapseShort(work, kFine, kUnlimited);
  work.beginPart(1.0);
  co_await flipAll(work);
}

Task<> RemeshSchedule::smoothAndFlip(Work& work, int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    const double left = passes - pass;
    work.beginShare(kSmoothingShare, left);
    co_await smoothAll(work);
    work.beginShare(1.0 - kSmoothingShare, left - kSmoothingShare);
    co_await flipAll(work);
  }
}

/// Returns true if no node of the triangle has a triangle that needs a change.
bool RemeshSchedule::isSettled(TriangleId triangle) const {
  return std::ranges::all_of(complex_.nodesOf(triangle),
                             [&](NodeId node) { return editor_.isSettled(node); });
}

/// Lists the edges with a length outside [shortest, longest], each once.
void RemeshSchedule::collectEdges(double shortest, double longest) {
  edges_.clear();
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
    if (!complex_.isAlive(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfEdgeId halfEdge = halfEdgeOf(t, k);
      const auto [a, b, apex] = complex_.nodesOf(halfEdge);
      if (editor_.isSettled(a) && editor_.isSettled(b)) continue;
      const double length = editor_.lengthOf(a, b);
      if (length >= shortest && length <= longest) continue;
      const NodeId low = std::min(a, b);
      const NodeId high = std::max(a, b);
      if (complex_.halfEdgeBetween(low, high) == halfEdge) edges_.push_back({low, high, length});
    }
  }
}

// ---- collapse -----------------------------------------------------------------------------------

bool RemeshSchedule::collapseIfShort(const Edge& edge, double limit, double longest) {
  if (!complex_.areJoined(edge.a, edge.b) || editor_.lengthOf(edge.a, edge.b) >= limit)
    return false;
  const CollapseRule rule{longest, 0.3, false};
  return editor_.collapse(edge.a, edge.b, rule) || editor_.collapse(edge.b, edge.a, rule);
}

/// Collapses edges shorter than `limit`, the shortest first. `longest`: largest length of a new edge.
Task<> RemeshSchedule::collapseShort(Work& work, double limit, double longest) {
  for (int pass = 0; pass < kMaxCollapsePasses; ++pass) {
    work.beginShare(1.0, kWorkPerPass);
    collectEdges(limit, kUnlimited);
    stableSort(edges_, [](const Edge& x, const Edge& y) { return x.length < y.length; });
    co_await work.yield();
    std::size_t made = 0;
    co_await work.forEachBlock(edges_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        if (collapseIfShort(edges_[i], limit, longest)) ++made;
      }
    });
    if (made * kFewCollapses <= edges_.size()) break;
    if (pass % 2 == 1) co_await flipAll(work);
  }
}

// ---- split --------------------------------------------------------------------------------------

/// Splits edges longer than `limit`, with flips in between. Without the flips, splitting needles
/// would make several times as many triangles.
Task<> RemeshSchedule::splitLong(Work& work, double limit) {
  double least = kUnlimited;
  double expectedPasses = 0.0;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    collectEdges(0.0, limit);
    if (edges_.empty()) break;
    stableSort(edges_, [](const Edge& x, const Edge& y) { return x.length > y.length; });
    if (pass == 0)
      expectedPasses = std::ceil(std::log(edges_[0].length / limit) / -std::log(kPassFraction));
    work.beginPart(std::min(1.0, std::pow(kPassGrowth, pass + 1 - expectedPasses)));
    const bool isLowest = least == limit;
    least = std::max(limit, kPassFraction * std::min(least, edges_[0].length));
    std::erase_if(edges_, [&](const Edge& edge) { return edge.length < least; });
    co_await work.yield();
    bool made = false;
    co_await work.forEachBlock(edges_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) made = splitAndFlip(edges_[i]) || made;
    });
    if (!made && isLowest) break;
  }
}

/// Splits the edge near the middle; or beneath the apex of a cap, which the new node then replaces. A cap whose longest edge
/// is a bend cannot be flipped, and would be split again and again.
bool RemeshSchedule::splitAndFlip(const Edge& edge) {
  double part = 0.5;
  bool isCap = false;
  bool isInStrip = false;
  complex_.collectEdge(edge.a, edge.b, edge_);
  for (const HalfEdgeId halfEdge : edge_) {
    const NodeId apex = complex_.nodesOf(halfEdge).apex;
    const double foot = footOf(edge.a, edge.b, apex);
    const double height = heightOf(edge.a, edge.b, apex);
    isInStrip = isInStrip || height < kStripHeight;
    if (foot <= kMinFoot || foot >= 1.0 - kMinFoot || height >= kCapHeight) continue;
    part = foot;
    isCap = true;
  }
  if (!isCap && !isInStrip)
    part = evenPart(complex_.pointOf(edge.b) - complex_.pointOf(edge.a), edge.length);
  if (!editor_.split(edge.a, edge.b, part)) return editor_.absorb(edge.a, edge.b);
  const NodeId middle(complex_.nodeCount() - 1);
  if (!collapseInto(middle)) flipAround(middle);
  return true;
}

/// Collapses the shortest edge at the node if it is much too short.
bool RemeshSchedule::collapseInto(NodeId node) {
  NodeId nearest{};
  double shortest = kCapHeight;
  complex_.visitStar(node, [&](TriangleId t, std::uint32_t k) {
    const NodeId other = complex_.nodesOf(t)[(k + 1) % 3];
    const double length = editor_.lengthOf(node, other);
    if (length >= shortest) return;
    shortest = length;
    nearest = other;
  });
  if (nearest.isNone()) return false;
  const CollapseRule rule{kLong, 0.0, false};
  return editor_.collapse(nearest, node, rule) || editor_.collapse(node, nearest, rule);
}

/// Returns where on the edge a b, from 0 to 1, the node is nearest.
double RemeshSchedule::footOf(NodeId a, NodeId b, NodeId node) const {
  const Vec3 edge = complex_.pointOf(b) - complex_.pointOf(a);
  const Vec3 offset = complex_.pointOf(node) - complex_.pointOf(a);
  return glm::dot(offset, edge) / glm::dot(edge, edge);
}

/// Returns the distance of the node from the line through a and b, in target lengths.
double RemeshSchedule::heightOf(NodeId a, NodeId b, NodeId node) const {
  const Vec3 edge = complex_.pointOf(b) - complex_.pointOf(a);
  const Vec3 offset = complex_.pointOf(node) - complex_.pointOf(a);
  return glm::length(glm::cross(edge, offset)) / (glm::length(edge) * editor_.sizeOf(node));
}

void RemeshSchedule::flipAround(NodeId node) {
  waiting_.clear();
  complex_.visitStar(node, [&](TriangleId t, std::uint32_t k) {
    const NodeTriple& nodes = complex_.nodesOf(t);
    waiting_.push_back({nodes[(k + 1) % 3], nodes[(k + 2) % 3], 0.0});
    waiting_.push_back({node, nodes[(k + 1) % 3], 0.0});
  });
  for (int i = 0; i < kFlipsAround && !waiting_.empty(); ++i) {
    const auto [a, b, length] = waiting_.back();
    waiting_.pop_back();
    complex_.collectEdge(a, b, edge_);
    if (edge_.size() != 2) continue;
    if (!editor_.mayFlip(edge_[0]) && !editor_.mayFlip(edge_[1])) continue;
    const NodeId c = complex_.nodesOf(edge_[0]).apex;
    const NodeId d = complex_.nodesOf(edge_[1]).apex;
    if (!editor_.flip(a, b)) continue;
    waiting_.insert(waiting_.end(), {{a, c, 0.0}, {c, b, 0.0}, {b, d, 0.0}, {d, a, 0.0}});
  }
}

// ---- flip ---------------------------------------------------------------------------------------

/// Flips edges of the triangle at nodes that have changed since the given time.
bool RemeshSchedule::flipEdges(TriangleId triangle, std::uint32_t since) {
  bool made = false;
  for (std::uint32_t k = 0; k < 3 && complex_.isAlive(triangle); ++k) {
    const HalfEdgeId halfEdge = halfEdgeOf(triangle, k);
    const auto [a, b, apex] = complex_.nodesOf(halfEdge);
    if (std::max(editor_.lastChange(a), editor_.lastChange(b)) < since) continue;
    made = (editor_.mayFlip(halfEdge) && editor_.flip(a, b)) || made;
  }
  return made;
}

Task<> RemeshSchedule::flipAll(Work& work) {
  for (int pass = 0; pass < kMaxFlipPasses; ++pass) {
    work.beginShare(1.0, kWorkPerPass);
    const std::uint32_t since = flipped_;
    flipped_ = editor_.nextTime();
    bool made = false;
    co_await work.forEachBlock(
        complex_.triangleSlots(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t t = first; t < last; ++t) {
            made = flipEdges(TriangleId(t), since) || made;
          }
        },
        kTrianglesPerUnit);
    if (!made) break;
  }
}

// ---- move ---------------------------------------------------------------------------------------

/// Skips nodes whose triangles have not changed since the last pass: they would not move.
Task<> RemeshSchedule::smoothAll(Work& work) {
  const std::uint32_t since = smoothed_;
  smoothed_ = editor_.nextTime();
  co_await work.forEachBlock(complex_.nodeCount(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (editor_.lastChange(NodeId(i)) >= since) editor_.smooth(NodeId(i));
    }
  });
}

// ---- the poorest triangles ----------------------------------------------------------------------

/// Improves the triangles with an angle below the limit, the poorest first.
Task<> RemeshSchedule::improvePoor(Work& work, double squaredSine) {
  poor_.clear();
  isImproved_ = false;
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
    if (!complex_.isAlive(t) || isSettled(t)) continue;
    const double square = editor_.squaredSineOf(complex_.nodesOf(t));
    if (square < squaredSine) poor_.push_back({t, 0, square});
  }
  stableSort(poor_, [](const PoorTriangle& x, const PoorTriangle& y) {
    return x.squaredSine < y.squaredSine;
  });
  co_await work.yield();
  co_await work.forEachBlock(poor_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      isImproved_ = improveTriangle(poor_[i].triangle, squaredSine) || isImproved_;
    }
  });
}

bool RemeshSchedule::improveTriangle(TriangleId triangle, double squaredSine) {
  if (!complex_.isAlive(triangle)) return false;
  const NodeTriple nodes = complex_.nodesOf(triangle);
  if (editor_.squaredSineOf(nodes) >= squaredSine) return false;
  // Edges from corner k to k + 1, longest first.
  std::array<std::size_t, 3> order{0, 1, 2};
  const auto lengthOf = [&](std::size_t k) {
    return editor_.lengthOf(nodes[k], nodes[(k + 1) % 3]);
  };
  sortFew(order, [&](std::size_t x, std::size_t y) { return lengthOf(x) > lengthOf(y); });
  for (const std::size_t k : order) {
    if (editor_.flip(nodes[k], nodes[(k + 1) % 3])) return true;
  }
  if (editor_.absorb(nodes[order[0]], nodes[(order[0] + 1) % 3])) return true;
  const CollapseRule rule{1.7, 1.0, true};
  for (std::size_t i = 3; i-- > 0;) {
    const NodeId a = nodes[order[i]];
    const NodeId b = nodes[(order[i] + 1) % 3];
    if (editor_.lengthOf(a, b) > 1.1) continue;
    if (editor_.collapse(a, b, rule) || editor_.collapse(b, a, rule)) return true;
  }
  bool moved = false;
  for (const NodeId node : nodes) moved = editor_.improve(node) || moved;
  if (moved) return true;
  const std::size_t k = order[0];
  return splitUnder({nodes[k], nodes[(k + 1) % 3], nodes[(k + 2) % 3]});
}

/// Splits the edge between the first two nodes, below the third one: for caps, and for needles
/// between feature lines.
bool RemeshSchedule::splitUnder(const NodeTriple& nodes) {
  const auto [a, b, c] = nodes;
  if (editor_.lengthOf(a, b) <= 1.0) return false;
  if (!editor_.split(a, b, std::clamp(footOf(a, b, c), 0.3, 0.7))) return false;
  const NodeId middle(complex_.nodeCount() - 1);
  if (collapseInto(middle)) return true;
  flipAround(middle);
  editor_.improve(middle);
  return true;
}

}  // namespace tetrafront
