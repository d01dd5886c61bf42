#include "base/trace_bytes.h"

#include <bit>
#include <cstddef>
#include <utility>

namespace tetrafront {
namespace {

template <class Bits>
void appendBytes(std::vector<std::uint8_t>& bytes, Bits bits) {
  for (std::size_t byte = 0; byte < sizeof(Bits); ++byte) {
    bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * byte)));
  }
}

}  // namespace

void TraceBytes::varint(std::uint64_t value) {
  constexpr std::uint32_t kMore = 0x80;
  for (; value >= kMore; value >>= 7) byte(static_cast<std::uint32_t>(value & 0x7f) | kMore);
  byte(static_cast<std::uint32_t>(value));
}

void TraceBytes::zigzag(std::int64_t value) {
  const auto twice = static_cast<std::uint64_t>(value) << 1;
  varint(value < 0 ? ~twice : twice);
}

void TraceBytes::word(std::uint64_t bits) { appendBytes(bytes_, bits); }

void TraceBytes::number(double value) { word(std::bit_cast<std::uint64_t>(value)); }

void TraceBytes::shortNumber(double value) {
  appendBytes(bytes_, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

void TraceBytes::shorterNumber(double value) {
  constexpr std::uint32_t kHalf = 0x80;
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value)) + kHalf;
  for (const std::uint32_t shift : {8U, 16U, 24U}) byte(bits >> shift);
}

void TraceBytes::position(const Vec3& at) {
  for (int axis = 0; axis < 3; ++axis) number(at[axis]);
}

void TraceBytes::offset(const Vec3& from, const Vec3& to) {
  for (int axis = 0; axis < 3; ++axis) shortNumber(to[axis] - from[axis]);
}

void TraceBytes::indices(std::span<const std::uint32_t> ascending) {
  varint(ascending.size());
  std::uint32_t before = 0;
  for (const std::uint32_t index : ascending) {
    varint(index - before);
    before = index;
  }
}

std::vector<std::uint8_t> TraceBytes::take() { return std::exchange(bytes_, {}); }

}  // namespace tetrafront
