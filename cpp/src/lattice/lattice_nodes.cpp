#include "lattice/lattice_nodes.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace tetrafront {
namespace {

/// Visits of nodes by the sort per unit of budget.
constexpr std::size_t kVisitsPerUnit = 64;

}  // namespace

Lattice::Lattice(double constant, const Vec3& low)
    : half_(0.5 * constant), base_(2.0 * glm::floor(low / constant)) {}

std::uint32_t Lattice::firstFrom(double coordinate, int axis) const {
  const double steps = std::ceil(coordinate / half_) - base_[axis];
  return static_cast<std::uint32_t>(std::clamp(steps, 0.0, double{kMaxSteps}));
}

bool Lattice::reaches(const Vec3& high) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] / half_ - base_[axis] >= double{kMaxSteps}) return false;
  }
  return true;
}

Task<> LatticeNodes::sort(Work& work) {
  SlicedSort<Key> sort(keys_);
  co_await work.finish(sort, kVisitsPerUnit);
}

LatticePlace LatticeNodes::placeOf(NodeId node) const {
  constexpr Key kMask = (Key{1} << kBits) - 1;
  const Key key = keys_[node.index()];
  return {static_cast<std::uint32_t>(key & kMask), static_cast<std::uint32_t>(key >> kBits & kMask),
          static_cast<std::uint32_t>(key >> 2 * kBits)};
}

std::size_t LatticeNodes::firstFrom(const LatticePlace& place) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(keys_, keyOf(place)) - keys_.begin());
}

NodeId LatticeNodes::find(const LatticePlace& place) const {
  if (std::max({place.x, place.y, place.z}) >= Lattice::kMaxSteps) return {};
  const std::size_t index = firstFrom(place);
  return index < keys_.size() && keys_[index] == keyOf(place) ? NodeId(index) : NodeId();
}

LatticeNodes::Row LatticeNodes::rowAt(std::uint32_t y, std::uint32_t z) const {
  return rowAt(y, z, firstFrom({0, y, z}));
}

LatticeNodes::Row LatticeNodes::rowAt(std::uint32_t y, std::uint32_t z, std::size_t index) const {
  return {keys_, keyOf({0, y, z}), index};
}

}  // namespace tetrafront
