#include "lattice/size_survey.h"

#include <algorithm>
#include <cmath>

#include "lattice/rules.h"

namespace tetrafront {
namespace {

/// A cube before it is known whether to divide it.
struct OpenCube {
  std::array<std::uint32_t, 3> at;  ///< in cubes of its level
  std::uint32_t level;
  bool isFree;  ///< no triangle passes through it, so it lies inside
};

constexpr std::uint32_t kMaxLevel = 20;

}  // namespace

SizeClasses::SizeClasses(double largest) : upper_(largest * std::sqrt(kRatio)) {
  double edge = upper_;
  for (double& lower : lower_) lower = edge /= kRatio;
}

std::uint32_t SizeClasses::of(double size) const {
  if (!(size < upper_)) return kNone;
  // Those of large sizes are the most frequent.
  std::uint32_t found = 0;
  while (found < kMost && size < lower_[found]) ++found;
  return found;
}

Task<SizeSurvey> SizeSurvey::make(Work& work, const Bounds& bounds, const FreeSpace& space,
                                  const SizeField& field, std::uint32_t region) {
  FieldHint hint{.region = region};
  const Vec3 extent = bounds.high - bounds.low;
  const double whole = std::max({extent.x, extent.y, extent.z});
  struct Leaf {
    Vec3 low;
    Vec3 high;
    double middle;  ///< size in the middle
    double least;
    double most;
  };
  std::vector<Leaf> leaves;
  std::vector<OpenCube> open{{{0, 0, 0}, 0, false}};
  double largest = 0.0;
  while (!open.empty()) {
    co_await work.spend(1);
    const OpenCube cube = open.back();
    open.pop_back();
    const double side = whole / static_cast<double>(1U << cube.level);
    const auto cornerAt = [&](std::uint32_t dx, std::uint32_t dy, std::uint32_t dz) {
      return bounds.low + side * Vec3(cube.at[0] + dx, cube.at[1] + dy, cube.at[2] + dz);
    };
    const Vec3 middle = 0.5 * (cornerAt(0, 0, 0) + cornerAt(1, 1, 1));
    const double reach = 0.5 * std::sqrt(3.0) * side;
    bool isFree = cube.isFree;
    if (!isFree && space.distance(middle, 1.001 * reach) > reach) {
      if (!space.isInside(middle)) continue;
      isFree = true;
    }
    const double size = field.sizeAt(middle, hint);
    if (side > kCubePerSize * size && cube.level < kMaxLevel) {
      for (std::uint32_t i = 0; i < 8; ++i) {
        const std::array<std::uint32_t, 3> at{
            2 * cube.at[0] + (i & 1U), 2 * cube.at[1] + (i >> 1U & 1U), 2 * cube.at[2] + (i >> 2U)};
        open.push_back({at, cube.level + 1, isFree});
      }
      continue;
    }
    Leaf leaf{cornerAt(0, 0, 0), cornerAt(1, 1, 1), size, size, size};
    for (std::uint32_t i = 0; i < 8; ++i) {
      const double there = field.sizeAt(cornerAt(i & 1U, i >> 1U & 1U, i >> 2U), hint);
      leaf.least = std::min(leaf.least, there);
      leaf.most = std::max(leaf.most, there);
    }
    leaves.push_back(leaf);
    // Cubes at the boundary may be larger than the elements there, and end outside.
    if (isFree) largest = std::max(largest, leaf.most);
  }

  SizeSurvey survey;
  if (largest == 0.0) co_return survey;
  survey.classes_ = SizeClasses(largest);
  for (const Leaf& leaf : leaves) {
    const std::uint32_t ofLeast = survey.classes_.of(leaf.least);
    const std::uint32_t ofMost = survey.classes_.of(leaf.most);
    // Sizes above those of all classes, at the boundary: to look for nodes of the smallest class would take forever.
    if (ofLeast == SizeClasses::kNone && leaf.least > largest) continue;
    survey.cubes_.push_back({leaf.low, leaf.high, ofMost == SizeClasses::kNone ? 0 : ofMost,
                             std::min(ofLeast, SizeClasses::kMost - 1)});
    const std::uint32_t own = survey.classes_.of(leaf.middle);
    if (own == SizeClasses::kNone) continue;
    const double side = leaf.high.x - leaf.low.x;
    const double elements =
        side * side * side / (kVolumePerCube * leaf.middle * leaf.middle * leaf.middle);
    survey.held_[own].elements += elements;
    survey.held_[own].lengths += elements * leaf.middle;
  }
  co_return survey;
}

double SizeSurvey::meanSizeOf(std::uint32_t sizeClass) const {
  const Held& held = held_[sizeClass];
  return held.elements < kMinElements ? 0.0 : held.lengths / held.elements;
}

}  // namespace tetrafront
