#pragma once

/// @file An order of places along a Morton curve: neighbours in it are mostly neighbours in space.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Sorts places along the curve in slices: a radix sort, O(n).
class MortonSort {
 public:
  /// The places must outlive this; they may still be filled in until advance() is called.
  explicit MortonSort(std::span<const Vec3> places) : places_(places) {}

  /// Goes on for `budget` of the places, each of which is come to eleven times; true when finished.
  bool advance(std::size_t budget);

  /// Positions in the places along the curve, as of mortonOrder(); once, when finished.
  [[nodiscard]] std::vector<std::uint32_t> take() { return std::move(order_); }

 private:
  static constexpr unsigned kBitsPerAxis = 20;
  static constexpr unsigned kDigitBits = 8;
  static constexpr unsigned kPasses = (3 * kBitsPerAxis + kDigitBits - 1) / kDigitBits;
  static constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

  enum class Stage : std::uint8_t { kBound, kCode, kSort, kName, kDone };
  struct Key {
    std::uint64_t code;
    std::uint32_t position;
  };

  void bound(std::size_t first, std::size_t last);
  void code(std::size_t first, std::size_t last);
  void sort(std::size_t first, std::size_t last);
  void endStage();
  [[nodiscard]] static std::size_t digitOf(const Key& key, unsigned pass) {
    return (key.code >> (kDigitBits * pass)) % kDigits;
  }

  std::span<const Vec3> places_;
  Stage stage_ = Stage::kBound;
  unsigned pass_ = 0;
  std::size_t next_ = 0;
  Vec3 lower_{std::numeric_limits<double>::max()};
  Vec3 upper_{-std::numeric_limits<double>::max()};
  std::vector<Key> keys_;
  std::vector<Key> sorted_;
  /// Per pass: how many keys have the digit before; later where the next one goes.
  std::array<std::array<std::uint32_t, kDigits + 1>, kPasses> begins_{};
  std::vector<std::uint32_t> order_;
};

/// Positions in `places` along the curve; places of one cell in the order of their positions.
/// O(n).
[[nodiscard]] std::vector<std::uint32_t> mortonOrder(std::span<const Vec3> places);

}  // namespace tetrafront
