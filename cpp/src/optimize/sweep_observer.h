#pragma once

/// @file What an optimizer reports about its sweeps, once per sweep. Without an observer a sweep costs one comparison more.

#include <cstdint>
#include <memory>

#include "base/trace_bytes.h"
#include "field/size_field.h"
#include "optimize/schedule.h"
#include "optimize/tet_complex.h"
#include "topology/region_meshes.h"

namespace tetrafront {

/// Virtual calls cost nothing here, because a sweep visits the whole mesh.
class SweepObserver {
 public:
  SweepObserver() = default;
  SweepObserver(const SweepObserver&) = delete;
  SweepObserver& operator=(const SweepObserver&) = delete;
  virtual ~SweepObserver() = default;

  /// The optimization begins. The meshes must keep their names of nodes until it ends.
  virtual void begun(const RegionMeshes& meshes, const SizeField& field) = 0;
  /// The first sweep over the next region begins.
  virtual void begunRegion(const TetComplex& mesh) = 0;
  /// A sweep has ended.
  virtual void swept(Sweep sweep, const TetComplex& mesh) = 0;
  /// The mesh of the region is kept for comparison.
  virtual void kept() = 0;
  /// The kept mesh is the result for this region.
  virtual void restored() = 0;
};

/// Makes the observer of a run. The bytes must outlive it.
using MakeSweepObserver = std::unique_ptr<SweepObserver> (*)(TraceBytes& bytes);

}  // namespace tetrafront
