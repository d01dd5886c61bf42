#pragma once

/// @file What the surface mesher says of each of its steps, for teaching: compile-time hooks, all of them empty and inline in a
/// normal build, as in volume/trace.h. A recorded front may also have other rules.

#include <array>
#include <cstdint>

#include "surface/planar_rules.h"
#include "surface/surface_recorder.h"

namespace tetrafront {

/// Records nothing.
struct NullSurfaceTrace {
  struct Recorder {
    explicit Recorder(TraceBytes& /*bytes*/) {}
  };
  NullSurfaceTrace() = default;
  explicit NullSurfaceTrace(Recorder* /*recorder*/) {}
  const NullSurfaceTrace* operator->() const { return this; }
  static constexpr PlanarRules rules() { return {}; }

  // Events, as SurfaceRecorder writes them.
  void line(LineId /*line*/, const Curve& /*curve*/) const {}
  template <class Line>
  void station(const SideStep& /*step*/, double /*t*/, double /*lambda*/,
               const Line& /*curve*/) const {}
  void divided(const LineDivision& /*division*/) const {}
  void halved(LineId /*line*/, std::uint32_t /*side*/, const LineDivision& /*division*/) const {}
  void numbered(const DividedLines& /*lines*/) const {}
  void patch(PatchId /*patch*/, const PatchBoundary& /*boundary*/, bool /*isCurved*/,
             bool /*isRepeated*/) const {}
  void base(const SurfaceRecorder::BaseEdge& /*edge*/, const PlaneSample& /*sample*/) const {}
  void refused(PlanarNodeId /*node*/, PlanarRefusal /*why*/, std::uint32_t /*culprit*/) const {}
  void accepted(const PlanarMesh& /*mesh*/, PlanarNodeId /*apex*/, bool /*isNew*/,
                const std::array<SurfaceRecorder::EdgeChange, 2>& /*changes*/) const {}
  void postponed(std::uint32_t /*next*/) const {}
  void ended(const PlanarMesh& /*mesh*/, PlanarFrontEnd /*end*/) const {}
  void improved(const PlanarMesh& /*mesh*/) const {}
};

/// Passes every step to a recorder, which must outlive the mesher, and may change rules of the fronts.
struct RecordingSurfaceTrace {
  using Recorder = SurfaceRecorder;
  Recorder* recorder = nullptr;
  PlanarRules planarRules{};
  Recorder* operator->() const { return recorder; }
  [[nodiscard]] const PlanarRules& rules() const { return planarRules; }
};

}  // namespace tetrafront
