#include "sizing/memory_limit.h"

#include <algorithm>

namespace tetrafront {

double elementsWithin(double bytes, double triangles, bool hasLattices) {
  const double byFront = bytes / kBytesPerFrontElement;
  if (!hasLattices) return byFront;
  const double left = bytes - kBytesPerTriangle * triangles;
  return std::max(byFront, left / kBytesPerLatticeElement);
}

std::uint32_t frontElementsBeside(double bytes, std::size_t others) {
  const double left = bytes - kBytesPerLatticeElement * static_cast<double>(others);
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp(left / kBytesPerFrontElement, 0.0, kMost));
}

}  // namespace tetrafront
