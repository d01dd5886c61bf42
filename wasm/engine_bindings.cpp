/// @file Binds what needs the code of a run, for the module "engine": the runs, which fill models and surfaces, the check of what
/// they are given, and the improvement of meshes.

#include "run_bindings.h"
#include "tetrafront/mesh_improvement.h"
#include "tetrafront/run_check.h"

EMSCRIPTEN_BINDINGS(engine) {
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerRuns<leaveAsIs>();
  registerTypes<MeshImprovement, ImproveOptions, RunCheck>();
  registerTool<MeshImprover, Doubles, Indices, Indices, Indices, ImproveOptions>("Improvement",
                                                                                 "improveMesh");
  registerTool<RunChecker, Model, BodySurfaces, BackgroundGrid, MeshOptions>("RunCheck",
                                                                             "checkRun");
}
