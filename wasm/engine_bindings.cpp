/// @file Binds the runs, which fill models and surfaces, and the improvement of meshes, which needs the same optimizer, for
/// the module "engine".

#include <cstdint>
#include <new>
#include <string>
#include <vector>

#include "bindings.h"
#include "tetrafront/mesh_improvement.h"
#include "tetrafront/mesher.h"

namespace tetrafront::border {
namespace {

/// Returns sixteen hexadecimal digits: a JavaScript number cannot hold 64 bits exactly.
std::string toHex(std::uint64_t value) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4) {
    *digit = kDigits[value & 15];
  }
  return text;
}

using Run = Guarded<MeshRun>;

std::uint32_t advanceRun(Run& run, std::uint32_t budget) {
  const MeshStatus status =
      run.call(MeshStatus::kInvalidInput, [&](MeshRun& mesh) { return mesh.advance(budget); });
  return static_cast<std::uint32_t>(status);
}

void cancelRun(Run& run) {
  run.call(0, [](MeshRun& mesh) { return mesh.cancel(), 0; });
}

/// Returns the phase alone, which costs far less than the whole progress.
std::uint32_t phaseOf(Run& run) {
  const Phase phase = run.call(Phase::kCheck, [](MeshRun& mesh) { return mesh.progress().phase; });
  return static_cast<std::uint32_t>(phase);
}

bool hasFoundNothingBetter(Run& run) {
  return run.call(false, [](MeshRun& mesh) { return mesh.hasFoundNothingBetter(); });
}

std::string fingerprintOf(Run& run) {
  return run.call(std::string(), [](MeshRun& mesh) { return toHex(mesh.fingerprint()); });
}

// The following functions return raw pointers, which embind transfers to JavaScript; call delete() there to destroy the
// object. They copy and convert their arguments while exceptions are caught.

Run* meshModel(const Js<Model>& model, const Js<BackgroundGrid>& grid,
               const Js<MeshOptions>& options) {
  return new (std::nothrow)
      Run([&] { return MeshRun(model.value(), grid.value(), options.value()); });
}

Run* meshWithBodies(const Js<Model>& model, const Js<BodySurfaces>& bodies,
                    const Js<BackgroundGrid>& grid, const Js<MeshOptions>& options) {
  return new (std::nothrow)
      Run([&] { return MeshRun(model.value(), bodies.value(), grid.value(), options.value()); });
}

Run* fillSurface(const Js<Doubles>& points, const Js<Indices>& triangles,
                 const Js<GivenRegions>& regions, const Js<BackgroundGrid>& grid,
                 const Js<MeshOptions>& options) {
  return new (std::nothrow) Run([&] {
    return MeshRun(points.value(), triangles.value(), regions.value(), grid.value(),
                   options.value());
  });
}

}  // namespace
}  // namespace tetrafront::border

EMSCRIPTEN_BINDINGS(engine) {
  using namespace emscripten;
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerTypes<Doubles, Indices, Optimization, Model, BodySurfaces, GivenRegions, BackgroundGrid,
                MeshOptions>();
  registerTypes<Progress, std::vector<Diagnostic>, SurfaceMesh, VolumeMesh, QualitySummary,
                QualityStatistics, MetricShapes, std::vector<PatchSummary>, RecoverySummary,
                FrontCounters, MeshImprovement>();

  class_<Run>("Run")
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
      .function("fingerprint", &fingerprintOf)
      .function("failure", &Run::failure)
      .function("failureMessage", &Run::failureMessage);
  function("meshModel", &meshModel, allow_raw_pointers());
  function("meshWithBodies", &meshWithBodies, allow_raw_pointers());
  function("fillSurface", &fillSurface, allow_raw_pointers());
  registerTool<MeshImprover, Doubles, Indices, Indices, Indices, Optimization>("Improvement",
                                                                               "improveMesh");
  function("memoryBytes", &memoryBytes);
}
