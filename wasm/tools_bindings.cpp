/// @file Binds the tools, which work in slices and have one result each, for the module "tools".

#include <cstdint>
#include <new>
#include <vector>

#include "bindings.h"
#include "tetrafront/covering_grid.h"
#include "tetrafront/grid_from_mesh.h"
#include "tetrafront/mesh_inspection.h"
#include "tetrafront/preview.h"
#include "tetrafront/remesh.h"
#include "tetrafront/size_proposals.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront::border {
namespace {

/// Advances a tool; after a failure, it counts as finished.
template <class Tool>
bool advanceTool(Guarded<Tool>& tool, std::uint32_t budget) {
  return tool.call(true, [&](Tool& object) { return object.advance(budget); });
}

template <class Tool>
double fractionOf(Guarded<Tool>& tool) {
  return tool.call(1.0, [](Tool& object) { return object.fraction(); });
}

/// Returns a new tool, made from the values of its arguments; call delete() in JavaScript to destroy it.
template <class Tool, class... Arguments>
Guarded<Tool>* makeTool(const Js<Arguments>&... arguments) {
  return new (std::nothrow) Guarded<Tool>([&] { return Tool(arguments.value()...); });
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

EMSCRIPTEN_BINDINGS(tools) {
  using namespace emscripten;
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerTypes<Doubles, Indices, double, Model, VolumeMesh, BackgroundGrid, CoverShape,
                MeshOptions, InspectionOptions, RepairOptions, RemeshOptions, ProposalOptions>();
  registerTypes<SurfaceInspection, MeshInspection, SurfaceRepair, SurfaceRefinement, SurfaceRemesh,
                PatchSplit, ModelPreview, SizeProposal>();

  registerTool<SurfaceInspector, Doubles, Indices, InspectionOptions>("Inspection",
                                                                      "inspectSurface");
  registerTool<MeshInspector, Doubles, Indices, Indices>("VolumeInspection", "inspectMesh");
  registerTool<SurfaceRepairer, Doubles, Indices, RepairOptions>("Repair", "repairSurface");
  registerTool<SurfaceRefiner, Doubles, Indices, BackgroundGrid, MeshOptions, double>(
      "Refinement", "refineSurface");
  registerTool<PatchSplitter, Doubles, Indices, Indices, double>("PatchSplitting", "splitPatches");
  registerTool<SurfaceRemesher, Doubles, Indices, Indices, BackgroundGrid, RemeshOptions>(
      "Remesh", "remeshSurface");
  registerTool<ModelPreviewer, Model, BackgroundGrid, MeshOptions>("Preview", "previewModel");
  registerTool<CoveringGridBuilder, Model, double, CoverShape>("Cover", "cover");
  registerTool<SizeProposer, Model, ProposalOptions>("Proposal", "propose");
  registerTool<MeshGridBuilder, VolumeMesh, Doubles>("BackgroundFromMesh", "backgroundFromMesh");
  function("memoryBytes", &memoryBytes);
}
