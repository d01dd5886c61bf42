#pragma once

/// @file FNV-1a hash over 64-bit words: equal on all platforms for equal bits.

#include <bit>
#include <cstdint>
#include <span>

namespace tetrafront {

class Fingerprint {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      hash_ ^= (word >> (8 * byte)) & 0xffU;
      hash_ *= kPrime;
    }
  }
  void add(std::span<const double> values) {
    // -0.0 and 0.0 are the same coordinate.
    for (const double value : values) add(std::bit_cast<std::uint64_t>(value + 0.0));
  }
  void add(std::span<const std::uint32_t> values) {
    for (const std::uint32_t value : values) add(std::uint64_t{value});
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3U;
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace tetrafront
