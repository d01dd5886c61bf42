#include "adapt/element_number.h"

#include <algorithm>
#include <array>

#include "metric/mesh_metric.h"

namespace tetrafront {
namespace {

/// The prices, in units of an edge out of bounds, and the factor from one to the next. The least one hardly costs unit edges.
constexpr double kMinPrice = 0.2;
constexpr double kFirstPrice = 0.3;
constexpr double kMaxPrice = 1.0;
constexpr double kPriceStep = 1.5;

/// The price rises while fewer edges than this part are out of bounds: unit edges come first.
constexpr double kFewOutOfBounds = 0.008;

}  // namespace

Task<> ElementNumber::measure(Work& work) {
  double complexity = 0.0;
  co_await work.forEachId<TetId>(mesh_.elements.size(), [&](TetId id) {
    const AdaptElement& element = mesh_.element(id);
    if (!element.isAlive()) return;
    std::array<Vec3, 4> corners;
    std::array<double, 4> densities{};
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k] = mesh_.point(element.nodes[k]);
      densities[k] = mesh_.node(element.nodes[k]).density;
    }
    complexity += complexityWithin(corners, densities);
  });
  targetCount_ = kElementsPerComplexity * complexity;
}

void ElementNumber::setPrice(double outOfBounds) {
  if (!isExceeded()) {
    price_ = 0.0;
  } else {
    const double next = outOfBounds < kFewOutOfBounds ? std::max(kFirstPrice, kPriceStep * price_)
                                                      : price_ / kPriceStep;
    price_ = std::clamp(next, kMinPrice, kMaxPrice);
  }
  badness_.setPerElement(price_);
}

}  // namespace tetrafront
