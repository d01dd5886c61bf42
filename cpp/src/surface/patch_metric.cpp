#include "surface/patch_metric.h"

#include "surface/rules.h"

namespace tetrafront {

namespace {

/// Returns a metric that is not singular. A zero metric becomes `scale` times the identity.
Metric2 regularized(Metric2 metric, double scale) {
  const double trace = metric.xx + metric.yy;
  if (!(trace > 0.0)) return {scale, 0.0, scale};
  // det / trace^2 is about the ratio of the eigenvalues if this ratio is small.
  if (metric.determinant() < kMinEigenvalueRatio * trace * trace) {
    metric.xx += kMinEigenvalueRatio * trace;
    metric.yy += kMinEigenvalueRatio * trace;
  }
  return metric;
}

}  // namespace

Metric2 planeMetric(const SurfacePoint& point, double size) {
  const double scale = 1.0 / (size * size);
  return regularized({scale * glm::dot(point.alongXi, point.alongXi),
                      scale * glm::dot(point.alongXi, point.alongEta),
                      scale * glm::dot(point.alongEta, point.alongEta)},
                     scale);
}

PlaneSample PatchMetric::sample(const Vec2& plane, FieldHint& hint) const {
  const SurfacePoint point = surface_->evaluate(plane);
  if (!field_->isStretched()) {
    const double size = field_->sizeAt(point.position, hint);
    return {point.position, planeMetric(point, size), size};
  }
  const SymmetricTensor toUnit = field_->tensorAt(point.position, hint).inverse();
  const Vec3 xi = toUnit * point.alongXi;
  const Vec3 eta = toUnit * point.alongEta;
  const double size = field_->sizeAt(point.position, hint);
  const Metric2 metric{glm::dot(xi, xi), glm::dot(xi, eta), glm::dot(eta, eta)};
  return {point.position, regularized(metric, 1.0 / (size * size)), size};
}

LocalSpace PatchMetric::spaceAt(const Vec3& position, double size, FieldHint& hint) const {
  LocalSpace local;
  local.targetLength = size;
  if (!field_->isStretched()) return local;
  local.isStretched = true;
  local.targetLength = 1.0;
  local.toSpace = field_->tensorAt(position, hint);
  local.toUnit = local.toSpace.inverse();
  return local;
}

}  // namespace tetrafront
