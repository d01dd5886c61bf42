#pragma once

/// @file The bindings of runs, which fill models and surfaces: the module "engine" and the module "trace" have them.

#include <cstdint>
#include <new>
#include <string>
#include <vector>

#include "bindings.h"
#include "tetrafront/mesher.h"

namespace tetrafront::border {

/// Returns sixteen hexadecimal digits: a JavaScript number cannot hold 64 bits exactly.
inline std::string toHex(std::uint64_t value) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4) {
    *digit = kDigits[value & 15];
  }
  return text;
}

using Run = Guarded<MeshRun>;

inline std::uint32_t advanceRun(Run& run, std::uint32_t budget) {
  const MeshStatus status =
      run.call(MeshStatus::kInvalidInput, [&](MeshRun& mesh) { return mesh.advance(budget); });
  return static_cast<std::uint32_t>(status);
}

inline void cancelRun(Run& run) {
  run.call(0, [](MeshRun& mesh) { return mesh.cancel(), 0; });
}

/// Returns the phase alone, which costs far less than the whole progress.
inline std::uint32_t phaseOf(Run& run) {
  const Phase phase = run.call(Phase::kCheck, [](MeshRun& mesh) { return mesh.progress().phase; });
  return static_cast<std::uint32_t>(phase);
}

inline bool hasFoundNothingBetter(Run& run) {
  return run.call(false, [](MeshRun& mesh) { return mesh.hasFoundNothingBetter(); });
}

inline std::uint32_t latticeCountOf(Run& run) {
  return run.call(std::uint32_t{0}, [](MeshRun& mesh) { return mesh.latticeCount(); });
}

// Parts of the mesh after the end of the run.
inline std::uint32_t nodeCountOf(Run& run) {
  return run.call(std::uint32_t{0}, [](MeshRun& mesh) { return mesh.nodeCount(); });
}
inline std::uint32_t tetrahedronCountOf(Run& run) {
  return run.call(std::uint32_t{0}, [](MeshRun& mesh) { return mesh.tetrahedronCount(); });
}

inline std::string fingerprintOf(Run& run) {
  return run.call(std::string(), [](MeshRun& mesh) { return toHex(mesh.fingerprint()); });
}

/// What a module does to a run before it begins.
using PrepareRun = void (*)(MeshRun&);
inline void leaveAsIs(MeshRun& /*run*/) {}

template <PrepareRun kPrepare>
MeshRun prepared(MeshRun run) {
  kPrepare(run);
  return run;
}

// The following functions return raw pointers, which embind transfers to JavaScript; call delete() there to destroy the
// object. They copy and convert their arguments while exceptions are caught.

template <PrepareRun kPrepare>
Run* meshModel(const Js<Model>& model, const Js<BackgroundGrid>& grid,
               const Js<MeshOptions>& options) {
  return new (std::nothrow) Run(
      [&] { return prepared<kPrepare>(MeshRun(model.value(), grid.value(), options.value())); });
}

template <PrepareRun kPrepare>
Run* meshWithBodies(const Js<Model>& model, const Js<BodySurfaces>& bodies,
                    const Js<BackgroundGrid>& grid, const Js<MeshOptions>& options) {
  return new (std::nothrow) Run([&] {
    return prepared<kPrepare>(
        MeshRun(model.value(), bodies.value(), grid.value(), options.value()));
  });
}

template <PrepareRun kPrepare>
Run* fillSurface(const Js<Doubles>& points, const Js<Indices>& triangles,
                 const Js<GivenRegions>& regions, const Js<BackgroundGrid>& grid,
                 const Js<MeshOptions>& options) {
  return new (std::nothrow) Run([&] {
    return prepared<kPrepare>(
        MeshRun(points.value(), triangles.value(), regions.value(), grid.value(), options.value()));
  });
}

/// Registers the runs and what crosses the border with them. Returns the class, for more methods.
template <PrepareRun kPrepare>
emscripten::class_<Run> registerRuns() {
  using namespace emscripten;
  registerTypes<Doubles, Indices, Optimization, Interior, Model, BodySurfaces, GivenRegions,
                BackgroundGrid, MeshOptions>();
  registerTypes<Progress, std::vector<Diagnostic>, SurfaceMesh, VolumeMesh, QualitySummary,
                QualityStatistics, MetricShapes, std::vector<PatchSummary>, RecoverySummary,
                FrontCounters>();
  function("meshModel", &meshModel<kPrepare>, allow_raw_pointers());
  function("meshWithBodies", &meshWithBodies<kPrepare>, allow_raw_pointers());
  function("fillSurface", &fillSurface<kPrepare>, allow_raw_pointers());
  function("memoryBytes", &memoryBytes);
  return class_<Run>("Run")
      .function("advance", &advanceRun)
      .function("cancel", &cancelRun)
      .function("phase", &phaseOf)
      .function("progress", &Run::read<&MeshRun::progress>)
      .function("diagnostics", &Run::read<&MeshRun::diagnostics>)
      .function("surface", &Run::read<&MeshRun::surface>)
      .function("volume", &Run::read<&MeshRun::volume>)
      .function("front", &Run::read<&MeshRun::front>)
      .function("quality", &Run::read<&MeshRun::quality>)
      .function("statistics", &Run::read<&MeshRun::statistics>)
      .function("metricShapes", &Run::read<&MeshRun::metricShapes>)
      .function("patches", &Run::read<&MeshRun::patchSummaries>)
      .function("recovery", &Run::read<&MeshRun::recovery>)
      .function("counters", &Run::read<&MeshRun::counters>)
      .function("hasFoundNothingBetter", &hasFoundNothingBetter)
      .function("latticeCount", &latticeCountOf)
      .function("nodeCount", &nodeCountOf)
      .function("tetrahedronCount", &tetrahedronCountOf)
      .function("points", &Run::read<&MeshRun::points, std::uint32_t, std::uint32_t>)
      .function("tetrahedra", &Run::read<&MeshRun::tetrahedra, std::uint32_t, std::uint32_t>)
      .function("regionRuns", &Run::read<&MeshRun::regionRuns>)
      .function("fingerprint", &fingerprintOf)
      .function("failure", &Run::failure)
      .function("failureMessage", &Run::failureMessage);
}

}  // namespace tetrafront::border
