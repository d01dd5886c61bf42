#pragma once

/// @file What the front says of each of its steps, for teaching: compile-time hooks, all of them empty and inline in a normal
/// build.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "geom/box.h"
#include "tetrafront/experiment.h"
#include "volume/candidates.h"
#include "volume/ideal_point.h"
#include "volume/step_recorder.h"
#include "volume/unit_space.h"

namespace tetrafront {

/// Records nothing and changes no rule.
struct NullTrace {
  /// Lives as long as one part of the crossing test.
  struct CrossingScope {
    explicit CrossingScope(NullTrace& /*trace*/) {}
  };

  // Rules that an experiment may change.
  [[nodiscard]] bool allowsRelaxation(bool byDefault) const { return byDefault; }
  [[nodiscard]] double faceDistance(double byDefault) const { return byDefault; }
  /// Returns the number of faces that a linear search has found.
  [[nodiscard]] std::uint64_t searchLinearly(const Front& /*front*/, const Box& /*box*/) const {
    return 0;
  }

  // Events, as StepRecorder writes them.
  void beginPass(const Front& /*front*/, const NodeNames& /*names*/) {}
  void endPass() {}
  void base(const Front& /*front*/, FaceId /*face*/, const UnitSpace& /*space*/,
            const IdealPoint& /*ideal*/, std::size_t /*facesNear*/, std::size_t /*candidates*/) {}
  void refused(const Front& /*front*/, NodeId /*node*/, const UnitSpace& /*space*/,
               const Candidate& /*candidate*/, Refusal /*why*/, FaceId /*culprit*/) {}
  void accepted(const Front& /*front*/, const FrontFace& /*base*/, NodeId /*apex*/,
                const Candidate& /*candidate*/, const std::array<FaceId, 3>& /*existing*/,
                const std::array<FaceId, 3>& /*added*/) {}
  void postponed(bool /*comesAgain*/, std::uint32_t /*ruleClass*/) {}
  void changed(const Front& /*front*/, const Elements& /*elements*/, FrontChange /*what*/) {}
};

/// Measures the time spent in the crossing test, for comparison with the paper's share (section 6).
struct ClockTrace : NullTrace {
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
class RecordingTrace {
 public:
  struct CrossingScope {
    explicit CrossingScope(RecordingTrace& /*trace*/) {}
  };
  explicit RecordingTrace(StepRecorder& recorder, const FrontExperiment& experiment = {})
      : recorder_(&recorder), experiment_(experiment) {}

  [[nodiscard]] bool allowsRelaxation(bool byDefault) const {
    return byDefault && experiment_.relaxation;
  }
  [[nodiscard]] double faceDistance(double byDefault) const {
    return byDefault * experiment_.tolerance;
  }
  /// Compares the box with those of all faces.
  [[nodiscard]] std::uint64_t searchLinearly(const Front& front, const Box& box) const;

  void beginPass(const Front& front, const NodeNames& names) { recorder_->beginPass(front, names); }
  void endPass() { recorder_->endPass(); }
  void base(const Front& front, FaceId face, const UnitSpace& space, const IdealPoint& ideal,
            std::size_t facesNear, std::size_t candidates) {
    recorder_->base(front, face, space, space.toSpace(ideal.position), facesNear, candidates);
  }
  void refused(const Front& front, NodeId node, const UnitSpace& space, const Candidate& candidate,
               Refusal why, FaceId culprit) {
    recorder_->refused(front, node, space.toSpace(candidate.unitPosition), candidate, why, culprit);
  }
  void accepted(const Front& front, const FrontFace& base, NodeId apex, const Candidate& candidate,
                const std::array<FaceId, 3>& existing, const std::array<FaceId, 3>& added) {
    recorder_->accepted(front, base.nodes, apex, candidate, existing, added, base.region);
  }
  void postponed(bool comesAgain, std::uint32_t ruleClass) {
    recorder_->postponed(comesAgain ? ruleClass : StepRecorder::kNoNextClass);
  }
  void changed(const Front& front, const Elements& elements, FrontChange what) {
    recorder_->changed(front, elements, what);
  }

 private:
  StepRecorder* recorder_;
  FrontExperiment experiment_;
};

}  // namespace tetrafront
