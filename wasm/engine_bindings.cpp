/// @file Binds what a first mesh needs, for the module "engine": the preview of a model, the check of what a run is given, the runs,
/// which fill models and surfaces, and the improvement of meshes, which has their code.

#include "run_bindings.h"
#include "tetrafront/mesh_improvement.h"
#include "tetrafront/preview.h"
#include "tetrafront/run_check.h"

EMSCRIPTEN_BINDINGS(engine) {
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerRuns<leaveAsIs>();
  registerTypes<bool, ImproveOptions, MeshImprovement, ModelPreview, RunCheck>();
  registerTool<ModelPreviewer, Model, BackgroundGrid, MeshOptions, bool>("Preview", "previewModel");
  registerTool<MeshImprover, Doubles, Indices, Indices, Indices, ImproveOptions>("Improvement",
                                                                                 "improveMesh");
  registerTool<RunChecker, Model, BodySurfaces, BackgroundGrid, MeshOptions>("RunCheck",
                                                                             "checkRun");
}
