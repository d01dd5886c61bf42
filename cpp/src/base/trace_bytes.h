#pragma once

/// @file The numbers of a trace (docs/TRACE.md), for the recorders of surfaces and of volumes.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Appends numbers to bytes, as docs/TRACE.md describes.
class TraceBytes {
 public:
  void byte(std::uint32_t value) { bytes_.push_back(static_cast<std::uint8_t>(value)); }
  void varint(std::uint64_t value);
  void zigzag(std::int64_t value);
  /// Writes `value` minus `from` as a signed integer.
  void difference(std::uint32_t value, std::uint32_t from) {
    zigzag(std::int64_t{value} - std::int64_t{from});
  }
  void number(double value);
  /// Writes eight bytes.
  void word(std::uint64_t bits);
  void shortNumber(double value);
  /// Writes the upper three bytes of a float, rounded: four to five digits.
  void shorterNumber(double value);
  void position(const Vec3& at);
  void offset(const Vec3& from, const Vec3& to);
  /// Writes a list of ascending indices: its length, then each minus the one before it.
  void indices(std::span<const std::uint32_t> ascending);
  /// Returns what was written since the last call.
  std::vector<std::uint8_t> take();

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace tetrafront
