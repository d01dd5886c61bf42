#pragma once

/// @file What an optimizer reports about its sweeps, once per sweep. Without an observer a sweep costs one comparison more.

#include <cstdint>
#include <memory>

#include "base/trace_bytes.h"
#include "optimize/schedule.h"
#include "optimize/tet_complex.h"

namespace tetrafront {

/// Virtual calls cost nothing here, because a sweep visits the whole mesh.
class SweepObserver {
 public:
  SweepObserver() = default;
  SweepObserver(const SweepObserver&) = delete;
  SweepObserver& operator=(const SweepObserver&) = delete;
  virtual ~SweepObserver() = default;

  /// The first sweep begins.
  virtual void begun(const TetComplex& mesh) = 0;
  /// A sweep has ended.
  virtual void swept(Sweep sweep, const TetComplex& mesh) = 0;
  /// The mesh is kept for comparison.
  virtual void kept() = 0;
  /// The kept mesh is the result.
  virtual void restored() = 0;
};

/// Makes the observer of a run. The bytes must outlive it.
using MakeSweepObserver = std::unique_ptr<SweepObserver> (*)(TraceBytes& bytes);

}  // namespace tetrafront
