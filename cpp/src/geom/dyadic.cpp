#include "geom/dyadic.h"

#include <algorithm>
#include <cmath>

namespace tetrafront {
namespace {

constexpr int kDigitBits = 32;

int floorOfDivision(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

Dyadic::Dyadic(double value) {
  if (value == 0.0) return;
  constexpr int kMantissaBits = 53;
  int exponent = 0;
  const double fraction = std::frexp(std::fabs(value), &exponent);
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, kMantissaBits));
  exponent -= kMantissaBits;
  lowest_ = floorOfDivision(exponent, kDigitBits);
  const auto positions = static_cast<unsigned>(exponent - lowest_ * kDigitBits);
  // 53 bits shifted by less than 32: up to three digits.
  std::uint64_t carry = 0;
  digits_.reset(3);
  for (std::size_t i = 0; i < digits_.size(); ++i) {
    carry |= (mantissa & 0xffffffffU) << positions;
    digits_[i] = static_cast<std::uint32_t>(carry);
    carry >>= kDigitBits;
    mantissa >>= kDigitBits;
  }
  isNegative_ = value < 0.0;
  trim();
}

void Dyadic::trim() {
  std::size_t count = digits_.size();
  while (count > 0 && digits_[count - 1] == 0) --count;
  std::size_t zeros = 0;
  while (zeros < count && digits_[zeros] == 0) ++zeros;
  if (count - zeros < digits_.size()) digits_.keep(zeros, count - zeros);
  lowest_ += static_cast<int>(zeros);
  if (digits_.size() == 0) {
    lowest_ = 0;
    isNegative_ = false;
  }
}

/// Zeros at the digits [lowest, end).
void Dyadic::clear(int lowest, int end) {
  lowest_ = lowest;
  digits_.reset(static_cast<std::size_t>(end - lowest));
}

Dyadic Dyadic::negated() const {
  Dyadic result = *this;
  if (digits_.size() > 0) result.isNegative_ = !isNegative_;
  return result;
}

bool Dyadic::isSmaller(const Dyadic& a, const Dyadic& b) {
  if (a.end() != b.end()) return a.end() < b.end();
  const int lowest = std::min(a.lowest_, b.lowest_);
  for (int position = a.end() - 1; position >= lowest; --position) {
    const std::uint32_t da = a.digitAt(position);
    const std::uint32_t db = b.digitAt(position);
    if (da != db) return da < db;
  }
  return false;
}

Dyadic Dyadic::sumOfSizes(const Dyadic& a, const Dyadic& b) {
  Dyadic result;
  const int lowest = std::min(a.lowest_, b.lowest_);
  result.clear(lowest, std::max(a.end(), b.end()) + 1);
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < result.digits_.size(); ++i) {
    const int position = lowest + static_cast<int>(i);
    carry += std::uint64_t{a.digitAt(position)} + b.digitAt(position);
    result.digits_[i] = static_cast<std::uint32_t>(carry);
    carry >>= kDigitBits;
  }
  result.trim();
  return result;
}

Dyadic Dyadic::differenceOfSizes(const Dyadic& larger, const Dyadic& smaller) {
  Dyadic result;
  const int lowest = std::min(larger.lowest_, smaller.lowest_);
  result.clear(lowest, larger.end());
  std::int64_t borrow = 0;
  for (std::size_t i = 0; i < result.digits_.size(); ++i) {
    const int position = lowest + static_cast<int>(i);
    std::int64_t digit =
        std::int64_t{larger.digitAt(position)} - smaller.digitAt(position) - borrow;
    borrow = digit < 0 ? 1 : 0;
    digit += borrow << kDigitBits;
    result.digits_[i] = static_cast<std::uint32_t>(digit);
  }
  result.trim();
  return result;
}

Dyadic operator+(const Dyadic& a, const Dyadic& b) {
  if (a.sign() == 0) return b;
  if (b.sign() == 0) return a;
  Dyadic result;
  if (a.isNegative_ == b.isNegative_) {
    result = Dyadic::sumOfSizes(a, b);
    result.isNegative_ = a.isNegative_;
  } else {
    const bool bIsLarger = Dyadic::isSmaller(a, b);
    const Dyadic& larger = bIsLarger ? b : a;
    result = Dyadic::differenceOfSizes(larger, bIsLarger ? a : b);
    if (result.digits_.size() > 0) result.isNegative_ = larger.isNegative_;
  }
  return result;
}

Dyadic operator*(const Dyadic& a, const Dyadic& b) {
  if (a.sign() == 0 || b.sign() == 0) return {};
  Dyadic result;
  result.clear(a.lowest_ + b.lowest_, a.end() + b.end());
  const std::size_t sizeA = a.digits_.size();
  const std::size_t sizeB = b.digits_.size();
  const std::uint32_t* digitsB = b.digits_.data();
  for (std::size_t i = 0; i < sizeA; ++i) {
    std::uint32_t* sum = result.digits_.data() + i;
    std::uint64_t carry = 0;
    const std::uint64_t digit = a.digits_[i];
    for (std::size_t j = 0; j < sizeB; ++j) {
      carry += digit * digitsB[j] + sum[j];
      sum[j] = static_cast<std::uint32_t>(carry);
      carry >>= kDigitBits;
    }
    sum[sizeB] = static_cast<std::uint32_t>(carry);
  }
  result.isNegative_ = a.isNegative_ != b.isNegative_;
  result.trim();
  return result;
}

double Dyadic::toDoubleAt(int shift) const {
  if (sign() == 0) return 0.0;
  const int top = end() - 1;
  const std::uint64_t leading = std::uint64_t{digitAt(top)} << kDigitBits | digitAt(top - 1);
  // Two digits hold at least 33 bits; the third completes a double. If a double can hold the
  // number, both conversions and the sum are exact.
  const double value =
      static_cast<double>(leading) + static_cast<double>(digitAt(top - 2)) * 0x1p-32;
  const double scaled = std::ldexp(value, (top - 1 + shift) * kDigitBits);
  return isNegative_ ? -scaled : scaled;
}

double quotient(const Dyadic& a, const Dyadic& b) {
  return a.toDoubleAt(-b.end()) / b.toDoubleAt(-b.end());
}

DyadicVec3 toDyadic(const Vec3& v) { return {Dyadic(v.x), Dyadic(v.y), Dyadic(v.z)}; }

DyadicVec3 operator+(const DyadicVec3& a, const DyadicVec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
DyadicVec3 operator-(const DyadicVec3& a, const DyadicVec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
DyadicVec3 operator*(const DyadicVec3& a, const Dyadic& factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}
Dyadic dot(const DyadicVec3& a, const DyadicVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
DyadicVec3 cross(const DyadicVec3& a, const DyadicVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Dyadic determinant(const DyadicVec3& a, const DyadicVec3& b, const DyadicVec3& c,
                   const DyadicVec3& d) {
  return dot(cross(b - a, c - a), d - a);
}

}  // namespace tetrafront
