/// @file Binds the engine to JavaScript; the only file that uses embind. It declares, converts and
/// forwards, and contains no logic of its own. No exception leaves it: a call that fails reports
/// the reason in failure() and returns an empty value; without memory for its object, it returns null.

#include <emscripten/bind.h>
#include <emscripten/heap.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "failure.h"
#include "js_types.h"
#include "js_values.h"
#include "tetrafront/covering_grid.h"
#include "tetrafront/grid_from_mesh.h"
#include "tetrafront/mesh_inspection.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"
#include "tetrafront/remesh.h"
#include "tetrafront/size_proposals.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront::border {
namespace {

using Doubles = std::vector<double>;
using Indices = std::vector<std::uint32_t>;

/// Returns sixteen hexadecimal digits: a JavaScript number cannot hold 64 bits exactly.
std::string toHex(std::uint64_t value) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value >>= 4) {
    *digit = kDigits[value & 15];
  }
  return text;
}

/// An object of the engine for JavaScript. Values are converted where exceptions are caught. After a failure, methods
/// return empty values.
template <class Object>
class Guarded {
 public:
  /// Calls `make` for the object.
  template <class Make>
  explicit Guarded(const Make& make) {
    guard_.run([&] { object_ = std::make_unique<Object>(make()); });
  }

  /// Returns the result of `work` with the object, or `otherwise` after a failure.
  template <class Result, class Work>
  Result call(Result otherwise, const Work& work) {
    if (!guard_.hasFailed()) guard_.run([&] { otherwise = work(*object_); });
    return otherwise;
  }

  /// Returns the result of a method of the object as a JavaScript value.
  template <auto kMethod>
  auto read() {
    using Result = std::remove_cvref_t<std::invoke_result_t<decltype(kMethod), Object&>>;
    const val result =
        call(val(), [](Object& object) { return toJs(std::invoke(kMethod, object)); });
    return Js<Result>(guard_.hasFailed() ? toJs(Result{}) : result);
  }

  /// Returns a Failure.
  [[nodiscard]] std::uint32_t failure() const {
    return static_cast<std::uint32_t>(guard_.failure());
  }
  [[nodiscard]] std::string failureMessage() const { return guard_.message(); }

 private:
  std::unique_ptr<Object> object_;
  FailureGuard guard_;
};

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

/// Advances a tool; after a failure, it counts as finished.
template <class Tool>
bool advanceTool(Guarded<Tool>& tool, std::uint32_t budget) {
  return tool.call(true, [&](Tool& object) { return object.advance(budget); });
}

template <class Tool>
double fractionOf(Guarded<Tool>& tool) {
  return tool.call(1.0, [](Tool& object) { return object.fraction(); });
}

// The following functions return raw pointers, which embind transfers to JavaScript; call delete() there to destroy the
// object. They copy and convert their arguments while exceptions are caught.

Run* meshModel(const Js<Model>& model, const Js<BackgroundGrid>& grid,
               const Js<MeshOptions>& options) {
  return new (std::nothrow)
      Run([&] { return MeshRun(model.value(), grid.value(), options.value()); });
}

Run* fillSurface(const Js<Doubles>& points, const Js<Indices>& triangles,
                 const Js<BackgroundGrid>& grid, const Js<MeshOptions>& options) {
  return new (std::nothrow) Run(
      [&] { return MeshRun(points.value(), triangles.value(), grid.value(), options.value()); });
}

/// Returns a new tool, made from the values of its arguments.
template <class Tool, class... Arguments>
Guarded<Tool>* makeTool(const Js<Arguments>&... arguments) {
  return new (std::nothrow) Guarded<Tool>([&] { return Tool(arguments.value()...); });
}

/// Returns the size of the engine's heap in bytes; it never shrinks.
double memoryBytes() { return static_cast<double>(emscripten_get_heap_size()); }

/// Registers the TypeScript types of values that cross the border.
template <class... T>
void registerTypes() {
  (emscripten::register_type<Js<T>>(kTypeScriptType<T>.data()), ...);
}

/// Registers a tool as a class and the function that makes one.
template <class Tool, class... Arguments>
void registerTool(const char* className, const char* functionName) {
  emscripten::class_<Guarded<Tool>>(className)
      .function("advance", &advanceTool<Tool>)
      .function("fraction", &fractionOf<Tool>)
      .function("result", &Guarded<Tool>::template read<&Tool::result>)
      .function("failure", &Guarded<Tool>::failure)
      .function("failureMessage", &Guarded<Tool>::failureMessage);
  emscripten::function(functionName, &makeTool<Tool, Arguments...>,
                       emscripten::allow_raw_pointers());
}

}  // namespace
}  // namespace tetrafront::border

EMSCRIPTEN_BINDINGS(tetrafront) {
  using namespace emscripten;
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerTypes<Doubles, Indices, Model, BackgroundGrid, MeshOptions, InspectionOptions,
                RepairOptions, RemeshOptions, ProposalOptions, double, CoverShape>();
  registerTypes<Progress, std::vector<Diagnostic>, SurfaceMesh, VolumeMesh, QualitySummary,
                QualityStatistics, MetricShapes, std::vector<PatchSummary>, RecoverySummary,
                FrontCounters>();
  registerTypes<SurfaceInspection, MeshInspection, SurfaceRepair, SurfaceRefinement, SurfaceRemesh,
                ModelPreview, SizeProposal>();

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
  function("fillSurface", &fillSurface, allow_raw_pointers());

  registerTool<SurfaceInspector, Doubles, Indices, InspectionOptions>("Inspection",
                                                                      "inspectSurface");
  registerTool<MeshInspector, Doubles, Indices, Indices>("VolumeInspection", "inspectMesh");
  registerTool<SurfaceRepairer, Doubles, Indices, RepairOptions>("Repair", "repairSurface");
  registerTool<SurfaceRefiner, Doubles, Indices, BackgroundGrid, MeshOptions, double>(
      "Refinement", "refineSurface");
  registerTool<SurfaceRemesher, Doubles, Indices, Indices, BackgroundGrid, RemeshOptions>(
      "Remesh", "remeshSurface");
  registerTool<ModelPreviewer, Model, BackgroundGrid, MeshOptions>("Preview", "previewModel");
  registerTool<CoveringGridBuilder, Model, double, CoverShape>("Cover", "cover");
  registerTool<SizeProposer, Model, ProposalOptions>("Proposal", "propose");
  registerTool<MeshGridBuilder, VolumeMesh, Doubles>("BackgroundFromMesh", "backgroundFromMesh");

  function("memoryBytes", &memoryBytes);
}
