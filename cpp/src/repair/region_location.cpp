#include "tetrafront/region_location.h"

#include <algorithm>
#include <utility>

#include "base/task.h"
#include "base/tool_job.h"
#include "boundary/boundary.h"
#include "boundary/ray_crossing.h"
#include "boundary/self_intersection.h"
#include "search/box_tree.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

struct LocationInput {
  SurfaceMesh mesh;
  std::vector<Vec3> positions;
};

/// Returns the volume around a position: a ray from it crosses the boundary of this volume, and of no other, an odd
/// number of times.
std::uint32_t volumeAround(const SurfaceMesh& mesh, const BoxTree& tree, const Vec3& position) {
  std::vector<std::uint32_t> crossed;
  bool isOnBoundary = false;
  tree.visitOverlaps(boxOfRay(position), [&](std::uint32_t item) {
    const TriangleId triangle(item);
    isOnBoundary = isOnBoundary || liesOn(mesh, position, triangle);
    if (!isAheadOf(mesh, position, triangle)) return;
    for (const HalfFaceId halfFace : {backOf(triangle), frontOf(triangle)}) {
      const std::uint32_t region = mesh.triangleRegions[halfFace.index()];
      if (region == SurfaceMesh::kNoRegion) continue;
      const auto known = std::ranges::find(crossed, region);
      if (known == crossed.end()) {
        crossed.push_back(region);
      } else {
        crossed.erase(known);
      }
    }
  });
  if (isOnBoundary) return RegionLocation::kOnBoundary;
  return crossed.empty() ? RegionLocation::kOutside : crossed.front();
}

Task<RegionLocation> locate(Work& work, LocationInput& input) {
  SurfaceMesh& mesh = input.mesh;
  RegionLocation result;
  work.beginPart(0.9);
  BoundaryCheck check(mesh, BoundarySource::kGivenSurface, InnerShells::kRegions);
  co_await work.finish(check);
  if (!check.result().isValid) {
    result.diagnostics = check.takeDiagnostics();
    co_return result;
  }
  work.beginPart(0.95);
  const BoxTree tree = co_await BoxTree::build(work, triangleBoxes(mesh), 1);
  work.beginPart(1.0);
  for (const Vec3& position : input.positions) {
    result.volumeOf.push_back(volumeAround(mesh, tree, position));
    co_await work.yield();
  }
  result.volumes = check.result().regionCount;
  result.triangles = std::move(mesh.triangles);
  result.triangleRegions = std::move(mesh.triangleRegions);
  co_return result;
}

LocationInput inputOf(std::span<const double> points, std::span<const std::uint32_t> triangles,
                      std::span<const double> positions) {
  LocationInput input;
  input.mesh.points.assign(points.begin(), points.end());
  input.mesh.triangles.assign(triangles.begin(), triangles.end());
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
    input.positions.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
  }
  return input;
}

}  // namespace

RegionLocator::RegionLocator(std::span<const double> points,
                             std::span<const std::uint32_t> triangles,
                             std::span<const double> positions)
    : SlicedTool(makeToolJob<RegionLocation>(
          inputOf(points, triangles, positions),
          [](Work& work, LocationInput& input) { return locate(work, input); })) {}

}  // namespace tetrafront
