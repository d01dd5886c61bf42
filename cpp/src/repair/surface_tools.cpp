#include "tetrafront/surface_tools.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "base/resumable.h"
#include "base/task.h"
#include "base/tool_job.h"
#include "repair/patch_splitting.h"
#include "repair/surface_inspection.h"
#include "repair/surface_refinement.h"
#include "repair/surface_repair.h"

namespace tetrafront {
namespace {

SurfaceMesh copyOf(std::span<const double> points, std::span<const std::uint32_t> triangles,
                   std::span<const std::uint32_t> triangleRegions = {}) {
  SurfaceMesh mesh;
  mesh.triangleRegions.assign(triangleRegions.begin(), triangleRegions.end());
  mesh.points.assign(points.begin(), points.end());
  mesh.triangles.assign(triangles.begin(), triangles.end());
  return mesh;
}

struct RefinementInput {
  SurfaceMesh mesh;
  BackgroundGrid grid;
  MeshOptions options;
  RegionSizes regions;
};

struct SplitInput {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> groups;
  double angle;
};

}  // namespace

SurfaceInspector::SurfaceInspector(std::span<const double> points,
                                   std::span<const std::uint32_t> triangles,
                                   const InspectionOptions& options,
                                   std::span<const std::uint32_t> triangleRegions)
    : SlicedTool(makeToolJob<SurfaceInspection>(copyOf(points, triangles, triangleRegions),
                                                [&options](Work& work, SurfaceMesh& mesh) {
                                                  return inspectSurface(work, mesh, options);
                                                })) {}

SurfaceRepairer::SurfaceRepairer(std::span<const double> points,
                                 std::span<const std::uint32_t> triangles,
                                 const RepairOptions& options,
                                 std::span<const std::uint32_t> triangleRegions)
    : SlicedTool(makeToolJob<SurfaceRepair>(copyOf(points, triangles, triangleRegions),
                                            [&options](Work& work, SurfaceMesh& mesh) {
                                              return repairSurface(work, mesh, options);
                                            })) {}

SurfaceRepair repairSurface(std::span<const double> points,
                            std::span<const std::uint32_t> triangles, const RepairOptions& options,
                            std::span<const std::uint32_t> triangleRegions) {
  SurfaceRepairer repairer(points, triangles, options, triangleRegions);
  finish(repairer);
  return repairer.result();
}

SurfaceRefiner::SurfaceRefiner(std::span<const double> points,
                               std::span<const std::uint32_t> triangles, BackgroundGrid grid,
                               const MeshOptions& options, double volume,
                               const GivenRegions& regions)
    : SlicedTool(makeToolJob<SurfaceRefinement>(
          RefinementInput{copyOf(points, triangles), std::move(grid), options,
                          RegionSizes(regions)},
          [volume](Work& work, RefinementInput& input) {
            return refineSurface(work, input.mesh, input.grid, input.options, input.regions,
                                 volume);
          })) {}

PatchSplitter::PatchSplitter(std::span<const double> points,
                             std::span<const std::uint32_t> triangles,
                             std::span<const std::uint32_t> groups, double angle)
    : SlicedTool(makeToolJob<PatchSplit>(
          SplitInput{copyOf(points, triangles), {groups.begin(), groups.end()}, angle},
          [](Work& work, const SplitInput& input) {
            return splitPatches(work, input.mesh, input.groups, input.angle);
          })) {}

}  // namespace tetrafront
