#pragma once

/// @file Whole numbers of any size, for oracles. Short rather than fast, and independent of the
/// engine's arithmetic.

#include <cmath>
#include <cstdint>
#include <vector>

namespace tetrafront::testing {

class BigInteger {
 public:
  BigInteger() = default;
  BigInteger(long long value)  // NOLINT(google-explicit-constructor): reads like arithmetic
      : isNegative_(value < 0) {
    auto rest = static_cast<unsigned long long>(value);
    if (isNegative_) rest = 0ULL - rest;
    for (; rest > 0; rest >>= 32U) digits_.push_back(static_cast<std::uint32_t>(rest));
  }

  /// Returns value * 2^shift, which must be a whole number.
  static BigInteger scaled(double value, int shift) {
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent);  // value = fraction * 2^exponent
    BigInteger result(static_cast<long long>(std::ldexp(fraction, 53)));
    exponent += shift - 53;
    for (; exponent < 0; ++exponent) result = result.half();
    const auto bits = static_cast<std::size_t>(exponent);
    BigInteger power(1LL << (bits % 32));
    power.digits_.insert(power.digits_.begin(), bits / 32, 0U);
    return result * power;
  }

  [[nodiscard]] int sign() const { return digits_.empty() ? 0 : (isNegative_ ? -1 : 1); }

  friend BigInteger operator-(BigInteger a) {
    a.isNegative_ = !a.isNegative_ && !a.digits_.empty();
    return a;
  }
  friend BigInteger operator+(const BigInteger& a, const BigInteger& b) {
    if (a.isNegative_ == b.isNegative_) return {sum(a.digits_, b.digits_), a.isNegative_};
    if (isLess(a.digits_, b.digits_)) return {difference(b.digits_, a.digits_), b.isNegative_};
    return {difference(a.digits_, b.digits_), a.isNegative_};
  }
  friend BigInteger operator-(const BigInteger& a, const BigInteger& b) { return a + (-b); }
  friend BigInteger operator*(const BigInteger& a, const BigInteger& b) {
    Digits product(a.digits_.size() + b.digits_.size(), 0);
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.digits_.size() || carry > 0; ++j) {
        const std::uint64_t digit = j < b.digits_.size() ? b.digits_[j] : 0;
        carry += product[i + j] + a.digits_[i] * digit;
        product[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32U;
      }
    }
    return {std::move(product), a.isNegative_ != b.isNegative_};
  }
  friend bool operator==(const BigInteger& a, const BigInteger& b) { return (a - b).sign() == 0; }

 private:
  using Digits = std::vector<std::uint32_t>;  ///< least first, no zeros at the end

  BigInteger(Digits digits, bool isNegative) : digits_(std::move(digits)), isNegative_(isNegative) {
    while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
    if (digits_.empty()) isNegative_ = false;
  }

  [[nodiscard]] BigInteger half() const {
    Digits result(digits_.size(), 0);
    std::uint32_t carry = 0;
    for (std::size_t i = digits_.size(); i-- > 0;) {
      result[i] = digits_[i] >> 1U | carry << 31U;
      carry = digits_[i] & 1U;
    }
    return {std::move(result), isNegative_};
  }
  static bool isLess(const Digits& a, const Digits& b) {
    if (a.size() != b.size()) return a.size() < b.size();
    for (std::size_t i = a.size(); i-- > 0;) {
      if (a[i] != b[i]) return a[i] < b[i];
    }
    return false;
  }
  static Digits sum(const Digits& a, const Digits& b) {
    Digits result;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < a.size() || i < b.size() || carry > 0; ++i) {
      if (i < a.size()) carry += a[i];
      if (i < b.size()) carry += b[i];
      result.push_back(static_cast<std::uint32_t>(carry));
      carry >>= 32U;
    }
    return result;
  }
  /// Returns a - b; a must not be less than b.
  static Digits difference(const Digits& a, const Digits& b) {
    Digits result;
    std::int64_t borrow = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      std::int64_t digit = static_cast<std::int64_t>(a[i]) - borrow;
      if (i < b.size()) digit -= b[i];
      borrow = digit < 0 ? 1 : 0;
      result.push_back(static_cast<std::uint32_t>(digit + (borrow << 32U)));
    }
    return result;
  }

  Digits digits_;
  bool isNegative_ = false;
};

}  // namespace tetrafront::testing
