#pragma once

/// @file Numbers m * 2^e with m and e whole, of many digits: every double is one, and sums,
/// differences and products are exact. For constructed points, whose coordinates are longer than a
/// double; where doubles are enough, expansions are faster.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tetrafront/vec3.h"

namespace tetrafront {

class Dyadic {
 public:
  /// Results need at most this many digits of 32 bits; what would need more becomes zero, so
  /// callers keep their operands shorter: a product of three differences has three times as many.
  static constexpr std::size_t kMaxDigits = 96;

  Dyadic() = default;
  /// `value` must be finite.
  explicit Dyadic(double value);
  Dyadic(const Dyadic& other) { *this = other; }
  Dyadic& operator=(const Dyadic& other);
  ~Dyadic() = default;

  [[nodiscard]] int sign() const { return size_ == 0 ? 0 : (isNegative_ ? -1 : 1); }
  /// How many digits it spans.
  [[nodiscard]] std::size_t digitCount() const { return size_; }
  /// Exact where a double can hold it, else within two units in the last place. Not for numbers
  /// beyond the range of doubles.
  [[nodiscard]] double toDouble() const { return toDoubleAt(0); }

  [[nodiscard]] Dyadic negated() const;
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + b.negated(); }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
  friend bool operator==(const Dyadic& a, const Dyadic& b) { return (a - b).sign() == 0; }

  /// a / b in double, within a few units in the last place; b must not be zero.
  friend double quotient(const Dyadic& a, const Dyadic& b);

 private:
  using Digits = std::array<std::uint32_t, kMaxDigits>;

  [[nodiscard]] std::span<const std::uint32_t> digits() const { return {digits_.data(), size_}; }
  /// This times 2^(32 shift).
  [[nodiscard]] double toDoubleAt(int shift) const;
  /// The digit of weight 2^(32 place).
  [[nodiscard]] std::uint32_t digitAt(int place) const {
    const int i = place - lowest_;
    return i >= 0 && i < static_cast<int>(size_) ? digits_[static_cast<std::size_t>(i)] : 0;
  }
  [[nodiscard]] int end() const { return lowest_ + static_cast<int>(size_); }
  static bool isSmaller(const Dyadic& a, const Dyadic& b);
  static Dyadic sumOfSizes(const Dyadic& a, const Dyadic& b);
  static Dyadic differenceOfSizes(const Dyadic& larger, const Dyadic& smaller);
  bool reserve(int lowest, int end);
  void trim();

  Digits digits_;  ///< the first size_ of them; least first, neither end zero
  std::size_t size_ = 0;
  int lowest_ = 0;  ///< the first digit's weight is 2^(32 lowest_)
  bool isNegative_ = false;
};

using DyadicVec3 = std::array<Dyadic, 3>;

[[nodiscard]] DyadicVec3 toDyadic(const Vec3& v);
[[nodiscard]] DyadicVec3 operator+(const DyadicVec3& a, const DyadicVec3& b);
[[nodiscard]] DyadicVec3 operator-(const DyadicVec3& a, const DyadicVec3& b);
[[nodiscard]] DyadicVec3 operator*(const DyadicVec3& a, const Dyadic& factor);
[[nodiscard]] Dyadic dot(const DyadicVec3& a, const DyadicVec3& b);
[[nodiscard]] DyadicVec3 cross(const DyadicVec3& a, const DyadicVec3& b);

/// (b-a) x (c-a) . (d-a), exactly.
[[nodiscard]] Dyadic determinant(const DyadicVec3& a, const DyadicVec3& b, const DyadicVec3& c,
                                 const DyadicVec3& d);

}  // namespace tetrafront
