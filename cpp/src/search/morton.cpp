#include "search/morton.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/free_memory.h"

namespace tetrafront {
namespace {

constexpr unsigned kBitsPerAxis = 20;
constexpr unsigned kDigitBits = 8;
constexpr unsigned kSorts = (3 * kBitsPerAxis + kDigitBits - 1) / kDigitBits;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
/// Visits of each position: to find the box, to compute the codes, to sort, and to list the indices.
constexpr double kVisits = kSorts + 3;

struct Key {
  std::uint64_t code;
  std::uint32_t index;  ///< of the position

  [[nodiscard]] std::size_t digit(unsigned sort) const {
    return (code >> (kDigitBits * sort)) % kDigits;
  }
};

/// Spreads the lowest 20 bits to every third bit.
std::uint64_t spreadBits(std::uint64_t v) {
  v = (v | (v << 32U)) & 0x001f00000000ffffU;
  v = (v | (v << 16U)) & 0x001f0000ff0000ffU;
  v = (v | (v << 8U)) & 0x100f00f00f00f00fU;
  v = (v | (v << 4U)) & 0x10c30c30c30c30c3U;
  return (v | (v << 2U)) & 0x1249249249249249U;
}

/// The cells of a box through which the curve leads.
class CurveCells {
 public:
  CurveCells(const Vec3& lower, const Vec3& upper) : lower_(lower) {
    const double extent = std::max({upper.x - lower.x, upper.y - lower.y, upper.z - lower.z});
    scale_ = extent > 0.0 ? kLast / extent : 0.0;
  }

  [[nodiscard]] std::uint64_t codeOf(const Vec3& position) const {
    std::uint64_t code = 0;
    for (int a = 0; a < 3; ++a) {
      const double cell = std::min((position[a] - lower_[a]) * scale_, kLast);
      code |= spreadBits(static_cast<std::uint64_t>(cell)) << static_cast<unsigned>(a);
    }
    return code;
  }

 private:
  static constexpr double kLast = (1U << kBitsPerAxis) - 1U;

  Vec3 lower_;
  double scale_;
};

}  // namespace

Task<std::vector<std::uint32_t>> mortonOrder(Work& work, std::span<const Vec3> positions,
                                             std::size_t visitsPerUnit) {
  const std::size_t count = positions.size();
  Vec3 lower(std::numeric_limits<double>::max());
  Vec3 upper(-std::numeric_limits<double>::max());
  work.beginPart(1.0 / kVisits);
  co_await work.forEachId<std::size_t>(
      count,
      [&](std::size_t i) {
        lower = glm::min(lower, positions[i]);
        upper = glm::max(upper, positions[i]);
      },
      visitsPerUnit);

  const CurveCells cells(lower, upper);
  std::vector<Key> keys;
  keys.reserve(count);
  // Per sort and digit: number of keys with the digit before; later, the index of the next key.
  std::vector<std::array<std::uint32_t, kDigits + 1>> begins(kSorts);
  work.beginPart(2.0 / kVisits);
  co_await work.forEachId<std::size_t>(
      count,
      [&](std::size_t i) {
        keys.push_back({cells.codeOf(positions[i]), static_cast<std::uint32_t>(i)});
        for (unsigned sort = 0; sort < kSorts; ++sort) ++begins[sort][keys.back().digit(sort) + 1];
      },
      visitsPerUnit);
  for (auto& before : begins) {
    for (std::size_t digit = 1; digit < kDigits; ++digit) before[digit] += before[digit - 1];
  }

  // By one digit, the lowest first; keeps the order of equal ones.
  std::vector<Key> sorted(count);
  for (unsigned sort = 0; sort < kSorts; ++sort) {
    auto& next = begins[sort];
    work.beginPart((3.0 + sort) / kVisits);
    co_await work.forEachId<std::size_t>(
        count, [&](std::size_t i) { sorted[next[keys[i].digit(sort)]++] = keys[i]; },
        visitsPerUnit);
    keys.swap(sorted);
  }
  freeMemory(sorted);

  std::vector<std::uint32_t> order;
  order.reserve(count);
  work.beginPart(1.0);
  co_await work.forEachId<std::size_t>(
      count, [&](std::size_t i) { order.push_back(keys[i].index); }, visitsPerUnit);
  co_return order;
}

std::vector<std::uint32_t> mortonOrder(std::span<const Vec3> positions) {
  return Job([&](Work& work) { return mortonOrder(work, positions, 1); }).finish();
}

}  // namespace tetrafront
