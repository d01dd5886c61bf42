#include "curved/node_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tetrafront {
namespace {

constexpr int kBounds = 8;         ///< times that the bound rises
constexpr int kStepsPerBound = 4;  ///< Newton steps towards each centre
constexpr double kRise = 0.7;      ///< part of the way from the bound to the least coefficient

double valueAt(const AffineCoefficient& coefficient, const Vec3& step) {
  return coefficient.value + glm::dot(coefficient.gradient, step);
}

double leastAt(std::span<const AffineCoefficient> coefficients, const Vec3& step) {
  double least = std::numeric_limits<double>::infinity();
  for (const AffineCoefficient& one : coefficients) least = std::min(least, valueAt(one, step));
  return least;
}

/// Returns a Newton step towards the largest sum of log(coefficient - bound), damped so that all stay above the bound.
Vec3 newtonStep(std::span<const AffineCoefficient> coefficients, const Vec3& step, double bound) {
  Vec3 gradient{0.0};
  std::array<Vec3, 3> hessian{Vec3(0.0), Vec3(0.0), Vec3(0.0)};
  for (const AffineCoefficient& one : coefficients) {
    const Vec3 scaled = one.gradient / (valueAt(one, step) - bound);
    gradient += scaled;
    for (int k = 0; k < 3; ++k) hessian[k] += scaled[k] * scaled;
  }
  // A direction in which nothing changes must not make the matrix singular. The share of the trace is far above the rounding of
  // the sums, and too small to change a step in other directions.
  constexpr double kRegularization = 1e-9;
  const double trace = hessian[0].x + hessian[1].y + hessian[2].z;
  for (int k = 0; k < 3; ++k) hessian[k][k] += kRegularization * trace;
  const Vec3 first = glm::cross(hessian[1], hessian[2]);
  const double determinant = glm::dot(hessian[0], first);
  if (!(determinant > 0.0)) return Vec3(0.0);
  const Vec3 newton = (gradient.x * first + gradient.y * glm::cross(hessian[2], hessian[0]) +
                       gradient.z * glm::cross(hessian[0], hessian[1])) /
                      determinant;
  const double decrement = std::sqrt(std::max(0.0, glm::dot(gradient, newton)));
  return newton / (1.0 + decrement);
}

}  // namespace

Vec3 raisingStep(std::span<const AffineCoefficient> coefficients) {
  Vec3 step{0.0};
  double sum = 0.0;
  for (const AffineCoefficient& one : coefficients) sum += one.value;
  double least = leastAt(coefficients, step);
  const double spread = sum / static_cast<double>(coefficients.size()) - least;
  if (!(spread > 0.0)) return step;
  double bound = least - 0.5 * spread;
  for (int rise = 0; rise < kBounds; ++rise) {
    for (int k = 0; k < kStepsPerBound; ++k) {
      const Vec3 next = step + newtonStep(coefficients, step, bound);
      if (!(leastAt(coefficients, next) > bound)) return step;
      step = next;
    }
    least = leastAt(coefficients, step);
    bound += kRise * (least - bound);
  }
  return step;
}

}  // namespace tetrafront
