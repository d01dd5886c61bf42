#pragma once

/// @file Records the steps of the front for teaching, as a compile-time hook. With NullTrace every
/// call vanishes; the normal build has no branch for it.

#include <chrono>

#include "tetrafront/experiment.h"
#include "volume/step_recorder.h"

namespace tetrafront {

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

/// Passes every step to a recorder, which must outlive the front. Its rules can be changed.
struct RecordingTrace {
  static constexpr bool kOn = true;
  struct CrossingScope {
    explicit CrossingScope(RecordingTrace& /*trace*/) {}
  };
  StepRecorder* recorder = nullptr;
  FrontExperiment experiment;
};

}  // namespace tetrafront
