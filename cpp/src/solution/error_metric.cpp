#include "solution/error_metric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geom/exponential.h"
#include "metric/mesh_metric.h"
#include "metric/metric.h"
#include "metric/principal_axes.h"
#include "solution/power.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Smallest second derivative that the metric follows / largest one in the field: below, sizes of one node would differ
/// by more than any mesh.
constexpr double kFlatCurvature = 1e-10;

/// The norm's power p (0 for the maximum) and its error c of |x|^2 / 2 on a regular tetrahedron with edges 1, exactly:
/// the interpolant's error is the sum of l_i l_j / 2 over its edges, in barycentric coordinates.
struct NormConstants {
  double power;
  double unitError;
};

NormConstants constantsOf(ErrorNorm norm) {
  switch (norm) {
    case ErrorNorm::kL1:
      return {1.0, 3.0 / 20.0};
    case ErrorNorm::kL2:
      return {2.0, std::sqrt(13.0 / 560.0)};
    case ErrorNorm::kL4:
      return {4.0, std::sqrt(std::sqrt(109.0 / 184800.0))};
    case ErrorNorm::kMax:
      break;
  }
  return {0.0, 3.0 / 16.0};
}

/// Returns the square root of the sum of the squares of all components at a node.
PrincipalAxes combinedHessian(std::span<const double> hessians, std::size_t nodes,
                              std::size_t node) {
  const std::size_t components = hessians.size() / (kTensorNumbers * nodes);
  if (components == 1) {
    PrincipalAxes principal = principalAxes(tensorAt(hessians, node));
    for (double& value : principal.values) value = std::fabs(value);
    return principal;
  }
  SymmetricTensor sum = SymmetricTensor::isotropic(0.0);
  for (std::size_t c = 0; c < components; ++c)
    sum.accumulate(tensorAt(hessians, nodes * c + node).squared(), 1.0);
  PrincipalAxes principal = principalAxes(sum);
  for (double& value : principal.values) value = std::sqrt(std::max(0.0, value));
  return principal;
}

/// Calls visit(node, a quarter of the volume of an element) for each corner.
template <class Visit>
void forEachShare(const VolumeMesh& mesh, Visit visit) {
  for (std::uint32_t t = 0; t < countTetrahedra(mesh); ++t) {
    const auto [a, b, c, d] = cornersOf(mesh, TetId(t));
    const double volume = std::fabs(glm::dot(glm::cross(b - a, c - a), d - a)) / 6.0;
    for (const NodeId node : nodesOf(mesh, TetId(t))) visit(node.index(), 0.25 * volume);
  }
}

/// Returns the norm of numbers at the nodes, each constant over its share of the elements.
double normOf(const VolumeMesh& mesh, std::span<const double> atNodes, double power) {
  if (power == 0.0) return atNodes.empty() ? 0.0 : std::ranges::max(atNodes);
  const double largest = atNodes.empty() ? 0.0 : std::ranges::max(atNodes);
  if (!(largest > 0.0)) return 0.0;
  double sum = 0.0;
  forEachShare(mesh, [&](std::size_t node, double share) {
    double term = atNodes[node] / largest;
    for (double p = 1.0; p < power; p *= 2.0) term *= term;
    sum += share * term;
  });
  return largest * powerOf(sum, 1.0 / power);
}

}  // namespace

FieldMetric fieldMetric(const VolumeMesh& mesh, std::span<const double> hessians,
                        std::span<const double> noise, const SolutionMetricOptions& options) {
  const std::size_t nodes = countNodes(mesh);
  FieldMetric field;
  field.hessians.resize(kTensorNumbers * nodes);
  field.metrics.resize(kTensorNumbers * nodes);
  std::vector<PrincipalAxes> all(nodes);
  double largest = 0.0;
  for (std::size_t i = 0; i < nodes; ++i) {
    all[i] = combinedHessian(hessians, nodes, i);
    const double most = std::ranges::max(all[i].values);
    if (options.isIsotropic) all[i].values.fill(most);
    if (most <= noise[i]) all[i].values.fill(0.0);
    largest = std::max(largest, std::ranges::max(all[i].values));
  }
  field.hasVariation = largest > 0.0;
  const double least = field.hasVariation ? kFlatCurvature * largest : 1.0;
  const double power = constantsOf(options.norm).power;
  for (std::size_t i = 0; i < nodes; ++i) {
    double logarithms = 0.0;
    for (double& value : all[i].values) {
      value = std::max(value, least);
      logarithms += logarithm(value);
    }
    const SymmetricTensor hessian = composed(all[i]);
    const double factor = power == 0.0 ? 1.0 : exponential(-logarithms / (2.0 * power + 3.0));
    putTensor(field.hessians, i, hessian);
    putTensor(field.metrics, i, hessian.scaledBy(factor));
  }
  // Summed as the norms of errors are, so that the expected error is the one asked for.
  forEachShare(mesh, [&](std::size_t node, double share) {
    field.complexity += share * densityOf(tensorAt(field.metrics, node));
  });
  return field;
}

double scaleForError(const FieldMetric& field, ErrorNorm norm, double error) {
  const auto [power, unitError] = constantsOf(norm);
  // The complexity of the metrics for K = 1 is the integral of the error.
  const double integral = power == 0.0 ? 1.0 : powerOf(field.complexity, 1.0 / power);
  return unitError * integral / error;
}

double expectedError(const VolumeMesh& mesh, const FieldMetric& field,
                     std::span<const double> metrics, ErrorNorm norm) {
  const auto [power, unitError] = constantsOf(norm);
  std::vector<double> errors(countNodes(mesh), 0.0);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const SymmetricTensor relative =
        Cholesky(tensorAt(metrics, i)).reduced(tensorAt(field.hessians, i));
    errors[i] = unitError / 3.0 * (relative.xx + relative.yy + relative.zz);
  }
  return normOf(mesh, errors, power);
}

}  // namespace tetrafront
