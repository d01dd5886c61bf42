#include "surface/carrier_table.h"

#include <cmath>

#include "base/sort.h"
#include "base/tolerance.h"

namespace tetrafront {

namespace {

/// Two straight lines lie on the same carrier if the ends of one are within this distance of the other, relative to
/// its length: the nodes of both are then collinear up to the rounding of their coordinates.
constexpr double kSameCarrier = Tolerance::kCoincidence;
/// Half a turn, in the measure of directions used here: 0 to the right, 1 upwards.
constexpr double kHalfTurn = 2.0;
/// Two lines whose directions differ by more than this may be collinear only if one of them is so short that its
/// direction is arbitrary.
constexpr double kAnyDirection = 0.1;

}  // namespace

CarrierTable::CarrierTable(const PlaneBox& region)
    : middle_(0.5 * (region.low + region.high)),
      extent_(glm::length(region.high - region.low)),
      tree_({{0.0, -extent_}, {kHalfTurn, extent_}}) {}

CarrierId CarrierTable::findOrAdd(const Vec2& from, const Vec2& to) {
  const Vec2 dual = dualOf(from, to - from);
  gatherNear(dual, glm::length(to - from));
  for (const std::uint32_t i : near_)
    if (isOn(carriers_[i], from) && isOn(carriers_[i], to)) return CarrierId(i);
  const CarrierId added(carriers_.size());
  carriers_.push_back({from, to - from});
  tree_.insert(added.value, PlaneBox::of(dual, dual));
  return added;
}

/// Returns the direction of a line, from 0 to kHalfTurn, and its signed distance from the middle.
Vec2 CarrierTable::dualOf(const Vec2& from, Vec2 direction) const {
  if (direction.y < 0.0 || (direction.y == 0.0 && direction.x < 0.0)) direction = -direction;
  const double fraction = direction.y / (std::fabs(direction.x) + direction.y);
  const Vec2 normal = Vec2(-direction.y, direction.x) / glm::length(direction);
  return {direction.x >= 0.0 ? fraction : kHalfTurn - fraction, glm::dot(from - middle_, normal)};
}

/// Finds the carriers that may be collinear with a line, ascending.
void CarrierTable::gatherNear(const Vec2& dual, double length) {
  // A carrier is at most as long as the region, so its ends may be off by kSameCarrier times the extent.
  const double angle = 4.0 * kSameCarrier * extent_ / length + Tolerance::kRounding;
  const Vec2 margin(angle, extent_ * (2.0 * angle + 2.0 * kSameCarrier));
  near_.clear();
  if (angle > kAnyDirection) {
    tree_.query({{0.0, -extent_}, {kHalfTurn, extent_}}, near_);
  } else {
    tree_.query({dual - margin, dual + margin}, near_);
    // Directions just below half a turn and just above zero are close: query the opposite direction too.
    for (const double turn : {-kHalfTurn, kHalfTurn}) {
      const Vec2 opposite(dual.x + turn, -dual.y);
      tree_.query({opposite - margin, opposite + margin}, near_);
    }
  }
  stableSort(near_);
}

bool CarrierTable::isOn(const Carrier& carrier, const Vec2& position) {
  const Vec2 offset = position - carrier.from;
  const double area = carrier.direction.x * offset.y - carrier.direction.y * offset.x;
  return std::fabs(area) <= kSameCarrier * glm::dot(carrier.direction, carrier.direction);
}

}  // namespace tetrafront
