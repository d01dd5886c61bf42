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
#include "solution/recovered_hessian.h"
#include "solution/front_sizes.h"
#include "tetrafront/solution.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

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

  /// Computes the limited metric, with all metrics times `factor`.
  Task<> limit(Work& work, double factor) {
    limited_ = unlimited_;
    co_await work.forEachId<NodeId>(
        countNodes(mesh_),
        [&](NodeId node) {
          const SymmetricTensor metric = tensorAt(unlimited_, node.index()).scaledBy(factor);
          putTensor(limited_, node.index(), bounded(metric, bounds_));
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
  std::vector<double> limited_;
};

double magnitudeOf(std::span<const double> values) {
  double magnitude = 0.0;
  for (const double value : values) magnitude = std::max(magnitude, std::fabs(value));
  return magnitude;
}

/// Returns the metric of each field, for itself.
Task<std::vector<FieldMetric>> metricsOfFields(Work& work, const SizingInput& input,
                                               const MeshEdges& edges) {
  const auto& [mesh, fields, options] = input;
  const std::size_t count = fields.components.size();
  std::vector<FieldMetric> all;
  std::size_t first = 0;
  for (std::size_t f = 0; f < count; ++f) {
    work.beginShare(1.0, static_cast<double>(count - f));
    const bool isPerElement = fields.isPerElement[f] != 0;
    const std::size_t samples = isPerElement ? countTetrahedra(mesh) : countNodes(mesh);
    const std::size_t numbers = samples * fields.components[f];
    const auto values = std::span(fields.values).subspan(first, numbers);
    first += numbers;
    const SampledValues sampled{values, fields.components[f], isPerElement};
    const std::vector<double> hessians = co_await recoverHessians(work, mesh, edges, sampled);
    const std::vector<double> noise = noiseOf(mesh, edges, magnitudeOf(values));
    all.push_back(fieldMetric(mesh, hessians, noise, options));
  }
  co_return all;
}

/// Returns the factor of the metric of a field with which it alone, without limits, has the error or the number.
double factorFor(const FieldMetric& field, const SolutionMetricOptions& options) {
  if (!(options.elements > 0.0)) return scaleForError(field, options.norm, options.error);
  const double root = cubeRoot(options.elements / kElementsPerComplexity / field.complexity);
  return root * root;
}

/// Completes a result that has its metrics.
void describe(const VolumeMesh& mesh, std::span<const FieldMetric> fields, ErrorNorm norm,
              SolutionMetric& result) {
  for (const FieldMetric& field : fields) {
    const bool varies = field.hasVariation;
    result.errors.push_back(varies ? expectedError(mesh, field, result.metrics, norm) : 0.0);
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
  MetricScaling scaling(input.mesh, edges, options);
  for (const FieldMetric& field : fields)
    if (field.hasVariation) scaling.add(field, factorFor(field, options));
  const bool isUniform = scaling.isEmpty();
  if (isUniform) scaling.setUniform();
  work.beginPart(1.0);
  if (options.elements > 0.0) {
    co_await scaling.scaleTo(work, options.elements);
  } else {
    // Without variation, every mesh has the error 0: the largest size will do.
    co_await scaling.limit(work, isUniform ? 0.0 : 1.0);
  }
  SolutionMetric result;
  result.elements = scaling.elements();
  result.metrics = std::move(scaling.limited());
  describe(input.mesh, fields, options.norm, result);
  co_return result;
}

}  // namespace

SolutionSizer::SolutionSizer(VolumeMesh mesh, SolutionFields fields, SolutionMetricOptions options)
    : SlicedTool(makeToolJob<SolutionMetric>(
          SizingInput{std::move(mesh), std::move(fields), options},
          [](Work& work, const SizingInput& input) { return sizeFromSolution(work, input); })) {}

}  // namespace tetrafront
