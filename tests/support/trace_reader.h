#pragma once

/// @file Reads the events of a trace, independently of the code that writes them: docs/TRACE.md.

#include <cstdint>
#include <span>
#include <vector>

namespace tetrafront::testing {

/// The part of an event that tests compare. Fields that a kind does not have are 0.
struct TraceStep {
  enum Kind : std::uint8_t { kPass, kBase, kRefused, kAccepted, kPostponed, kChange, kEnd };
  Kind kind = kPass;
  std::uint32_t detail = 0;
  std::uint32_t face = 0;     ///< the base face
  std::uint32_t culprit = 0;  ///< the face that a refused candidate crosses or is too close to
};

/// Returns all events. Throws std::out_of_range if the bytes end within one.
std::vector<TraceStep> readTrace(std::span<const std::uint8_t> bytes);

}  // namespace tetrafront::testing
