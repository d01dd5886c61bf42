#include "lattice/free_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boundary/ray_crossing.h"
#include "geom/box.h"
#include "geom/measure.h"

namespace tetrafront {
namespace {

/// Boxes visited per unit of budget.
constexpr std::size_t kBoxesPerUnit = 32;

}  // namespace

Task<> FreeSpace::add(Work& work, std::vector<Triangle> triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& t : triangles) boxes.push_back(Box::of(t[0], t[1], t[2]));
  BoxTree tree = co_await BoxTree::build(work, std::move(boxes), kBoxesPerUnit);
  parts_.push_back({std::move(triangles), std::move(tree)});
}

double FreeSpace::distance(const Vec3& position, double limit) const {
  double squared = limit * limit;
  for (const Part& part : parts_) {
    part.tree.visitNear(position, squared, [&](std::uint32_t i) {
      const auto& [a, b, c] = part.triangles[i];
      squared = std::min(squared, squaredDistanceToTriangle(position, a, b, c));
    });
  }
  return std::sqrt(squared);
}

bool FreeSpace::isInside(const Vec3& position) const {
  bool isInside = false;
  for (const Part& part : parts_) {
    part.tree.visitOverlaps(boxOfRay(position), [&](std::uint32_t i) {
      if (isAheadOf(part.triangles[i], position)) isInside = !isInside;
    });
  }
  return isInside;
}

}  // namespace tetrafront
