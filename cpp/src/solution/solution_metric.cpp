// The steps from fields to a bounded metric with the number of elements or the error that was asked for.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/tool_job.h"
#include "geom/cube_root.h"
#include "geom/exponential.h"
#include "metric/mesh_metric.h"
#include "metric/metric.h"
#include "solution/error_metric.h"
#include "solution/indicator_density.h"
#include "solution/power.h"
#include "solution/recovered_hessian.h"
#include "solution/front_sizes.h"
#include "tetrafront/solution.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Largest factor between the wanted number of elements and the given one: far more than there can be, but no overflow.
constexpr double kLargestFactor = 1e30;

/// Variation over an element / largest magnitude of a field, up to which its second derivatives are rounding.
constexpr double kRounding = 1e-11;

/// Relative difference of the number of elements at which scaling ends, and the number of its steps.
constexpr double kCountTolerance = 2e-3;
constexpr int kScalingSteps = 30;

constexpr std::size_t kNodesPerUnit = 8;

struct SizingInput {
  VolumeMesh mesh;
  SolutionFields fields;
  SolutionMetricOptions options;
};

double diagonalOf(const VolumeMesh& mesh) {
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high(-std::numeric_limits<double>::infinity());
  for (std::uint32_t i = 0; i < countNodes(mesh); ++i) {
    low = glm::min(low, pointOf(mesh, NodeId(i)));
    high = glm::max(high, pointOf(mesh, NodeId(i)));
  }
  return countNodes(mesh) == 0 ? 0.0 : glm::length(high - low);
}

/// Returns per node the largest second derivative that follows from rounding of a field of this magnitude.
std::vector<double> noiseOf(const VolumeMesh& mesh, const MeshEdges& edges, double magnitude) {
  std::vector<double> shortest(countNodes(mesh), std::numeric_limits<double>::infinity());
  for (const auto& [a, b] : edges) {
    const Vec3 edge = pointOf(mesh, NodeId(b)) - pointOf(mesh, NodeId(a));
    const double square = glm::dot(edge, edge);
    shortest[a] = std::min(shortest[a], square);
    shortest[b] = std::min(shortest[b], square);
  }
  for (double& value : shortest) value = kRounding * magnitude / value;
  return shortest;
}

/// Finds where a rising function is 0, by regula falsi that halves the value at an end that stays (Illinois).
class RootSearch {
 public:
  [[nodiscard]] double argument() const { return argument_; }

  /// Takes the value at argument(), and moves to the next argument; returns false if there is none.
  bool advance(double value) {
    End& moved = value < 0.0 ? low_ : high_;
    End& other = value < 0.0 ? high_ : low_;
    if (moved.hasMoved) other.value *= 0.5;
    moved = {argument_, value, true, true};
    other.hasMoved = false;
    const bool isEnclosed = low_.isKnown && high_.isKnown;
    if (!isEnclosed) step_ *= 2.0;
    const double secant =
        (low_.argument * high_.value - high_.argument * low_.value) / (high_.value - low_.value);
    const double next = isEnclosed ? secant : argument_ - step_ * value;
    if (next == argument_ || std::fabs(next) > kFarthest) return false;
    argument_ = next;
    return true;
  }

 private:
  static constexpr double kFarthest = 100.0;
  struct End {
    double argument = 0.0;
    double value = 0.0;
    bool isKnown = false;
    bool hasMoved = false;  ///< by the last step
  };

  End low_;
  End high_;
  double argument_ = 0.0;
  /// The logarithm of the complexity grows by at most 1.5 times that of the factor of the metric; the first step is as
  /// long as without limits, further ones are longer.
  double step_ = 1.0 / 3.0;
};

/// One metric per node from those of the fields, in the limits.
class MetricScaling {
 public:
  MetricScaling(const VolumeMesh& mesh, const MeshEdges& edges,
                const SolutionMetricOptions& options)
      : mesh_(mesh),
        edges_(edges),
        options_(options),
        bounds_{.minSize = options.minSize,
                .maxSize = options.maxSize > 0.0 ? options.maxSize : diagonalOf(mesh),
                .maxAspect = options.maxAspect} {}

  /// Intersects with the metric of a field, times a factor.
  void add(const FieldMetric& field, double factor) {
    const bool isFirst = unlimited_.empty();
    if (isFirst) unlimited_.resize(field.metrics.size());
    for (std::size_t i = 0; i < countNodes(mesh_); ++i) {
      const SymmetricTensor added = tensorAt(field.metrics, i).scaledBy(factor);
      putTensor(unlimited_, i, isFirst ? added : intersectionOf(tensorAt(unlimited_, i), added));
    }
  }

  /// Gives all metrics densities, one per node, times `factor`, and keeps their axes and ratios.
  void setDensities(std::vector<double> densities, double factor) {
    densities_ = std::move(densities);
    for (double& density : densities_) density *= factor;
  }

  /// Computes the limited metric, with all metrics times `factor`.
  Task<> limit(Work& work, double factor) {
    limited_ = unlimited_;
    const double denser = factor * std::sqrt(factor);
    co_await work.forEachId<NodeId>(
        countNodes(mesh_),
        [&](NodeId node) {
          const std::size_t i = node.index();
          const SymmetricTensor own = tensorAt(unlimited_, i);
          const SymmetricTensor metric = densities_.empty()
                                             ? own.scaledBy(factor)
                                             : withDensity(own, densities_[i] * denser, bounds_);
          putTensor(limited_, i, bounded(metric, bounds_));
        },
        kNodesPerUnit);
    if (options_.growth > 0.0) {
      co_await limitGrowth(work, mesh_, edges_, options_.growth, limited_);
    }
  }

  /// Scales until the limited metric asks for the number of elements, or the limits decide.
  Task<> scaleTo(Work& work, double elements) {
    RootSearch search;
    for (int step = 0; step < kScalingSteps; ++step) {
      co_await limit(work, exponential(search.argument()));
      work.setFraction(0.1 * std::min(step, 9));
      const double difference = logarithm(this->elements() / elements);
      if (std::fabs(difference) < kCountTolerance || !search.advance(difference)) break;
    }
  }

  [[nodiscard]] double elements() const {
    return kElementsPerComplexity * complexityOf(mesh_, limited_);
  }
  [[nodiscard]] std::vector<double>& limited() { return limited_; }
  [[nodiscard]] bool isEmpty() const { return unlimited_.empty(); }
  void setUniform() {
    unlimited_.assign(kTensorNumbers * countNodes(mesh_), 0.0);
    const SymmetricTensor unit = SymmetricTensor::isotropic(1.0);
    for (std::size_t i = 0; i < countNodes(mesh_); ++i) putTensor(unlimited_, i, unit);
  }

 private:
  const VolumeMesh& mesh_;
  const MeshEdges& edges_;
  const SolutionMetricOptions& options_;
  MetricBounds bounds_;
  std::vector<double> unlimited_;
  std::vector<double> densities_;  ///< per node; empty if those of the metrics count
  std::vector<double> limited_;
};

double magnitudeOf(std::span<const double> values) {
  double magnitude = 0.0;
  for (const double value : values) magnitude = std::max(magnitude, std::fabs(value));
  return magnitude;
}

/// Returns the values of each field.
std::vector<SampledValues> samplesOf(const SizingInput& input) {
  const auto& [mesh, fields, options] = input;
  std::vector<SampledValues> all;
  std::size_t first = 0;
  for (std::size_t f = 0; f < fields.components.size(); ++f) {
    const bool isPerElement = fields.isPerElement[f] != 0;
    const std::size_t samples = isPerElement ? countTetrahedra(mesh) : countNodes(mesh);
    const std::size_t numbers = samples * fields.components[f];
    const auto values = std::span(fields.values).subspan(first, numbers);
    all.push_back({values, fields.components[f], isPerElement});
    first += numbers;
  }
  return all;
}

/// Returns the metric of each field, for itself; that of the indicator has no variation.
Task<std::vector<FieldMetric>> metricsOfFields(Work& work, const SizingInput& input,
                                               const MeshEdges& edges) {
  const VolumeMesh& mesh = input.mesh;
  const std::vector<SampledValues> samples = samplesOf(input);
  std::vector<FieldMetric> all;
  for (std::size_t f = 0; f < samples.size(); ++f) {
    work.beginShare(1.0, static_cast<double>(samples.size() - f));
    if (f == input.options.indicator) {
      all.emplace_back();
      continue;
    }
    const std::vector<double> hessians = co_await recoverHessians(work, mesh, edges, samples[f]);
    const std::vector<double> noise = noiseOf(mesh, edges, magnitudeOf(samples[f].values));
    all.push_back(fieldMetric(mesh, hessians, noise, input.options));
  }
  co_return all;
}

bool hasIndicator(const SizingInput& input) {
  return input.options.indicator < input.fields.components.size();
}

IndicatorDensity densityIn(const SizingInput& input) {
  if (!hasIndicator(input)) return {};
  const auto& [mesh, fields, options] = input;
  return indicatorDensity(mesh, samplesOf(input)[options.indicator], options.indicatorOrder);
}

/// Returns the factor of the metric of a field with which it alone, without limits, has the error or the number. With an
/// indicator, fields only need to have one number.
double factorFor(const FieldMetric& field, const SizingInput& input) {
  const SolutionMetricOptions& options = input.options;
  double elements = options.elements;
  if (hasIndicator(input)) elements = static_cast<double>(countTetrahedra(input.mesh));
  if (!(elements > 0.0)) return scaleForError(field, options.norm, options.error);
  const double root = cubeRoot(elements / kElementsPerComplexity / field.complexity);
  return root * root;
}

/// Combines the metrics of the fields and the densities of the indicator; returns whether sizes follow from them.
bool combine(const SizingInput& input, std::span<const FieldMetric> fields,
             const IndicatorDensity& indicator, MetricScaling& scaling) {
  const SolutionMetricOptions& options = input.options;
  for (const FieldMetric& field : fields)
    if (field.hasVariation) scaling.add(field, factorFor(field, input));
  const bool isIndicated = indicator.largest > 0.0;
  const bool isVaried = hasIndicator(input) ? isIndicated : !scaling.isEmpty();
  if (!isVaried || scaling.isEmpty()) scaling.setUniform();
  if (isIndicated) {
    const double factor =
        options.elements > 0.0
            ? options.elements / indicator.elements
            : std::min(powerOf(indicator.largest / options.error, 3.0 / options.indicatorOrder),
                       kLargestFactor);
    scaling.setDensities(indicator.densities, factor);
  }
  return isVaried;
}

/// Completes a result that has its metrics.
void describe(const SizingInput& input, std::span<const FieldMetric> fields,
              const IndicatorDensity& indicator, SolutionMetric& result) {
  const auto& [mesh, _, options] = input;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const bool isIndicator = f == options.indicator;
    const bool varies = isIndicator ? indicator.largest > 0.0 : fields[f].hasVariation;
    double error = 0.0;
    if (isIndicator) {
      error = largestIndicator(indicator, options.indicatorOrder, result.metrics);
    } else if (varies) {
      error = expectedError(mesh, fields[f], result.metrics, options.norm);
    }
    result.errors.push_back(error);
    result.hasVariation.push_back(varies ? 1 : 0);
  }
  result.frontSizes = frontSizesOf(result.metrics);
}

Task<SolutionMetric> sizeFromSolution(Work& work, const SizingInput& input) {
  const SolutionMetricOptions& options = input.options;
  work.beginPart(0.05);
  const MeshEdges edges = co_await edgesOf(work, input.mesh);
  work.beginPart(0.5);
  const std::vector<FieldMetric> fields = co_await metricsOfFields(work, input, edges);
  const IndicatorDensity indicator = densityIn(input);
  MetricScaling scaling(input.mesh, edges, options);
  const bool isVaried = combine(input, fields, indicator, scaling);
  work.beginPart(1.0);
  if (options.elements > 0.0) {
    co_await scaling.scaleTo(work, options.elements);
  } else {
    // Without variation, every mesh has the error 0: the largest size will do.
    co_await scaling.limit(work, isVaried ? 1.0 : 0.0);
  }
  SolutionMetric result;
  result.elements = scaling.elements();
  result.metrics = std::move(scaling.limited());
  describe(input, fields, indicator, result);
  co_return result;
}

}  // namespace

SolutionSizer::SolutionSizer(VolumeMesh mesh, SolutionFields fields, SolutionMetricOptions options)
    : SlicedTool(makeToolJob<SolutionMetric>(
          SizingInput{std::move(mesh), std::move(fields), options},
          [](Work& work, const SizingInput& input) { return sizeFromSolution(work, input); })) {}

}  // namespace tetrafront
