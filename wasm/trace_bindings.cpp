/// @file Binds runs that record the steps of the front, for the module "trace".

#include "run_bindings.h"
#include "tetrafront/trace.h"

namespace tetrafront::border {
namespace {

void record(MeshRun& run) { recordFront(run); }

/// Before the first call of advance().
void experimentOn(Run& run, bool relaxation, double tolerance, bool linearSearch) {
  run.call(0, [&](MeshRun& mesh) {
    recordFront(mesh,
                {.relaxation = relaxation, .tolerance = tolerance, .linearSearch = linearSearch});
    return 0;
  });
}

std::string frontFingerprintOf(Run& run) {
  return run.call(std::string(), [](MeshRun& mesh) { return toHex(mesh.frontFingerprint()); });
}

double recordedStepsOf(Run& run) {
  return run.call(0.0, [](MeshRun& mesh) { return static_cast<double>(mesh.recordedSteps()); });
}

}  // namespace
}  // namespace tetrafront::border

EMSCRIPTEN_BINDINGS(trace) {
  using namespace tetrafront;
  using namespace tetrafront::border;

  registerTypes<std::vector<std::uint8_t>>();
  registerRuns<record>()
      .function("experiment", &experimentOn)
      .function("takeTrace", &Run::read<&MeshRun::takeTrace>)
      .function("frontFingerprint", &frontFingerprintOf)
      .function("recordedSteps", &recordedStepsOf);
}
