#pragma once

/// @file Records the steps of the surface mesher for teaching, as a compile-time hook, as volume/trace.h does for the
/// front. With NullSurfaceTrace every call vanishes; the normal build has no branch for it.

#include "surface/surface_recorder.h"

namespace tetrafront {

struct NullSurfaceTrace {
  static constexpr bool kOn = false;
  struct Recorder {
    explicit Recorder(TraceBytes& /*bytes*/) {}
  };
  NullSurfaceTrace() = default;
  explicit NullSurfaceTrace(Recorder* /*recorder*/) {}
};

/// Passes every step to a recorder, which must outlive the mesher.
struct RecordingSurfaceTrace {
  static constexpr bool kOn = true;
  using Recorder = SurfaceRecorder;
  Recorder* recorder = nullptr;
};

}  // namespace tetrafront
