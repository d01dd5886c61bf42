#pragma once

/// @file Records the steps of the front for teaching, as a compile-time hook. With NullTrace every
/// call vanishes; the normal build has no branch for it.

#include <chrono>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Reason for refusing a candidate.
enum class Refusal : std::uint8_t {
  kBehind = 0,          ///< the candidate is not on the empty side of the base face
  kCrosses = 1,         ///< the element would cross a face
  kTooCloseToFace = 2,  ///< a new node would be too close to a face
};

/// A CrossingScope lives as long as one part of the crossing test. Only ClockTrace uses it.
struct NullTrace {
  static constexpr bool kOn = false;
  struct CrossingScope {
    explicit CrossingScope(NullTrace& /*trace*/) {}
  };
};

/// Time spent in the crossing test, for comparison with the paper's share (section 6).
struct ClockTrace {
  static constexpr bool kOn = false;
  using Clock = std::chrono::steady_clock;
  /// The test takes about a microsecond. A longer interval was interrupted by another process and
  /// is not counted.
  static constexpr std::chrono::microseconds kInterrupted{200};
  class CrossingScope {
   public:
    explicit CrossingScope(ClockTrace& trace) : trace_(trace), begin_(Clock::now()) {}
    ~CrossingScope() {
      const Clock::duration spent = Clock::now() - begin_;
      if (spent < kInterrupted) trace_.inCrossingTest += spent;
    }
    CrossingScope(const CrossingScope&) = delete;
    CrossingScope& operator=(const CrossingScope&) = delete;

   private:
    ClockTrace& trace_;
    Clock::time_point begin_;
  };
  Clock::duration inCrossingTest{0};
};

/// Records every step. A candidate without a node id is a new node: the ideal point or a point
/// below it.
struct StepTrace {
  static constexpr bool kOn = true;
  struct CrossingScope {
    explicit CrossingScope(StepTrace& /*trace*/) {}
  };

  enum class Event : std::uint8_t {
    kBase = 0,       ///< subject: face, detail: rule class
    kIdeal = 1,      ///< position: the ideal point
    kRefused = 2,    ///< subject: candidate, detail: Refusal, culprit: face
    kAccepted = 3,   ///< subject: node; position: of the node
    kPostponed = 4,  ///< subject: face, detail: its next rule class
  };
  struct Step {
    Event event;
    std::uint32_t subject;
    std::uint32_t detail;
    std::uint32_t culprit;
    Vec3 position;
  };
  std::vector<Step> steps;

  void base(FaceId face, std::uint32_t ruleClass) {
    steps.push_back({Event::kBase, face.value, ruleClass, 0, Vec3(0.0)});
  }
  void ideal(const Vec3& position) { steps.push_back({Event::kIdeal, 0, 0, 0, position}); }
  void refused(NodeId candidate, Refusal why, FaceId culprit) {
    steps.push_back({Event::kRefused, candidate.value, static_cast<std::uint32_t>(why),
                     culprit.value, Vec3(0.0)});
  }
  void accepted(NodeId node, const Vec3& position) {
    steps.push_back({Event::kAccepted, node.value, 0, 0, position});
  }
  void postponed(FaceId face, std::uint32_t ruleClass) {
    steps.push_back({Event::kPostponed, face.value, ruleClass, 0, Vec3(0.0)});
  }
};

}  // namespace tetrafront
