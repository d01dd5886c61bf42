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
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    if (!complex.isAlive(t)) continue;
    for (const NodeId node : complex.nodesOf(t)) result.triangles.push_back(number[node.index()]);
    result.origin.push_back(given.origin[surface.beneath(t).index()]);
    pass.patches.push_back(complex.patchOf(t).value);
  }
}

/// Copies the surface for a result that was stopped before the first change.
void copyGiven(const PassSurface& given, SurfaceRemesh& result) {
  result.isPartial = true;
  result.points = given.mesh.points;
  result.triangles = given.mesh.triangles;
  result.origin = given.origin;
  result.deviation = result.tolerance;
}

/// Bounds the distance between the surfaces, and samples that of the triangles in the order in which copyTriangles() copies
/// them.
Task<> measure(Work& work, const GuardedSurface& surface, SurfaceRemesh& result) {
  work.beginPart(0.3);
  DeviationBound bound(surface, result.tolerance);
  co_await work.finish(bound);
  result.deviation = bound.bound();
  work.beginPart(1.0);
  SampledDeviation deviation(surface);
  const SurfaceComplex& complex = surface.complex();
  co_await work.forEachBlock(complex.triangleSlots(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      if (!complex.isAlive(TriangleId(t))) continue;
      result.triangleDeviation.push_back(deviation.of(TriangleId(t)));
    }
  });
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

/// Does a job in the slices of another one; returns false if it was stopped.
template <class T>
Task<bool> finishUnlessStopped(Work& work, Job<T>& job, const bool& isStopped) {
  while (!isStopped) {
    const bool isFinished = job.advance(work.remaining());
    work.setFraction(job.fraction());
    co_await work.yield();
    if (isFinished) co_return true;
  }
  co_return false;
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

Task<RemeshPass> remeshOnce(Work& work, const PassSurface& surface, const GivenSizes& sizes,
                            const RemeshOptions& options, double toleranceShare,
                            const bool& isStopped) {
  work.beginPart(0.05);
  RemeshPass pass;
  SurfaceRemesh& result = pass.remesh;
  ReferenceSurface reference(surface.mesh, surface.groups, featureRulesOf(options));
  co_await reference.prepare(work);
  const bool hasTargets = options.size > 0.0 || usesGrid(sizes.grid, targetOptions(options));
  const RemeshLengths lengths = remeshLengthsOf(options, hasTargets, reference.diagonal());
  result.size = lengths.maxSize;
  result.minSize = std::min(lengths.minSize, sizes.ofRegions.smallest());
  result.tolerance = toleranceShare * lengths.tolerance;
  result.patches = static_cast<std::uint32_t>(reference.patchCount());
  result.featureLines = static_cast<std::uint32_t>(reference.lines().size());

  work.beginPart(0.1);
  Job<TargetField> finding([&](Work& inner) {
    return findTargetField(inner, reference, surface.origin, sizes, options, lengths);
  });
  const bool areFound = co_await finishUnlessStopped(work, finding, isStopped);
  if (!areFound) {
    copyGiven(surface, result);
    measureShapes(result);
    co_return pass;
  }
  TargetField targets = finding.take();
  result.diagnostics = std::move(targets.diagnostics);
  if (!result.diagnostics.empty()) co_return pass;

  work.beginPart(0.9);
  SurfaceLimits limits;
  limits.tolerance = toleranceShare * lengths.testedTolerance;
  GuardedSurface guarded(reference, limits, lengths.maxSize);
  co_await work.yield();
  SurfaceEditor editor(guarded, *targets.sizes);
  co_await work.yield();
  RemeshSchedule schedule(editor);
  VolumeCorrection correction(guarded);
  Job<> changes([&](Work& inner) { return makeChanges(inner, schedule, correction); });
  const bool isFinished = co_await finishUnlessStopped(work, changes, isStopped);

  copyTriangles(guarded, surface, pass);
  measureShapes(result);
  co_await work.yield();
  // Every change has kept the tolerance: from the remeshed surface to the given one at every point, in the other direction at
  // the guests, between which the distance is measured.
  result.deviation = result.tolerance;
  bool isMeasured = false;
  if (isFinished) {
    work.beginPart(1.0);
    Job<> measuring([&](Work& inner) { return measure(inner, guarded, result); });
    isMeasured = co_await finishUnlessStopped(work, measuring, isStopped);
  }
  result.isPartial = !isMeasured;
  if (result.isPartial) result.triangleDeviation.clear();
  co_return pass;
}

}  // namespace tetrafront
