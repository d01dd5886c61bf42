#include "surface/patch_metric.h"

namespace tetrafront {

namespace {

/// Smallest ratio of G's eigenvalues: elements of the plane may be stretched 100:1 to become
/// equilateral in space; beyond, the patch is degenerate there and shape has no meaning.
constexpr double kSmallestEigenvalueRatio = 1e-4;

}  // namespace

Metric2 planeMetric(const SurfacePoint& point, double size) {
  const double scale = 1.0 / (size * size);
  Metric2 metric{scale * glm::dot(point.alongXi, point.alongXi),
                 scale * glm::dot(point.alongXi, point.alongEta),
                 scale * glm::dot(point.alongEta, point.alongEta)};
  const double trace = metric.xx + metric.yy;
  if (!(trace > 0.0)) return {scale, 0.0, scale};
  // det / trace^2 is about the ratio of the eigenvalues where that is small.
  if (metric.determinant() < kSmallestEigenvalueRatio * trace * trace) {
    metric.xx += kSmallestEigenvalueRatio * trace;
    metric.yy += kSmallestEigenvalueRatio * trace;
  }
  return metric;
}

PlaneSample PatchMetric::sample(const Vec2& plane, FieldHint& hint) const {
  const SurfacePoint point = surface_->evaluate(plane);
  const double size = field_->sizeAt(point.position, hint);
  return {point.position, planeMetric(point, size), size};
}

}  // namespace tetrafront
