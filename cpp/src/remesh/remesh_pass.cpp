#include "remesh/remesh_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "base/mesh_access.h"
#include "boundary/surface_access.h"
#include "geom/angles.h"
#include "quality/metrics.h"
#include "remesh/deviation.h"
#include "remesh/guarded_surface.h"
#include "remesh/remesh_schedule.h"
#include "remesh/remesh_sizes.h"
#include "remesh/remesh_targets.h"
#include "remesh/surface_editor.h"
#include "remesh/volume_correction.h"
#include "sizing/target_sizes.h"

namespace tetrafront {
namespace {

/// Turn of a feature line, in degrees, at which it has a corner.
constexpr double kCornerDegrees = 50.0;

/// Copies the triangles out of the complex, without unused nodes.
void copyTriangles(const GuardedSurface& surface, const PassSurface& given, RemeshPass& pass) {
  const SurfaceComplex& complex = surface.complex();
  SurfaceRemesh& result = pass.remesh;
  std::vector<std::uint32_t> number(complex.nodeCount(), kNoIndex);
  for (const NodeId node : IdRange<NodeId>(complex.nodeCount())) {
    if (!complex.isUsed(node)) continue;
    number[node.index()] = static_cast<std::uint32_t>(result.points.size() / 3);
    const Vec3& point = complex.pointOf(node);
    result.points.insert(result.points.end(), {point.x, point.y, point.z});
  }
  SampledDeviation deviation(surface);
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    if (!complex.isAlive(t)) continue;
    for (const NodeId node : complex.nodesOf(t)) result.triangles.push_back(number[node.index()]);
    result.origin.push_back(given.origin[surface.beneath(t).index()]);
    result.triangleDeviation.push_back(deviation.of(t));
    pass.patches.push_back(complex.patchOf(t).value);
  }
}

void measureShapes(SurfaceRemesh& result) {
  SurfaceMesh mesh;
  std::swap(mesh.points, result.points);
  std::swap(mesh.triangles, result.triangles);
  double sum = 0.0;
  double largestCosine = 0.5;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const std::array<Vec3, 3> corners = cornersOf(mesh, t);
    sum += triangleRadiusRatio(corners[0], corners[1], corners[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 u = corners[(k + 1) % 3] - corners[k];
      const Vec3 v = corners[(k + 2) % 3] - corners[k];
      largestCosine = std::max(largestCosine, glm::dot(u, v) / (glm::length(u) * glm::length(v)));
    }
  }
  result.smallestAngle = degreesOf(largestCosine);
  result.meanRadiusRatio = sum / countTriangles(mesh);
  std::swap(mesh.points, result.points);
  std::swap(mesh.triangles, result.triangles);
}

Task<> makeChanges(Work& work, RemeshSchedule& schedule, VolumeCorrection& correction) {
  work.beginPart(0.95);
  co_await schedule.run(work);
  work.beginPart(1.0);
  co_await correction.run(work);
}

}  // namespace

FeatureRules featureRulesOf(const RemeshOptions& options) {
  return {cosineOfDegrees(options.featureAngle), cosineOfDegrees(kCornerDegrees)};
}

Task<RemeshPass> remeshOnce(Work& work, const PassSurface& surface, const BackgroundGrid& grid,
                            const RemeshOptions& options, double toleranceShare,
                            const bool& isStopped) {
  work.beginPart(0.05);
  RemeshPass pass;
  SurfaceRemesh& result = pass.remesh;
  ReferenceSurface reference(surface.mesh, surface.groups, featureRulesOf(options));
  co_await reference.prepare(work);
  const bool hasTargets = options.size > 0.0 || usesGrid(grid, targetOptions(options));
  const RemeshLengths lengths = remeshLengthsOf(options, hasTargets, reference.diagonal());

  work.beginPart(0.1);
  TargetField targets = co_await findTargetField(work, reference, grid, options, lengths);
  result.diagnostics = std::move(targets.diagnostics);
  if (!result.diagnostics.empty()) co_return pass;

  work.beginPart(0.9);
  SurfaceLimits limits;
  limits.tolerance = toleranceShare * lengths.testedTolerance;
  GuardedSurface guarded(reference, limits, lengths.maxSize);
  SurfaceEditor editor(guarded, *targets.sizes);
  co_await work.yield();
  RemeshSchedule schedule(editor);
  VolumeCorrection correction(guarded);
  Job<> changes([&](Work& inner) { return makeChanges(inner, schedule, correction); });
  bool isFinished = false;
  while (!isFinished && !isStopped) {
    isFinished = changes.advance(work.remaining());
    work.setFraction(changes.fraction());
    co_await work.yield();
  }

  work.beginPart(1.0);
  result.isPartial = !isFinished;
  copyTriangles(guarded, surface, pass);
  measureShapes(result);
  result.size = lengths.maxSize;
  result.minSize = lengths.minSize;
  result.tolerance = toleranceShare * lengths.tolerance;
  result.patches = static_cast<std::uint32_t>(reference.patchCount());
  result.featureLines = static_cast<std::uint32_t>(reference.lines().size());
  // In the other direction, every change has kept the tolerance.
  DeviationBound deviation(guarded, result.tolerance);
  co_await work.finish(deviation);
  result.deviation = deviation.bound();
  co_return pass;
}

}  // namespace tetrafront
