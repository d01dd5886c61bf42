#include "remesh/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "search/box_tree.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// In place of a smaller component of a ray's unit direction, so that its inverse is finite: far below the rounding of a component,
/// about 1e-16, and its inverse times any coordinate is far below the largest double.
constexpr double kMinComponent = 1e-30;
/// Distance / diagonal from the start of a ray within which the surface is that at the start itself: above the rounding of
/// coordinates in single precision, 6e-8 of the largest one, and far below any thickness that could be meshed.
constexpr double kRayStart = 1e-7;

/// A ray, prepared for tests with many boxes.
class BoxRay {
 public:
  BoxRay(const Vec3& from, const Vec3& direction, double first) : from_(from), first_(first) {
    // A direction along an axis must not give 0 x infinity.
    for (int k = 0; k < 3; ++k) {
      inverse_[k] = 1.0 / (std::fabs(direction[k]) < kMinComponent ? kMinComponent : direction[k]);
    }
  }
  /// Returns the distance at which the ray is first in the box, if it is below `last`; otherwise infinity.
  [[nodiscard]] double entryInto(const Box& box, double last) const {
    double first = first_;
    for (int k = 0; k < 3; ++k) {
      const double low = (static_cast<double>(box.low[k]) - from_[k]) * inverse_[k];
      const double high = (static_cast<double>(box.high[k]) - from_[k]) * inverse_[k];
      first = std::max(first, inverse_[k] > 0.0 ? low : high);
      last = std::min(last, inverse_[k] > 0.0 ? high : low);
    }
    return first <= last ? first : std::numeric_limits<double>::infinity();
  }

 private:
  Vec3 from_;
  Vec3 inverse_{0.0};
  double first_;
};

/// Lowers `nearest` to the distance at which the ray leaves the region through the triangle.
void castRay(const ReferenceSurface& reference, const Vec3& from, const Vec3& direction,
             TriangleId triangle, Thickness& nearest) {
  if (glm::dot(reference.normalOf(triangle), direction) < kMinFacing) return;
  const auto [a, b, c] = cornersOf(reference.mesh(), triangle);
  const Vec3 side = glm::cross(direction, c - a);
  const double determinant = glm::dot(b - a, side);
  if (!(std::fabs(determinant) > 0.0)) return;
  const double u = glm::dot(from - a, side) / determinant;
  const Vec3 other = glm::cross(from - a, b - a);
  const double v = glm::dot(direction, other) / determinant;
  const double distance = glm::dot(c - a, other) / determinant;
  if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > kRayStart * reference.diagonal()) {
    if (distance < nearest.distance) nearest = {distance, triangle};
  }
}

}  // namespace

Thickness findThickness(const ReferenceSurface& reference, const Vec3& position, const Vec3& inward,
                        double limit) {
  struct Waiting {
    BranchId branch;
    double entry;
  };
  const BoxTree& tree = reference.tree();
  const BoxRay ray(position, inward, kRayStart * reference.diagonal());
  Thickness nearest{limit, {}};
  std::array<Waiting, 64> waiting;
  std::size_t count = 0;
  const auto wait = [&](BranchId branch) {
    const double entry = ray.entryInto(tree.boxOf(branch), nearest.distance);
    if (entry < nearest.distance) waiting[count++] = {branch, entry};
  };
  wait(BranchId(0U));
  while (count > 0) {
    const auto [branch, entry] = waiting[--count];
    if (entry >= nearest.distance) continue;
    if (!tree.isLeaf(branch)) {
      // The nearer branch is the next one.
      const std::size_t before = count;
      wait(BoxTree::leftOf(branch));
      wait(BoxTree::rightOf(branch));
      if (count == before + 2 && waiting[before].entry < waiting[before + 1].entry)
        std::swap(waiting[before], waiting[before + 1]);
      continue;
    }
    const std::span<const Box> boxes = tree.itemBoxesOf(branch);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!(ray.entryInto(boxes[i], nearest.distance) < nearest.distance)) continue;
      const std::uint32_t item = tree.itemsOf(branch)[i];
      castRay(reference, position, inward, reference.pieces()[item].triangle, nearest);
    }
  }
  if (nearest.across.isNone()) nearest.distance = std::numeric_limits<double>::infinity();
  return nearest;
}

}  // namespace tetrafront
