/// @file Binds what a first mesh needs, for the module "engine": the preview of a model, the check of what a run is given, and the
/// runs, which fill models and surfaces.

#include "run_bindings.h"
#include "tetrafront/preview.h"
#include "tetrafront/run_check.h"
#include "tetrafront/tile_host.h"

namespace tetrafront::border {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint32_t waitingTilesOf(Run& run) {
  return run.call(std::uint32_t{0}, [](MeshRun& mesh) { return TileHost(mesh).waitingCount(); });
}

bool waitsForTiles(Run& run) {
  return run.call(false, [](MeshRun& mesh) { return TileHost(mesh).isWaiting(); });
}

Bytes tileStepsOf(MeshRun& mesh) { return TileHost(mesh).steps(); }
LentTile lentTileOf(MeshRun& mesh) { return TileHost(mesh).lend(); }

bool returnTile(Run& run, std::uint32_t id, const Js<TileMesh>& result) {
  return run.call(true, [&](MeshRun& mesh) { return TileHost(mesh).giveBack(id, result.value()); });
}

void withdrawTile(Run& run, std::uint32_t id) {
  run.call(0, [&](MeshRun& mesh) { return TileHost(mesh).withdraw(id), 0; });
}

using GuardedOptimizer = Guarded<TileOptimizer>;

void beginTile(GuardedOptimizer& optimizer, const Js<TileMesh>& tile) {
  optimizer.call(0, [&](TileOptimizer& object) { return object.begin(tile.value()), 0; });
}

}  // namespace
}  // namespace tetrafront::border

EMSCRIPTEN_BINDINGS(engine) {
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerRuns<leaveAsIs>()
      .function("waitingTiles", &waitingTilesOf)
      .function("waitsForTiles", &waitsForTiles)
      .function("tileSteps", &Run::read<&tileStepsOf>)
      .function("lendTile", &Run::read<&lentTileOf>)
      .function("returnTile", &returnTile)
      .function("withdrawTile", &withdrawTile);
  emscripten::class_<GuardedOptimizer>("TileOptimizer")
      .function("begin", &beginTile)
      .function("advance", &advanceTool<TileOptimizer>)
      .function("result", &GuardedOptimizer::read<&TileOptimizer::result>)
      .function("failure", &GuardedOptimizer::failure)
      .function("failureMessage", &GuardedOptimizer::failureMessage);
  emscripten::function("tileOptimizer", &makeTool<TileOptimizer, Bytes>,
                       emscripten::allow_raw_pointers());
  registerTypes<Bytes, TileMesh, LentTile>();
  registerTypes<bool, ModelPreview, RunCheck>();
  registerTool<ModelPreviewer, Model, BackgroundGrid, MeshOptions, bool>("Preview", "previewModel");
  registerTool<RunChecker, Model, BodySurfaces, BackgroundGrid, MeshOptions>("RunCheck",
                                                                             "checkRun");
}
