#include "tetrafront/surface_tools.h"

#include <utility>

#include "base/resumable.h"
#include "base/task.h"
#include "repair/surface_inspection.h"
#include "repair/surface_refinement.h"
#include "repair/surface_repair.h"

namespace tetrafront {
namespace {

SurfaceMesh copyOf(std::span<const double> points, std::span<const std::uint32_t> triangles) {
  SurfaceMesh mesh;
  mesh.points.assign(points.begin(), points.end());
  mesh.triangles.assign(triangles.begin(), triangles.end());
  return mesh;
}

/// A job on a copy of a given surface. Keeps the result.
template <class Result>
class SurfaceJob {
 public:
  /// `start(work, mesh)` returns the task.
  template <class Start>
  SurfaceJob(std::span<const double> points, std::span<const std::uint32_t> triangles,
             const Start& start)
      : mesh_(copyOf(points, triangles)),
        job_([this, &start](Work& work) { return start(work, mesh_); }) {}

  bool advance(std::uint32_t budget) {
    if (!isFinished_ && job_.advance(budget)) {
      result_ = job_.take();
      isFinished_ = true;
    }
    return isFinished_;
  }
  [[nodiscard]] double fraction() const { return job_.fraction(); }
  [[nodiscard]] const Result& result() const { return result_; }

 private:
  SurfaceMesh mesh_;
  Result result_;
  bool isFinished_ = false;
  Job<Result> job_;  ///< last, because it uses the mesh
};

}  // namespace

class SurfaceInspector::Impl : public SurfaceJob<SurfaceInspection> {
 public:
  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       const InspectionOptions& options)
      : SurfaceJob(points, triangles, [&options](Work& work, SurfaceMesh& mesh) {
          return inspectSurface(work, mesh, options);
        }) {}
};

SurfaceInspector::SurfaceInspector(std::span<const double> points,
                                   std::span<const std::uint32_t> triangles,
                                   const InspectionOptions& options)
    : impl_(std::make_unique<Impl>(points, triangles, options)) {}
SurfaceInspector::SurfaceInspector(SurfaceInspector&&) noexcept = default;
SurfaceInspector& SurfaceInspector::operator=(SurfaceInspector&&) noexcept = default;
SurfaceInspector::~SurfaceInspector() = default;

bool SurfaceInspector::advance(std::uint32_t budget) { return impl_->advance(budget); }
double SurfaceInspector::fraction() const { return impl_->fraction(); }
const SurfaceInspection& SurfaceInspector::result() const { return impl_->result(); }

class SurfaceRepairer::Impl : public SurfaceJob<SurfaceRepair> {
 public:
  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       const RepairOptions& options)
      : SurfaceJob(points, triangles, [&options](Work& work, SurfaceMesh& mesh) {
          return repairSurface(work, mesh, options);
        }) {}
};

SurfaceRepairer::SurfaceRepairer(std::span<const double> points,
                                 std::span<const std::uint32_t> triangles,
                                 const RepairOptions& options)
    : impl_(std::make_unique<Impl>(points, triangles, options)) {}
SurfaceRepairer::SurfaceRepairer(SurfaceRepairer&&) noexcept = default;
SurfaceRepairer& SurfaceRepairer::operator=(SurfaceRepairer&&) noexcept = default;
SurfaceRepairer::~SurfaceRepairer() = default;

bool SurfaceRepairer::advance(std::uint32_t budget) { return impl_->advance(budget); }
double SurfaceRepairer::fraction() const { return impl_->fraction(); }
const SurfaceRepair& SurfaceRepairer::result() const { return impl_->result(); }

SurfaceRepair repairSurface(std::span<const double> points,
                            std::span<const std::uint32_t> triangles,
                            const RepairOptions& options) {
  SurfaceRepairer repairer(points, triangles, options);
  finish(repairer);
  return repairer.result();
}

class SurfaceRefiner::Impl {
 public:
  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       BackgroundGrid grid, const MeshOptions& options, double volume)
      : grid_(std::move(grid)),
        options_(options),
        job_(points, triangles, [this, volume](Work& work, SurfaceMesh& mesh) {
          return refineSurface(work, mesh, grid_, options_, volume);
        }) {}

  bool advance(std::uint32_t budget) { return job_.advance(budget); }
  [[nodiscard]] double fraction() const { return job_.fraction(); }
  [[nodiscard]] const SurfaceRefinement& result() const { return job_.result(); }

 private:
  BackgroundGrid grid_;
  MeshOptions options_;
  SurfaceJob<SurfaceRefinement> job_;  ///< last, because it uses the other members
};

SurfaceRefiner::SurfaceRefiner(std::span<const double> points,
                               std::span<const std::uint32_t> triangles, BackgroundGrid grid,
                               const MeshOptions& options, double volume)
    : impl_(std::make_unique<Impl>(points, triangles, std::move(grid), options, volume)) {}
SurfaceRefiner::SurfaceRefiner(SurfaceRefiner&&) noexcept = default;
SurfaceRefiner& SurfaceRefiner::operator=(SurfaceRefiner&&) noexcept = default;
SurfaceRefiner::~SurfaceRefiner() = default;

bool SurfaceRefiner::advance(std::uint32_t budget) { return impl_->advance(budget); }
double SurfaceRefiner::fraction() const { return impl_->fraction(); }
const SurfaceRefinement& SurfaceRefiner::result() const { return impl_->result(); }

}  // namespace tetrafront
