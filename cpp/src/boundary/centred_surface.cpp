#include "boundary/centred_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Largest coordinate / diagonal from which on a surface is far from the origin. Below, at most 8 of 53 bits are lost.
constexpr double kFar = 256.0;

/// Returns the centre along an axis; 0 if differences from it would round. They are exact if all coordinates and the centre
/// are within a factor of 2 of each other (Sterbenz 1974).
double centreAlong(double low, double high) {
  const double near = std::min(std::fabs(low), std::fabs(high));
  const double far = std::max(std::fabs(low), std::fabs(high));
  const bool isExact = (low > 0.0 || high < 0.0) && far <= 2.0 * near;
  return isExact ? low + 0.5 * (high - low) : 0.0;
}

}  // namespace

Vec3 moveToCentre(SurfaceMesh& mesh) {
  const Bounds bounds = boundsOf(mesh);
  const double diagonal = glm::length(bounds.high - bounds.low);
  Vec3 centre(0.0);
  for (int k = 0; k < 3; ++k) {
    const double largest = std::max(std::fabs(bounds.low[k]), std::fabs(bounds.high[k]));
    if (largest > kFar * diagonal) centre[k] = centreAlong(bounds.low[k], bounds.high[k]);
  }
  shift(mesh.points, -centre);
  return centre;
}

void shift(std::vector<double>& points, const Vec3& by) {
  if (by == Vec3(0.0)) return;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += by[static_cast<int>(i % 3)];
}

}  // namespace tetrafront
