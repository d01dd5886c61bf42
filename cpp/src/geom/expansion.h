#pragma once

/// @file Exact sums of doubles (Shewchuk 1997, "Adaptive precision floating-point arithmetic"):
/// a number is a sum of doubles that do not overlap, least first, without zeros. Its sign is the
/// sign of the last term.

#include <array>
#include <cstddef>

namespace tetrafront {

/// A rounded value and its rounding error: high + low is exact.
struct TwoTerms {
  double high;
  double low;
};

inline TwoTerms twoSum(double a, double b) {
  const double sum = a + b;
  const double bVirtual = sum - a;
  const double aVirtual = sum - bVirtual;
  return {sum, (a - aVirtual) + (b - bVirtual)};
}

/// Does the same as twoSum(), for |a| >= |b|.
inline TwoTerms fastTwoSum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Splits a double by Dekker's method: high has 26 bits, low the rest.
inline TwoTerms splitBits(double a) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double scaled = kSplitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

inline TwoTerms twoProduct(double a, TwoTerms bSplit, double b) {
  const double product = a * b;
  const TwoTerms aSplit = splitBits(a);
  const double e1 = product - aSplit.high * bSplit.high;
  const double e2 = e1 - aSplit.low * bSplit.high;
  const double e3 = e2 - aSplit.high * bSplit.low;
  return {product, aSplit.low * bSplit.low - e3};
}

/// An exact number of at most Capacity terms.
template <std::size_t Capacity>
class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(TwoTerms value) {
    append(value.low);
    append(value.high);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double term(std::size_t i) const { return terms_[i]; }
  [[nodiscard]] int sign() const {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0.0 ? 1 : -1;
  }
  void append(double term) {
    if (term != 0.0) terms_[size_++] = term;
  }
  [[nodiscard]] Expansion negated() const {
    Expansion result;
    for (std::size_t i = 0; i < size_; ++i) result.append(-terms_[i]);
    return result;
  }

 private:
  std::array<double, Capacity> terms_;
  std::size_t size_ = 0;
};

/// Returns a - b, exactly.
inline Expansion<2> exactDifference(double a, double b) { return Expansion<2>(twoSum(a, -b)); }

template <std::size_t N, std::size_t M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> sum;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto nextIsFromE = [&] {
    if (j == f.size()) return true;
    if (i == e.size()) return false;
    const double a = e.term(i);
    const double b = f.term(j);
    return (b > a) == (b > -a);  // |a| <= |b|
  };
  const auto next = [&] { return nextIsFromE() ? e.term(i++) : f.term(j++); };
  if (e.size() + f.size() == 0) return sum;
  double q = next();
  while (i < e.size() || j < f.size()) {
    const TwoTerms t = twoSum(q, next());
    sum.append(t.low);
    q = t.high;
  }
  sum.append(q);
  return sum;
}

template <std::size_t N>
Expansion<2 * N> scaled(const Expansion<N>& e, double factor) {
  Expansion<2 * N> product;
  if (e.size() == 0) return product;
  const TwoTerms split = splitBits(factor);
  TwoTerms q = twoProduct(e.term(0), split, factor);
  product.append(q.low);
  for (std::size_t i = 1; i < e.size(); ++i) {
    const TwoTerms t = twoProduct(e.term(i), split, factor);
    const TwoTerms s = twoSum(q.high, t.low);
    product.append(s.low);
    q = fastTwoSum(t.high, s.high);
    product.append(q.low);
  }
  product.append(q.high);
  return product;
}

/// Returns e times a number of two terms.
template <std::size_t N>
Expansion<4 * N> operator*(const Expansion<N>& e, const Expansion<2>& f) {
  Expansion<2 * N> low;
  Expansion<2 * N> high;
  if (f.size() > 0) low = scaled(e, f.term(0));
  if (f.size() > 1) high = scaled(e, f.term(1));
  return low + high;
}

}  // namespace tetrafront
