#include "tetrafront/run_check.h"

#include <memory>
#include <utility>

#include "tetrafront/mesher.h"

namespace tetrafront {
namespace {

class CheckWork : public ToolWork<RunCheck> {
 public:
  explicit CheckWork(MeshRun run) : run_(std::move(run)) { run_.endBeforeFront(); }

  bool advance(std::uint32_t budget) override {
    const MeshStatus status = run_.advance(budget);
    if (status == MeshStatus::kRunning) return false;
    result_.isFillable = status == MeshStatus::kDone;
    result_.expectedTetrahedra = run_.progress().expectedTetrahedra;
    result_.trianglePatch = run_.surface().trianglePatch;
    result_.diagnostics = run_.diagnostics();
    return true;
  }
  [[nodiscard]] double fraction() const override { return run_.progress().fraction; }
  [[nodiscard]] const RunCheck& result() const override { return result_; }

 private:
  MeshRun run_;
  RunCheck result_;
};

MeshRun runOf(Model model, BodySurfaces bodies, BackgroundGrid grid, const MeshOptions& options) {
  if (bodies.triangles.empty()) return {std::move(model), std::move(grid), options};
  return {std::move(model), std::move(bodies), std::move(grid), options};
}

}  // namespace

RunChecker::RunChecker(Model model, BodySurfaces bodies, BackgroundGrid grid,
                       const MeshOptions& options)
    : SlicedTool(std::make_unique<CheckWork>(
          runOf(std::move(model), std::move(bodies), std::move(grid), options))) {}

}  // namespace tetrafront
