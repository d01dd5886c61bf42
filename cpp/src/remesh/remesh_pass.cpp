#include "remesh/remesh_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "geom/angles.h"
#include "quality/metrics.h"
#include "remesh/deviation.h"
#include "remesh/guarded_surface.h"
#include "remesh/remesh_schedule.h"
#include "remesh/remesh_sizes.h"
#include "remesh/remesh_targets.h"
#include "remesh/surface_editor.h"
#include "remesh/triangle_parts.h"
#include "remesh/volume_correction.h"
#include "sizing/target_sizes.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Turn of a feature line, in degrees, at which it has a corner.
constexpr double kCornerDegrees = 50.0;
/// Given triangles under one of the target size from which a surface is coarsened first: a triangle that covers more of
/// them takes long to prove, or cannot be proven to stay within the tolerance.
constexpr double kManyBeneath = 100.0;
/// If triangles of the target size cover so many given ones on more than this share of the area of the curved patches, the surface
/// is coarsened first.
constexpr double kFineShare = 0.05;
/// Largest number of pieces by which this share is estimated: enough for its size.
constexpr std::size_t kFineSamples = 4096;
/// Pieces of the given surface visited per unit of budget.
constexpr std::size_t kCountedPerUnit = 8;
/// Share of the tolerance that coarsening may use.
constexpr double kCoarseningShare = 0.1;

/// What one remeshing works on; all must outlive it.
struct PassInput {
  const TrackedSurface& surface;
  std::span<const std::uint8_t> isSettled;  ///< as PassRules::isSettled
  const GivenSizes& sizes;
  const bool& isStopped;
  bool isOnFaces = false;  ///< as PassRules::isOnFaces
};

/// Copies the triangles out of the complex, without unused nodes.
void copyTriangles(const GuardedSurface& surface, const TrackedSurface& given, RemeshPass& pass) {
  const SurfaceComplex& complex = surface.complex();
  auto& [mesh, origin] = pass.surface;
  std::vector<std::uint32_t> number(complex.nodeCount(), kNoIndex);
  for (const NodeId node : IdRange<NodeId>(complex.nodeCount())) {
    if (!complex.isUsed(node)) continue;
    number[node.index()] = countNodes(mesh);
    const Vec3& point = complex.pointOf(node);
    mesh.points.insert(mesh.points.end(), {point.x, point.y, point.z});
  }
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    if (!complex.isAlive(t)) continue;
    for (const NodeId node : complex.nodesOf(t)) mesh.triangles.push_back(number[node.index()]);
    pass.beneath.push_back(surface.beneath(t));
    mesh.trianglePatch.push_back(complex.patchOf(t).value);
  }
  origin = inherited(given.origin, pass.beneath);
  mesh.triangleRegions = inherited(given.mesh.triangleRegions, pass.beneath, 2);
}

/// Samples the distance of the triangles in the order in which copyTriangles() copies them.
Task<> sampleDeviation(Work& work, const GuardedSurface& surface, SurfaceRemesh& result) {
  SampledDeviation deviation(surface);
  const SurfaceComplex& complex = surface.complex();
  co_await work.forEachBlock(complex.triangleSlots(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      if (!complex.isAlive(TriangleId(t))) continue;
      result.triangleDeviation.push_back(deviation.of(TriangleId(t)));
    }
  });
}

/// Returns about how many triangles of a size like that of the given one meet a triangle of the target size, of any place
/// and direction: by its area, and by the edges that cross its outline.
double countBeneath(const TriangleCorners& given, double size) {
  double outline = 0.0;
  for (std::size_t k = 0; k < 3; ++k) outline += glm::length(given[(k + 1) % 3] - given[k]);
  const double area = std::max(areaOf(given), std::numeric_limits<double>::min());
  return 1.0 + 1.0 / trianglesOn(area, size) +
         3.0 * size * outline / (2.0 * std::numbers::pi * area);
}

/// Returns true if, on much of the curved patches, a triangle of the target size covers very many given ones. O(log pieces).
Task<bool> isVeryFine(Work& work, const ReferenceSurface& reference, const RemeshSizes& sizes,
                      double maxSize) {
  double curved = 0.0;
  double fine = 0.0;
  RemeshSizes::Hint hint;
  const std::vector<ReferenceSurface::Piece>& pieces = reference.pieces();
  const std::size_t stride = 1 + pieces.size() / kFineSamples;
  const std::size_t samples = (pieces.size() + stride - 1) / stride;
  co_await work.forEachBlock(
      samples,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const ReferenceSurface::Piece& piece = pieces[i * stride];
          const SmoothPatchId patch = reference.patchOf(piece.triangle);
          if (reference.patch(patch).isPlanar) continue;
          curved += piece.area;
          const TriangleCorners corners = cornersOf(reference.mesh(), piece.triangle);
          if (countBeneath(corners, maxSize) <= kManyBeneath) continue;
          hint.field.region = sizes.regionOf(patch);
          const double size = sizes.sizeAt(piece.centroid, hint);
          if (countBeneath(corners, size) > kManyBeneath) fine += piece.area;
        }
      },
      kCountedPerUnit);
  const bool areMany = fine > kFineShare * curved;
  co_return areMany;
}

/// What a step does with the triangles: make them well-shaped, or only collapse edges far below their target size.
enum class Changes : std::uint8_t { kAll, kCoarsening };

struct Step {
  Changes changes;
  double tested;  ///< tolerance of the checks
  /// Whether the distance of the triangles is sampled: not if another step follows, or has come before.
  bool samples;
};

Task<> makeChanges(Work& work, Changes changes, bool isOnFaces, RemeshSchedule& schedule,
                   VolumeCorrection& correction) {
  if (changes == Changes::kCoarsening) {
    co_await schedule.coarsen(work);
    co_return;
  }
  work.beginPart(0.95);
  co_await schedule.run(work);
  work.beginPart(1.0);
  if (!isOnFaces) co_await correction.run(work);
}

/// Bounds the distance between the surfaces, and may sample that of the triangles.
Task<> measure(Work& work, bool samples, const GuardedSurface& surface, SurfaceRemesh& result) {
  work.beginPart(samples ? 0.3 : 1.0);
  DeviationBound bound(surface, result.tolerance);
  co_await work.finish(bound);
  result.deviation = bound.bound();
  if (!samples) co_return;
  work.beginPart(1.0);
  co_await sampleDeviation(work, surface, result);
}

/// Changes the triangles of a surface. The tolerance of the result must be set. The result is partial if it was stopped.
Task<> changeTriangles(Work& work, const ReferenceSurface& reference, const RemeshSizes& sizes,
                       const Step& step, const PassInput& input, RemeshPass& pass) {
  SurfaceRemesh& result = pass.remesh;
  work.beginPart(0.85);
  SurfaceLimits limits;
  limits.tolerance = step.tested;
  GuardedSurface guarded(reference, limits, result.size);
  co_await work.yield();
  SurfaceEditor editor(guarded, sizes, input.isSettled, input.isOnFaces);
  co_await work.yield();
  RemeshSchedule schedule(editor);
  VolumeCorrection correction(guarded);
  Job<> changes([&](Work& inner) {
    return makeChanges(inner, step.changes, input.isOnFaces, schedule, correction);
  });
  const bool isFinished = co_await finishUnlessStopped(work, changes, input.isStopped);

  copyTriangles(guarded, input.surface, pass);
  measureShapes(pass.surface.mesh, result);
  co_await work.yield();
  // Every change has kept the tolerance: from the remeshed surface to the given one at every point, in the other direction at
  // the guests, between which the distance is measured.
  result.deviation = result.tolerance;
  bool isMeasured = false;
  if (isFinished) {
    work.beginPart(1.0);
    Job<> measuring([&](Work& inner) { return measure(inner, step.samples, guarded, result); });
    isMeasured = co_await finishUnlessStopped(work, measuring, input.isStopped);
  }
  result.isPartial = !isMeasured;
  if (result.isPartial) result.triangleDeviation.clear();
}

/// Remeshes the coarsened surface of a pass; the pass then has the result of both steps. `share`: of the tolerance, for this
/// step. If it is stopped, the points of the given surface are near the coarsened one, but only the guests of that one were
/// tested in this step.
Task<> remeshCoarse(Work& work, const ReferenceSurface& reference, const RemeshLengths& lengths,
                    RemeshSizes& sizes, double share, const PassInput& input, RemeshPass& pass) {
  const RemeshPass coarse = std::move(pass);
  const TrackedSurface& surface = coarse.surface;
  work.beginPart(0.1);
  ReferenceSurface next = reference.of(surface.mesh);
  co_await next.prepare(work);
  setRegions(sizes, next, surface.origin, input.sizes.ofRegions);
  pass = RemeshPass{};
  SurfaceRemesh& result = pass.remesh;
  result = coarse.remesh;
  result.tolerance = share * lengths.tolerance;
  work.beginPart(0.9);
  const Step step{Changes::kAll, share * lengths.testedTolerance, false};
  const PassInput nextInput{surface, {}, input.sizes, input.isStopped};
  co_await changeTriangles(work, next, sizes, step, nextInput, pass);
  pass.beneath = inherited(coarse.beneath, pass.beneath);
  result.tolerance += coarse.remesh.tolerance;
  result.deviation += coarse.remesh.deviation;
  work.beginPart(1.0);
  if (!result.isPartial) {
    co_await sampleDeviation(work, reference, pass.surface.mesh, pass.beneath, input.isStopped,
                             result);
  }
}

}  // namespace

void measureShapes(const SurfaceMesh& mesh, SurfaceRemesh& result) {
  double sum = 0.0;
  double largestCosine = 0.5;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const std::array<Vec3, 3> corners = cornersOf(mesh, t);
    sum += triangleRadiusRatio(corners[0], corners[1], corners[2]);
    largestCosine = std::max(largestCosine, largestCosineOf(corners));
  }
  result.smallestAngle = degreesOf(largestCosine);
  result.meanRadiusRatio = sum / countTriangles(mesh);
}

FeatureRules featureRulesOf(const RemeshOptions& options) {
  return {cosineOfDegrees(options.featureAngle), cosineOfDegrees(kCornerDegrees)};
}

Task<> sampleDeviation(Work& work, const ReferenceSurface& reference, const SurfaceMesh& made,
                       std::span<const TriangleId> beneath, const bool& isStopped,
                       SurfaceRemesh& result) {
  result.triangleDeviation.resize(beneath.size());
  co_await work.forEachBlock(beneath.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last && !isStopped; ++t) {
      result.triangleDeviation[t] =
          sampledDeviation(reference, cornersOf(made, TriangleId(t)), beneath[t], result.tolerance);
    }
  });
  if (!isStopped) co_return;
  result.isPartial = true;
  result.triangleDeviation.clear();
}

Task<RemeshPass> remeshOnce(Work& work, const ReferenceSurface& reference,
                            const TrackedSurface& surface, const GivenSizes& sizes,
                            const RemeshOptions& options, const PassRules& rules,
                            const bool& isStopped) {
  const double toleranceShare = rules.toleranceShare;
  const PassInput input{surface, rules.isSettled, sizes, isStopped, rules.isOnFaces};
  RemeshPass pass;
  SurfaceRemesh& result = pass.remesh;
  const bool hasTargets = options.size > 0.0 || usesGrid(sizes.grid, targetOptions(options));
  const RemeshLengths lengths =
      remeshLengthsOf(options, hasTargets, reference.diagonal(), rules.plannedShare);
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
    pass.surface = surface;
    result.isPartial = true;
    result.deviation = result.tolerance;
    measureShapes(surface.mesh, result);
    co_return pass;
  }
  TargetField targets = finding.take();
  result.diagnostics = std::move(targets.diagnostics);
  if (!result.diagnostics.empty()) co_return pass;

  const bool coarsens = co_await isVeryFine(work, reference, *targets.sizes, lengths.maxSize);
  work.beginPart(coarsens ? 0.4 : 1.0);
  if (!coarsens) {
    const Step step{Changes::kAll, toleranceShare * lengths.testedTolerance, rules.samples};
    co_await changeTriangles(work, reference, *targets.sizes, step, input, pass);
    co_return pass;
  }
  const double coarseningShare = kCoarseningShare * toleranceShare;
  result.tolerance = coarseningShare * lengths.tolerance;
  const Step step{Changes::kCoarsening, coarseningShare * lengths.testedTolerance, false};
  co_await changeTriangles(work, reference, *targets.sizes, step, input, pass);
  work.beginPart(1.0);
  if (result.isPartial) {
    result.tolerance = toleranceShare * lengths.tolerance;
    result.deviation = result.tolerance;
  } else {
    co_await remeshCoarse(work, reference, lengths, *targets.sizes,
                          toleranceShare - coarseningShare, input, pass);
  }
  co_return pass;
}

}  // namespace tetrafront
