#pragma once

/// @file A sum whose rounding error does not grow with the number of terms (Neumaier 1974). In a plain sum of millions of equal
/// terms, such as the volumes of a lattice, all errors have the same sign.

#include <cmath>

namespace tetrafront {

class CompensatedSum {
 public:
  void add(double term) {
    const double sum = sum_ + term;
    // The smaller of both loses its last digits.
    lost_ += std::fabs(sum_) >= std::fabs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }
  [[nodiscard]] double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0;
  double lost_ = 0.0;
};

}  // namespace tetrafront
