#include "sizing/memory_limit.h"

#include <algorithm>

namespace tetrafront {

double elementsWithin(double bytes, std::size_t triangles, bool hasLattices) {
  const double byFront = bytes / kBytesPerFrontElement;
  if (!hasLattices) return byFront;
  const double left = bytes - kBytesPerTriangle * static_cast<double>(triangles);
  return std::max(byFront, left / kBytesPerLatticeElement);
}

std::uint32_t frontElementsBeside(double bytes, std::size_t others) {
  const double left = bytes - kBytesPerLatticeElement * static_cast<double>(others);
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp(left / kBytesPerFrontElement, 0.0, kMost));
}

}  // namespace tetrafront
