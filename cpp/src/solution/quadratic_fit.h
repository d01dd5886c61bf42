#pragma once

/// @file The quadratic function that fits samples best, in the sense of weighted least squares, by a Householder
/// factorization with pivots.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "metric/symmetric_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Coefficients of a quadratic function: 1, three linear and six quadratic.
inline constexpr std::size_t kQuadraticTerms = 10;

/// Samples around a centre, and the factors of their matrix. May be used again; it keeps its memory.
class QuadraticFit {
 public:
  /// Factors the matrix of the samples at the given offsets from the centre. The offsets are first mapped to a
  /// distribution that is as wide in all directions, so that meshes of any stretching are fitted equally well.
  void factor(std::span<const Vec3> offsets);

  /// Returns smallest / largest diagonal entry of the triangular factor: 0 if the samples do not determine a
  /// quadratic function.
  [[nodiscard]] double conditioning() const;

  /// Returns the second derivatives of the fit to values, one per sample. Terms that the samples do not determine are
  /// 0. Exact, up to rounding, for the values of a quadratic function that the samples determine.
  [[nodiscard]] SymmetricTensor hessianOf(std::span<const double> values);

 private:
  void scale(std::span<const Vec3> offsets);
  void fillRow(std::size_t row, const Vec3& offset);
  void reflect(std::size_t step);
  [[nodiscard]] SymmetricTensor mappedBack(const std::array<double, kQuadraticTerms>& terms) const;

  std::array<Vec3, 3>
      scaling_{};  ///< rows of the map to the distribution that is as wide in all directions
  std::size_t rows_ = 0;
  std::size_t rank_ = 0;
  std::vector<double> columns_;  ///< column by column; below the diagonal, the reflections
  std::vector<double> weights_;  ///< per sample
  std::array<std::size_t, kQuadraticTerms> order_{};  ///< of the columns
  std::array<double, kQuadraticTerms> diagonal_{};
  std::vector<double> right_;
};

}  // namespace tetrafront
