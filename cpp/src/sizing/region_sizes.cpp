#include "sizing/region_sizes.h"

#include <algorithm>
#include <limits>

#include "sizing/volume_sizes.h"

namespace tetrafront {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

}  // namespace

RegionSizes::RegionSizes(const GivenRegions& regions)
    : sizes_(sizesForVolumes(regions.maxVolumes)) {
  const auto sizeOf = [this](std::uint32_t region) {
    return region < sizes_.size() && sizes_[region] > 0.0 ? sizes_[region] : kUnlimited;
  };
  bool isLimited = false;
  for (std::size_t side = 0; side + 1 < regions.triangleRegions.size(); side += 2) {
    const std::uint32_t back = regions.triangleRegions[side];
    const std::uint32_t front = regions.triangleRegions[side + 1];
    const std::uint32_t region = sizeOf(front) < sizeOf(back) ? front : back;
    isLimited = isLimited || sizeOf(region) < kUnlimited;
    regionOf_.push_back(sizeOf(region) < kUnlimited ? region : FieldHint::kAnyRegion);
  }
  if (!isLimited) regionOf_.clear();
}

double RegionSizes::smallest() const {
  double smallest = kUnlimited;
  for (const std::uint32_t region : regionOf_) {
    if (region != FieldHint::kAnyRegion) smallest = std::min(smallest, sizes_[region]);
  }
  return smallest;
}

void RegionSizes::cap(SizeField& field, double maxVolume) const {
  field.capSizes(sizeForVolume(maxVolume), sizes_);
}

}  // namespace tetrafront
