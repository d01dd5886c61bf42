#include "solution/reduced_metric.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/tool_job.h"
#include "geom/cube_root.h"
#include "metric/metric.h"
#include "solution/error_metric.h"
#include "tetrafront/options.h"

namespace tetrafront {
namespace {

/// Elements of a mesh by the front / complexity of its sizes (sizing/expected_count.h).
constexpr double kElementsOfFront = 8.485281374238571;

constexpr std::size_t kReducedPerUnit = 8;

void addReduced(const SymmetricTensor& metric, double perLength, ReducedMetric& reduced) {
  const StretchedSize full = stretchedSizeOf(metric);
  const double across = full.size * std::sqrt(full.secondStretching);
  const double stretching = full.size * full.stretching / across;
  reduced.sizes.push_back(perLength * across);
  reduced.stretchings.push_back(std::clamp(stretching, 1.0, kMaxStretching));
  for (int k = 0; k < 3; ++k) reduced.directions.push_back(full.direction[k]);
}

double sizePerLength() { return cubeRoot(kElementsOfFront / kElementsPerComplexity); }

Task<ReducedMetric> checkAndReduce(Work& work, const std::vector<double>& metrics) {
  ReducedMetric reduced;
  const double perLength = sizePerLength();
  co_await work.forEachBlock(
      metrics.size() / kTensorNumbers,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && reduced.invalidNode == ReducedMetric::kNoNode;
             ++i) {
          const SymmetricTensor metric = tensorAt(metrics, i);
          if (isMetric(metric))
            addReduced(metric, perLength, reduced);
          else
            reduced.invalidNode = static_cast<std::uint32_t>(i);
        }
      },
      kReducedPerUnit);
  if (reduced.invalidNode != ReducedMetric::kNoNode)
    reduced = {
        .sizes = {}, .stretchings = {}, .directions = {}, .invalidNode = reduced.invalidNode};
  co_return reduced;
}

}  // namespace

ReducedMetric reducedMetric(std::span<const double> metrics) {
  ReducedMetric reduced;
  const double perLength = sizePerLength();
  for (std::size_t i = 0; i < metrics.size() / kTensorNumbers; ++i)
    addReduced(tensorAt(metrics, i), perLength, reduced);
  return reduced;
}

MetricReducer::MetricReducer(std::vector<double> metrics)
    : SlicedTool(makeToolJob<ReducedMetric>(std::move(metrics),
                                            [](Work& work, const std::vector<double>& input) {
                                              return checkAndReduce(work, input);
                                            })) {}

}  // namespace tetrafront
