#include "boundary/self_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/ids.h"
#include "base/budget.h"
#include "base/sort.h"
#include "geom/intersect.h"
#include "geom/measure.h"
#include "boundary/surface_access.h"

namespace tetrafront {
namespace {

/// A look at a pair of branches costs this part of what is done for a triangle.
constexpr std::size_t kPairsPerTriangle = 16;

NumberedTriangle triangleOf(const SurfaceMesh& mesh, std::uint32_t triangle) {
  const std::size_t i = 3 * std::size_t{triangle};
  return {{mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]},
          cornersOf(mesh, triangle)};
}

/// kNoIndex if there is none.
std::uint32_t lowestCommonNode(const NumberedTriangle& a, const NumberedTriangle& b) {
  std::uint32_t lowest = kNoIndex;
  for (const std::uint32_t node : a.nodes) {
    if (std::ranges::count(b.nodes, node) > 0) lowest = std::min(lowest, node);
  }
  return lowest;
}

/// Of the directions in which the triangle is seen from its node: an arc of the unit sphere.
Box boxOfDirections(const NumberedTriangle& triangle, std::uint32_t node) {
  /// Of unit vectors, whose length is the scale: thousands of times the rounding of a difference and a root.
  constexpr double kRounding = 1e-12;
  std::size_t k = 0;
  while (triangle.nodes[k] != node) ++k;
  const Vec3& from = triangle.corners[k];
  const Vec3 a = triangle.corners[(k + 1) % 3] - from;
  const Vec3 b = triangle.corners[(k + 2) % 3] - from;
  const Vec3 u = a * (1.0 / glm::length(a));
  const Vec3 v = b * (1.0 / glm::length(b));
  // Lengths beyond the reach of squares have no direction that could be trusted; not a number fails too.
  if (!(std::fabs(glm::dot(u, u) - 1.0) < kRounding &&
        std::fabs(glm::dot(v, v) - 1.0) < kRounding)) {
    return Box::of(Vec3(-2.0), Vec3(2.0), Vec3(2.0));
  }
  // No arc is farther from its chord than the square of the chord divided by four.
  const Vec3 reach(0.25 * glm::dot(v - u, v - u) + kRounding);
  Box box = Box::of(u, v, v);
  box.include(u, reach);
  box.include(v, reach);
  return box;
}

}  // namespace

std::vector<Box> triangleBoxes(const SurfaceMesh& mesh) {
  std::vector<Box> boxes;
  const std::size_t count = mesh.triangles.size() / 3;
  boxes.reserve(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::array<Vec3, 3> p = cornersOf(mesh, t);
    boxes.push_back(Box::of(p[0], p[1], p[2]));
  }
  return boxes;
}

SelfIntersectionCheck::SelfIntersectionCheck(const SurfaceMesh& mesh,
                                             std::span<const std::uint8_t> ignored,
                                             const BoxTree& tree, BoundaryReport& report)
    : mesh_(mesh),
      ignored_(ignored),
      report_(report),
      atNode_(mesh.points.size() / 3),
      pairs_(mesh, tree) {}

bool SelfIntersectionCheck::advance(std::uint32_t budget) {
  switch (stage_) {
    case Stage::kCount:
      if (!listTriangles(budget)) break;
      atNode_.endCounting();
      next_ = 0;
      stage_ = Stage::kList;
      break;
    case Stage::kList:
      if (!listTriangles(budget)) break;
      next_ = 0;
      stage_ = Stage::kNodes;
      break;
    case Stage::kNodes:
      if (testNodes(budget)) stage_ = Stage::kPairs;
      break;
    case Stage::kPairs: {
      const bool isFinished = pairs_.advance(
          scaledBudget(budget, kPairsPerTriangle), [this](std::uint32_t a, std::uint32_t b) {
            if (ignored_[a] == 0 && ignored_[b] == 0 && !hasFoundEnough()) testPair(a, b);
          });
      if (!isFinished && !hasFoundEnough()) break;
      next_ = 0;
      stage_ = Stage::kReport;
      break;
    }
    case Stage::kReport:
      return report(budget);
  }
  return false;
}

bool SelfIntersectionCheck::listTriangles(std::uint32_t budget) {
  const auto corners = static_cast<std::uint32_t>(mesh_.triangles.size());
  const std::uint32_t end = next_ + std::min(corners - next_, budget);
  for (; next_ < end; ++next_) {
    if (ignored_[next_ / 3] != 0) continue;
    if (stage_ == Stage::kCount) {
      atNode_.count(mesh_.triangles[next_]);
    } else {
      atNode_.add(mesh_.triangles[next_], next_ / 3);
    }
  }
  return next_ == corners;
}

bool SelfIntersectionCheck::testNodes(std::uint32_t budget) {
  const auto nodes = static_cast<std::uint32_t>(mesh_.points.size() / 3);
  while (budget > 0 && next_ < nodes && !hasFoundEnough()) {
    const bool isFew = atNode_.at(next_).size() <= kFew;
    const std::uint32_t done = isFew ? testFew() : testMany(budget);
    budget -= std::min(done, budget);
    if (!directions_) ++next_;
  }
  return next_ == nodes || hasFoundEnough();
}

std::uint32_t SelfIntersectionCheck::testFew() {
  const std::span<const std::uint32_t> all = atNode_.at(next_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) testOnce(all[i], all[j]);
  }
  return 1 + static_cast<std::uint32_t>(all.size());
}

/// Leaves directions_ for the next slice if the budget does not do.
std::uint32_t SelfIntersectionCheck::testMany(std::uint32_t budget) {
  const std::span<const std::uint32_t> all = atNode_.at(next_);
  if (!directions_) {
    std::vector<Box> boxes;
    boxes.reserve(all.size());
    for (const std::uint32_t t : all) {
      boxes.push_back(boxOfDirections(triangleOf(mesh_, t), next_));
    }
    directions_.emplace(std::move(boxes));
  }
  const std::uint32_t first = directions_->next;
  const auto count = static_cast<std::uint32_t>(all.size());
  const std::uint32_t end = first + std::min(count - first, budget);
  for (std::uint32_t i = first; i < end && !hasFoundEnough(); ++i) {
    directions_->tree.visitOverlaps(directions_->boxes[i], [&](std::uint32_t j) {
      if (j > i) testOnce(all[i], all[j]);
    });
  }
  directions_->next = end;
  if (end == count) directions_.reset();
  return end - first;
}

/// Triangles with several common nodes are met at each of them.
void SelfIntersectionCheck::testOnce(std::uint32_t a, std::uint32_t b) {
  if (lowestCommonNode(triangleOf(mesh_, a), triangleOf(mesh_, b)) == next_) testPair(a, b);
}

void SelfIntersectionCheck::testPair(std::uint32_t a, std::uint32_t b) {
  if (meetImproperly(triangleOf(mesh_, a), triangleOf(mesh_, b))) {
    found_.emplace_back(std::min(a, b), std::max(a, b));
  }
}

bool SelfIntersectionCheck::report(std::uint32_t budget) {
  if (next_ == 0) {
    stableSort(found_);
    if (hasFoundEnough()) report_.setIncomplete(DiagnosticCode::kSelfIntersection);
  }
  const auto count = static_cast<std::uint32_t>(found_.size());
  const std::uint32_t end = next_ + std::min(count - next_, budget);
  for (; next_ < end; ++next_) {
    const auto& [a, b] = found_[next_];
    const Vec3 place = report_.keepsNext(DiagnosticCode::kSelfIntersection)
                           ? meetingPlace(cornersOf(mesh_, a), cornersOf(mesh_, b))
                           : Vec3(0.0);
    report_.addTrianglePair(DiagnosticCode::kSelfIntersection, a, b, place);
  }
  return next_ == count;
}

double SelfIntersectionCheck::fraction() const {
  // Lists, nodes and pairs take about a quarter, a quarter and a half of the time.
  const auto shareOf = [this](std::size_t all) {
    return static_cast<double>(next_) / static_cast<double>(std::max(all, std::size_t{1}));
  };
  switch (stage_) {
    case Stage::kCount:
      return 0.1 * shareOf(mesh_.triangles.size());
    case Stage::kList:
      return 0.1 + 0.15 * shareOf(mesh_.triangles.size());
    case Stage::kNodes:
      return 0.25 + 0.25 * shareOf(mesh_.points.size() / 3);
    case Stage::kPairs:
      return 0.5 + 0.5 * pairs_.fraction();
    case Stage::kReport:
      return 1.0;
  }
  return 1.0;
}

}  // namespace tetrafront
