#pragma once

/// @file Numbers m * 2^e with integers m and e of any length: every double is one, and sums,
/// differences and products are exact. They hold constructed points, whose coordinates do not fit
/// into a double. For coordinates in doubles, expansions are faster.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Digits of 32 bits, least significant first. A few digits are stored in place; longer numbers,
/// which result from distant exponents, use the heap.
class Digits {
 public:
  Digits() = default;
  Digits(const Digits& other) { *this = other; }
  Digits& operator=(const Digits& other) {
    if (this != &other) assign(other.data(), other.size_);
    return *this;
  }
  ~Digits() = default;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const std::uint32_t* data() const {
    return size_ > kInPlace ? many_.data() : few_.data();
  }
  std::uint32_t* data() { return size_ > kInPlace ? many_.data() : few_.data(); }
  std::uint32_t operator[](std::size_t i) const { return data()[i]; }
  std::uint32_t& operator[](std::size_t i) { return data()[i]; }

  /// Sets `count` digits, all zero.
  void reset(std::size_t size) {
    size_ = size;
    if (size > kInPlace) {
      many_.assign(size, 0);
    } else {
      std::fill_n(few_.begin(), size, 0U);
    }
  }
  /// Keeps only `count` digits from `first` on.
  void keep(std::size_t first, std::size_t count) {
    const std::uint32_t* from = data() + first;
    std::uint32_t* to = count > kInPlace ? many_.data() : few_.data();
    if (to != from) std::copy(from, from + count, to);
    size_ = count;
  }

 private:
  static constexpr std::size_t kInPlace = 40;

  void assign(const std::uint32_t* from, std::size_t size) {
    size_ = size;
    if (size > kInPlace) {
      many_.assign(from, from + size);
    } else {
      std::copy_n(from, size, few_.begin());
    }
  }

  std::size_t size_ = 0;
  std::array<std::uint32_t, kInPlace> few_;
  std::vector<std::uint32_t> many_;
};

class Dyadic {
 public:
  Dyadic() = default;
  /// `value` must be finite.
  explicit Dyadic(double value);

  [[nodiscard]] int sign() const { return digits_.size() == 0 ? 0 : (isNegative_ ? -1 : 1); }
  /// Number of digits that it spans.
  [[nodiscard]] std::size_t digitCount() const { return digits_.size(); }
  /// Exact if a double can hold the number, else within two units in the last place. The number
  /// must be in the range of doubles.
  [[nodiscard]] double toDouble() const { return toDoubleAt(0); }

  [[nodiscard]] Dyadic negated() const;
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b);
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + b.negated(); }
  friend Dyadic operator*(const Dyadic& a, const Dyadic& b);
  friend bool operator==(const Dyadic& a, const Dyadic& b) { return (a - b).sign() == 0; }

  /// Returns a / b as a double, within a few units in the last place; b must not be zero.
  friend double quotient(const Dyadic& a, const Dyadic& b);

 private:
  /// Returns this number times 2^(32 shift).
  [[nodiscard]] double toDoubleAt(int shift) const;
  /// Returns the digit of weight 2^(32 index).
  [[nodiscard]] std::uint32_t digitAt(int index) const {
    const int i = index - lowest_;
    return i >= 0 && i < static_cast<int>(digits_.size()) ? digits_[static_cast<std::size_t>(i)]
                                                          : 0;
  }
  [[nodiscard]] int end() const { return lowest_ + static_cast<int>(digits_.size()); }
  static bool isSmaller(const Dyadic& a, const Dyadic& b);
  static Dyadic sumOfSizes(const Dyadic& a, const Dyadic& b);
  static Dyadic differenceOfSizes(const Dyadic& larger, const Dyadic& smaller);
  void clear(int lowest, int end);
  void trim();

  Digits digits_;   ///< without zeros at either end
  int lowest_ = 0;  ///< weight of the first digit is 2^(32 lowest_)
  bool isNegative_ = false;
};

using DyadicVec3 = std::array<Dyadic, 3>;

[[nodiscard]] DyadicVec3 toDyadic(const Vec3& v);
[[nodiscard]] DyadicVec3 operator+(const DyadicVec3& a, const DyadicVec3& b);
[[nodiscard]] DyadicVec3 operator-(const DyadicVec3& a, const DyadicVec3& b);
[[nodiscard]] DyadicVec3 operator*(const DyadicVec3& a, const Dyadic& factor);
[[nodiscard]] Dyadic dot(const DyadicVec3& a, const DyadicVec3& b);
[[nodiscard]] DyadicVec3 cross(const DyadicVec3& a, const DyadicVec3& b);

/// Returns (b-a) x (c-a) . (d-a), exactly.
[[nodiscard]] Dyadic determinant(const DyadicVec3& a, const DyadicVec3& b, const DyadicVec3& c,
                                 const DyadicVec3& d);

}  // namespace tetrafront
