#include "search/morton.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace tetrafront {
namespace {

constexpr unsigned kBitsPerAxis = 20;

/// Spreads the lowest 20 bits to every third bit.
std::uint64_t spreadBits(std::uint64_t v) {
  v = (v | (v << 32U)) & 0x001f00000000ffffU;
  v = (v | (v << 16U)) & 0x001f0000ff0000ffU;
  v = (v | (v << 8U)) & 0x100f00f00f00f00fU;
  v = (v | (v << 4U)) & 0x10c30c30c30c30c3U;
  return (v | (v << 2U)) & 0x1249249249249249U;
}

struct Key {
  std::uint64_t code;
  std::uint32_t position;
};

/// Digit by digit, the lowest first; equal codes stay in order.
void sortByCode(std::vector<Key>& keys) {
  constexpr std::uint32_t kDigitBits = 8;
  constexpr std::size_t kDigits = 1U << kDigitBits;
  std::vector<Key> sorted(keys.size());
  for (std::uint32_t shift = 0; shift < 3 * kBitsPerAxis; shift += kDigitBits) {
    const auto digitOf = [shift](const Key& key) { return (key.code >> shift) % kDigits; };
    std::array<std::uint32_t, kDigits + 1> begins{};
    for (const Key& key : keys) ++begins[digitOf(key) + 1];
    for (std::size_t digit = 1; digit < kDigits; ++digit) begins[digit] += begins[digit - 1];
    for (const Key& key : keys) sorted[begins[digitOf(key)]++] = key;
    keys.swap(sorted);
  }
}

}  // namespace

std::vector<std::uint32_t> mortonOrder(std::span<const Vec3> places) {
  Vec3 lower(std::numeric_limits<double>::max());
  Vec3 upper(-std::numeric_limits<double>::max());
  for (const Vec3& place : places) {
    for (int a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], place[a]);
      upper[a] = std::max(upper[a], place[a]);
    }
  }
  const double extent = std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z});
  const double cells = static_cast<double>((1U << kBitsPerAxis) - 1U);
  const double scale = extent > 0.0 ? cells / extent : 0.0;
  std::vector<Key> keys(places.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    std::uint64_t code = 0;
    for (int a = 0; a < 3; ++a) {
      const double cell = std::min((places[i][a] - lower[a]) * scale, cells);
      code |= spreadBits(static_cast<std::uint64_t>(cell)) << static_cast<unsigned>(a);
    }
    keys[i] = {code, i};
  }
  sortByCode(keys);
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].position;
  return order;
}

}  // namespace tetrafront
