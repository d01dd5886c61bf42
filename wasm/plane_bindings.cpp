/// @file Binds the fill of a polygon, for the module "plane", which pages run in their own thread.

#include "bindings.h"
#include "tetrafront/plane_fill.h"

namespace tetrafront::border {
namespace {

using Filled = Guarded<PlaneFill>;

Filled* fill(const Js<Doubles>& points, const Js<Indices>& loops, const Js<BackgroundGrid>& grid,
             const Js<PlaneOptions>& options, const Js<FrontExperiment>& experiment) {
  return new (std::nothrow) Filled([&] {
    return fillPlane(points.value(), loops.value(), grid.value(), options.value(),
                     experiment.value());
  });
}

const PlaneFill& whole(const PlaneFill& fill) { return fill; }

}  // namespace
}  // namespace tetrafront::border

EMSCRIPTEN_BINDINGS(plane) {
  using namespace emscripten;
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerTypes<Doubles, Indices, BackgroundGrid, PlaneOptions, FrontExperiment, PlaneFill>();
  class_<Filled>("Filled")
      .function("result", &Filled::read<&whole>)
      .function("failure", &Filled::failure)
      .function("failureMessage", &Filled::failureMessage);
  function("fillPlane", &fill, allow_raw_pointers());
  function("memoryBytes", &memoryBytes);
}
