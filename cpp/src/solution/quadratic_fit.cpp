#include "solution/quadratic_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "metric/principal_axes.h"

namespace tetrafront {
namespace {

/// Width of a distribution of samples / its largest width, from which it counts as flat.
constexpr double kFlatWidth = 1e-6;

/// Diagonal entry / largest one, below which a term is not determined.
constexpr double kUndetermined = 1e-9;

/// Weight of a sample at a distance of r standard deviations: 1 / (kNearWeight + r^2).
constexpr double kNearWeight = 0.5;

std::array<double, kQuadraticTerms> termsAt(const Vec3& v) {
  return {1.0,       v.x,       v.y,      v.z, 0.5 * v.x * v.x, 0.5 * v.y * v.y, 0.5 * v.z * v.z,
          v.x * v.y, v.x * v.z, v.y * v.z};
}

}  // namespace

void QuadraticFit::scale(std::span<const Vec3> offsets) {
  SymmetricTensor moments = SymmetricTensor::isotropic(0.0);
  const double weight = 1.0 / static_cast<double>(offsets.size());
  for (const Vec3& d : offsets)
    moments.accumulate({d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z}, weight);
  const PrincipalAxes principal = principalAxes(moments);
  const double largest = std::sqrt(std::max(0.0, std::ranges::max(principal.values)));
  for (std::size_t k = 0; k < 3; ++k) {
    const double width = std::sqrt(std::max(0.0, principal.values[k]));
    const bool isFlat = !(width > kFlatWidth * largest);
    scaling_[k] = isFlat ? Vec3(0.0) : principal.axes[k] / width;
  }
}

void QuadraticFit::fillRow(std::size_t row, const Vec3& offset) {
  const Vec3 scaled(glm::dot(scaling_[0], offset), glm::dot(scaling_[1], offset),
                    glm::dot(scaling_[2], offset));
  const double weight = 1.0 / (kNearWeight + glm::dot(scaled, scaled));
  weights_[row] = weight;
  const auto terms = termsAt(scaled);
  for (std::size_t c = 0; c < kQuadraticTerms; ++c) columns_[c * rows_ + row] = weight * terms[c];
}

void QuadraticFit::factor(std::span<const Vec3> offsets) {
  rows_ = offsets.size();
  columns_.resize(kQuadraticTerms * rows_);
  weights_.resize(rows_);
  right_.resize(rows_);
  scale(offsets);
  for (std::size_t row = 0; row < rows_; ++row) fillRow(row, offsets[row]);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  diagonal_.fill(0.0);
  rank_ = 0;
  const std::size_t steps = std::min(rows_, kQuadraticTerms);
  for (std::size_t step = 0; step < steps; ++step) {
    reflect(step);
    if (!(std::fabs(diagonal_[step]) > kUndetermined * std::fabs(diagonal_[0]))) break;
    ++rank_;
  }
}

/// Moves the column with the largest rest to `step`, and reflects it and those after it so that its rest vanishes.
void QuadraticFit::reflect(std::size_t step) {
  const auto columnOf = [&](std::size_t c) { return columns_.data() + order_[c] * rows_; };
  const auto restOf = [&](std::size_t c) {
    double sum = 0.0;
    for (std::size_t row = step; row < rows_; ++row) sum += columnOf(c)[row] * columnOf(c)[row];
    return sum;
  };
  std::size_t pivot = step;
  double largest = restOf(step);
  for (std::size_t c = step + 1; c < kQuadraticTerms; ++c) {
    const double rest = restOf(c);
    if (rest > largest) {
      largest = rest;
      pivot = c;
    }
  }
  std::swap(order_[step], order_[pivot]);
  double* own = columnOf(step);
  const double norm = std::sqrt(largest);
  diagonal_[step] = own[step] > 0.0 ? -norm : norm;
  if (norm == 0.0) return;
  own[step] -= diagonal_[step];
  const double factor = -1.0 / (diagonal_[step] * own[step]);
  for (std::size_t c = step + 1; c < kQuadraticTerms; ++c) {
    double* column = columnOf(c);
    double sum = 0.0;
    for (std::size_t row = step; row < rows_; ++row) sum += own[row] * column[row];
    for (std::size_t row = step; row < rows_; ++row) column[row] -= factor * sum * own[row];
  }
}

double QuadraticFit::conditioning() const {
  if (rank_ < kQuadraticTerms) return 0.0;
  double least = std::fabs(diagonal_[0]);
  for (const double entry : diagonal_) least = std::min(least, std::fabs(entry));
  return least / std::fabs(diagonal_[0]);
}

SymmetricTensor QuadraticFit::hessianOf(std::span<const double> values) {
  // Values relative to the first one keep the digits of a small variation about a large value.
  for (std::size_t row = 0; row < rows_; ++row)
    right_[row] = weights_[row] * (values[row] - values[0]);
  for (std::size_t step = 0; step < rank_; ++step) {
    const double* own = columns_.data() + order_[step] * rows_;
    double sum = 0.0;
    for (std::size_t row = step; row < rows_; ++row) sum += own[row] * right_[row];
    const double factor = -1.0 / (diagonal_[step] * own[step]);
    for (std::size_t row = step; row < rows_; ++row) right_[row] -= factor * sum * own[row];
  }
  std::array<double, kQuadraticTerms> terms{};
  for (std::size_t step = rank_; step-- > 0;) {
    double rest = right_[step];
    for (std::size_t c = step + 1; c < rank_; ++c)
      rest -= columns_[order_[c] * rows_ + step] * terms[order_[c]];
    terms[order_[step]] = rest / diagonal_[step];
  }
  return mappedBack(terms);
}

SymmetricTensor QuadraticFit::mappedBack(const std::array<double, kQuadraticTerms>& t) const {
  const SymmetricTensor scaled{
      .xx = t[4], .yy = t[5], .zz = t[6], .xy = t[7], .xz = t[8], .yz = t[9]};
  SymmetricTensor hessian = SymmetricTensor::isotropic(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 row = scaled.row(static_cast<int>(i));
    for (int j = 0; j < 3; ++j) {
      const Vec3& a = scaling_[i];
      const Vec3& b = scaling_[static_cast<std::size_t>(j)];
      hessian.accumulate({a.x * b.x, a.y * b.y, a.z * b.z, 0.5 * (a.x * b.y + a.y * b.x),
                          0.5 * (a.x * b.z + a.z * b.x), 0.5 * (a.y * b.z + a.z * b.y)},
                         row[j]);
    }
  }
  return hessian;
}

}  // namespace tetrafront
