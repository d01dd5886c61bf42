#include "solution/front_sizes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/tool_job.h"
#include "geom/cube_root.h"
#include "metric/mesh_metric.h"
#include "metric/metric.h"
#include "tetrafront/options.h"

namespace tetrafront {
namespace {

/// Elements of a mesh by the front / complexity of its sizes (sizing/expected_count.h).
constexpr double kElementsOfFront = 8.485281374238571;

/// Second stretchings up to this at all nodes are rounding: one stretching describes such metrics.
constexpr double kNegligibleStretching = 1.001;

constexpr std::size_t kMetricsPerUnit = 8;

double sizePerLength() { return cubeRoot(kElementsOfFront / kElementsPerComplexity); }

/// Collects the sizes of metrics node by node.
class FrontSizesBuilder {
 public:
  void add(const SymmetricTensor& metric) {
    const StretchedSize found = stretchedSizeOf(metric);
    made_.sizes.push_back(found.size);
    made_.stretchings.push_back(found.stretching);
    made_.secondStretchings.push_back(found.secondStretching);
    for (int k = 0; k < 3; ++k) made_.directions.push_back(found.direction[k]);
    for (int k = 0; k < 3; ++k) made_.secondDirections.push_back(found.secondDirection[k]);
    hasSecond_ = hasSecond_ || found.secondStretching > kNegligibleStretching;
  }

  [[nodiscard]] FrontSizes take() {
    if (!hasSecond_) dropSecond();
    const double perLength = sizePerLength();
    for (double& size : made_.sizes) size *= perLength;
    for (auto* stretchings : {&made_.stretchings, &made_.secondStretchings})
      for (double& stretching : *stretchings)
        stretching = std::clamp(stretching, 1.0, kMaxStretching);
    return std::move(made_);
  }

 private:
  /// The mean of the two sizes across, which differ by rounding, becomes the size.
  void dropSecond() {
    for (std::size_t i = 0; i < made_.sizes.size(); ++i) {
      const double across = made_.sizes[i] * std::sqrt(made_.secondStretchings[i]);
      made_.stretchings[i] = made_.sizes[i] * made_.stretchings[i] / across;
      made_.sizes[i] = across;
    }
    made_.secondStretchings = {};
    made_.secondDirections = {};
  }

  FrontSizes made_;
  bool hasSecond_ = false;
};

Task<FrontSizes> checkAndConvert(Work& work, const std::vector<double>& metrics) {
  FrontSizesBuilder builder;
  std::uint32_t invalidNode = FrontSizes::kNoNode;
  co_await work.forEachBlock(
      metrics.size() / kTensorNumbers,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && invalidNode == FrontSizes::kNoNode; ++i) {
          const SymmetricTensor metric = tensorAt(metrics, i);
          if (isMetric(metric))
            builder.add(metric);
          else
            invalidNode = static_cast<std::uint32_t>(i);
        }
      },
      kMetricsPerUnit);
  FrontSizes made;
  if (invalidNode == FrontSizes::kNoNode) made = builder.take();
  made.invalidNode = invalidNode;
  co_return made;
}

}  // namespace

FrontSizes frontSizesOf(std::span<const double> metrics) {
  FrontSizesBuilder builder;
  for (std::size_t i = 0; i < metrics.size() / kTensorNumbers; ++i)
    builder.add(tensorAt(metrics, i));
  return builder.take();
}

FrontSizer::FrontSizer(std::vector<double> metrics)
    : SlicedTool(makeToolJob<FrontSizes>(std::move(metrics),
                                         [](Work& work, const std::vector<double>& input) {
                                           return checkAndConvert(work, input);
                                         })) {}

}  // namespace tetrafront
