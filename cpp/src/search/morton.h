#pragma once

/// @file Orders positions along a Morton curve: neighbours in this order are mostly neighbours in
/// space.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Sorts positions along the curve in slices: a radix sort, O(n).
class MortonSort {
 public:
  /// `positions` must outlive this, and may be filled until the first call of advance().
  explicit MortonSort(std::span<const Vec3> positions) : positions_(positions) {}

  /// Visits `budget` positions, each eleven times in total; returns true when finished.
  bool advance(std::size_t budget);

  /// Returns the indices of the positions in the order of the curve, as mortonOrder(); once, when
  /// finished.
  [[nodiscard]] std::vector<std::uint32_t> take() { return std::move(order_); }

 private:
  static constexpr unsigned kBitsPerAxis = 20;
  static constexpr unsigned kDigitBits = 8;
  static constexpr unsigned kPasses = (3 * kBitsPerAxis + kDigitBits - 1) / kDigitBits;
  static constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

  enum class Stage : std::uint8_t { kBound, kCode, kSort, kName, kDone };
  struct Key {
    std::uint64_t code;
    std::uint32_t index;  ///< of the position
  };

  void bound(std::size_t first, std::size_t last);
  void code(std::size_t first, std::size_t last);
  void sort(std::size_t first, std::size_t last);
  void endStage();
  [[nodiscard]] static std::size_t digitOf(const Key& key, unsigned pass) {
    return (key.code >> (kDigitBits * pass)) % kDigits;
  }

  std::span<const Vec3> positions_;
  Stage stage_ = Stage::kBound;
  unsigned pass_ = 0;
  std::size_t next_ = 0;
  Vec3 lower_{std::numeric_limits<double>::max()};
  Vec3 upper_{-std::numeric_limits<double>::max()};
  std::vector<Key> keys_;
  std::vector<Key> sorted_;
  /// Per pass and digit: number of keys with the digit before; later, the index of the next key.
  std::array<std::array<std::uint32_t, kDigits + 1>, kPasses> begins_{};
  std::vector<std::uint32_t> order_;
};

/// Returns the indices of `positions` in the order of the curve; positions in one cell keep their
/// order. O(n).
[[nodiscard]] std::vector<std::uint32_t> mortonOrder(std::span<const Vec3> positions);

}  // namespace tetrafront
