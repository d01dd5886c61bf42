/// @file Binds the runs, which fill models and surfaces, and the improvement of meshes, which needs the same optimizer, for
/// the module "engine".

#include "run_bindings.h"
#include "tetrafront/mesh_improvement.h"

EMSCRIPTEN_BINDINGS(engine) {
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerRuns<leaveAsIs>();
  registerTypes<MeshImprovement, ImproveOptions>();
  registerTool<MeshImprover, Doubles, Indices, Indices, Indices, ImproveOptions>("Improvement",
                                                                                 "improveMesh");
}
