#include "remesh/thickness.h"

#include <cstdint>
#include <limits>
#include <optional>

#include "geom/ray.h"
#include "search/box_tree.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Distance / diagonal from the start of a ray within which the surface is that at the start itself: above the rounding of
/// coordinates in single precision, 6e-8 of the largest one, and far below any thickness that could be meshed.
constexpr double kRayStart = 1e-7;

}  // namespace

Thickness findThickness(const ReferenceSurface& reference, const Vec3& position, const Vec3& inward,
                        double limit) {
  const Ray ray(position, inward, kRayStart * reference.diagonal());
  Thickness nearest{limit, {}};
  reference.tree().visitAlong(ray, nearest.distance, [&](std::uint32_t item) {
    const TriangleId triangle = reference.pieces()[item].triangle;
    if (glm::dot(reference.normalOf(triangle), inward) < kMinFacing) return;
    const std::optional<double> distance = ray.distanceTo(cornersOf(reference.mesh(), triangle));
    if (distance && *distance < nearest.distance) nearest = {*distance, triangle};
  });
  if (nearest.across.isNone()) nearest.distance = std::numeric_limits<double>::infinity();
  return nearest;
}

}  // namespace tetrafront
