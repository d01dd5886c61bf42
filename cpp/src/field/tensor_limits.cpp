#include "field/tensor_limits.h"

#include <algorithm>
#include <cmath>

#include "base/tolerance.h"

namespace tetrafront {
namespace {

/// Returns whether limit - tensor is positive semidefinite, up to rounding.
bool isNowhereAbove(const SymmetricTensor& tensor, const SymmetricTensor& limit) {
  const double slack = Tolerance(largestPossible(limit)).rounding();
  const double xx = limit.xx - tensor.xx + slack;
  const double yy = limit.yy - tensor.yy + slack;
  const double zz = limit.zz - tensor.zz + slack;
  const double xy = limit.xy - tensor.xy;
  const double xz = limit.xz - tensor.xz;
  const double yz = limit.yz - tensor.yz;
  if (!(xx > 0.0)) return false;
  const double y = yy - xy * xy / xx;
  if (!(y > 0.0)) return false;
  const double cross = yz - xy * xz / xx;
  return zz - xz * xz / xx - cross * cross / y > 0.0;
}

}  // namespace

double largestPossible(const SymmetricTensor& t) {
  const double xy = std::fabs(t.xy);
  const double xz = std::fabs(t.xz);
  const double yz = std::fabs(t.yz);
  return std::max({t.xx + xy + xz, t.yy + xy + yz, t.zz + xz + yz});
}

SymmetricTensor cappedTo(const SymmetricTensor& tensor, double size) {
  if (largestPossible(tensor) <= size) return tensor;
  PrincipalAxes principal = principalAxes(tensor);
  bool cut = false;
  for (double& value : principal.values) {
    cut = cut || value > size;
    value = std::min(value, size);
  }
  return cut ? composed(principal) : tensor;
}

SymmetricTensor limitedBy(const SymmetricTensor& tensor, const SymmetricTensor& limit) {
  if (isNowhereAbove(tensor, limit)) return tensor;
  const Cholesky lower(limit);
  PrincipalAxes principal = principalAxes(lower.reduced(tensor));
  for (std::size_t i = 0; i < 3; ++i) {
    principal.values[i] = std::min(principal.values[i], 1.0);
    principal.axes[i] = lower.times(principal.axes[i]);
  }
  return composed(principal);
}

}  // namespace tetrafront
