#include "sizing/volume_sizes.h"

#include <numbers>

#include "geom/cube_root.h"

namespace tetrafront {
namespace {

/// Size / edge of the regular tetrahedron of the largest volume. The largest tetrahedra of a mesh have about twice the
/// volume of the regular one of the target size.
constexpr double kMargin = 0.8;

}  // namespace

double sizeForVolume(double volume) {
  return volume > 0.0 ? kMargin * cubeRoot(6.0 * std::numbers::sqrt2 * volume) : 0.0;
}

std::vector<double> sizesForVolumes(std::span<const double> volumes) {
  std::vector<double> sizes;
  sizes.reserve(volumes.size());
  for (const double volume : volumes) sizes.push_back(sizeForVolume(volume));
  return sizes;
}

}  // namespace tetrafront
