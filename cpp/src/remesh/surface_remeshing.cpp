#include "remesh/surface_remeshing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "base/mesh_access.h"
#include "base/resumable.h"
#include "base/tool_job.h"
#include "boundary/boundary.h"
#include "boundary/surface_access.h"
#include "field/size_octree_builder.h"
#include "geom/angles.h"
#include "geom/coordinates.h"
#include "quality/metrics.h"
#include "remesh/detail_merger.h"
#include "remesh/deviation.h"
#include "remesh/guarded_surface.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_schedule.h"
#include "remesh/remesh_sizes.h"
#include "remesh/remesh_targets.h"
#include "remesh/surface_editor.h"
#include "remesh/volume_correction.h"
#include "sizing/check_options.h"
#include "sizing/expected_count.h"
#include "sizing/target_sizes.h"

namespace tetrafront {
namespace {

/// Turn of a feature line, in degrees, at which it has a corner.
constexpr double kCornerDegrees = 50.0;

FeatureRules rulesOf(const RemeshOptions& options) {
  return {cosineOfDegrees(options.featureAngle), cosineOfDegrees(kCornerDegrees)};
}

SurfaceRemesh refused(std::vector<Diagnostic> diagnostics) {
  SurfaceRemesh result;
  result.diagnostics = std::move(diagnostics);
  return result;
}

std::vector<Diagnostic> checkRemeshOptions(const RemeshOptions& options) {
  std::vector<Diagnostic> found = checkOptions(targetOptions(options));
  const auto isLength = [](double value) { return value >= 0.0 && value <= kLargestCoordinate; };
  const auto isAngle = [](double value) {
    return value >= kMinRemeshAngle && value <= kMaxRemeshAngle;
  };
  const auto [minSize, maxSize, tolerance] =
      std::array{options.minSize, options.maxSize, options.tolerance};
  const auto [featureAngle, perEdge] = std::array{options.featureAngle, options.anglePerEdge};
  const std::array<OptionValue, 7> checked{{
      {CheckedOption::kMinSize, minSize, isLength(minSize)},
      {CheckedOption::kMaxSize, maxSize, isLength(maxSize)},
      {CheckedOption::kTolerance, tolerance, isLength(tolerance)},
      {CheckedOption::kFeatureAngle, featureAngle, isAngle(featureAngle)},
      {CheckedOption::kAnglePerEdge, perEdge, perEdge == 0.0 || isAngle(perEdge)},
      {CheckedOption::kDropDetails, options.dropDetails, isLength(options.dropDetails)},
      {CheckedOption::kLayers, options.layers, options.layers <= kMaxLayers},
  }};
  const std::vector<Diagnostic> others = optionsOutOfRange(checked);
  found.insert(found.end(), others.begin(), others.end());
  return found;
}

/// Returns the errors of the surface, the options and the grid; without errors, notes about components that were given
/// inside out. Orients the surface outward.
Task<std::vector<Diagnostic>> checkInput(Work& work, SurfaceMesh& mesh, const BackgroundGrid& grid,
                                         const RemeshOptions& options) {
  const MeshOptions targets = targetOptions(options);
  std::vector<Diagnostic> found = checkRemeshOptions(options);
  const std::vector<Diagnostic> ofGrid = co_await checkTargetGrid(work, grid, targets);
  found.insert(found.end(), ofGrid.begin(), ofGrid.end());
  BoundaryCheck boundary(mesh, BoundarySource::kGivenSurface, options.innerShells,
                         MixedOrientation::kRefuse);
  co_await work.finish(boundary);
  const std::vector<Diagnostic> ofSurface = boundary.takeDiagnostics();
  found.insert(found.end(), ofSurface.begin(), ofSurface.end());
  const bool hasErrors = anyError(found);
  std::erase_if(found, [hasErrors](const Diagnostic& d) {
    return hasErrors ? d.severity != Severity::kError : d.code != DiagnosticCode::kReorientedPatch;
  });
  co_return found;
}

/// Copies the triangles out of the complex, without unused nodes.
void copyTriangles(const GuardedSurface& surface, SurfaceMesh& mesh, SurfaceRemesh& result) {
  const SurfaceComplex& complex = surface.complex();
  std::vector<std::uint32_t> number(complex.nodeCount(), kNoIndex);
  for (const NodeId node : IdRange<NodeId>(complex.nodeCount())) {
    if (!complex.isUsed(node)) continue;
    number[node.index()] = static_cast<std::uint32_t>(mesh.points.size() / 3);
    const Vec3& point = complex.pointOf(node);
    mesh.points.insert(mesh.points.end(), {point.x, point.y, point.z});
  }
  SampledDeviation deviation(surface);
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    if (!complex.isAlive(t)) continue;
    for (const NodeId node : complex.nodesOf(t)) mesh.triangles.push_back(number[node.index()]);
    result.origin.push_back(surface.beneath(t).value);
    result.triangleDeviation.push_back(deviation.of(t));
  }
}

void measureShapes(const SurfaceMesh& mesh, SurfaceRemesh& result) {
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
}

/// What was dropped before the remeshing.
struct DroppedDetails {
  std::vector<TriangleId> origin;  ///< per triangle: the given one; empty if nothing was dropped
  std::vector<MergedDetail> merged;
  double deviation = 0.0;
};

/// Keeps all details if a region would be left without volume.
Task<DroppedDetails> dropDetails(Work& work, SurfaceMesh& mesh, std::vector<std::uint32_t>& groups,
                                 const FeatureRules& rules, const RemeshOptions& options) {
  DroppedDetails dropped;
  ReferenceSurface reference(mesh, groups, rules);
  co_await reference.prepare(work);
  DetailMerger merger(reference, options.dropDetails);
  co_await merger.run(work);
  if (merger.merged().empty()) co_return dropped;
  SurfaceMesh made;
  std::vector<TriangleId> origin;
  merger.copyTo(made, origin);
  SurfaceMesh checked = made;
  for (const TriangleId given : origin) {
    if (mesh.triangleRegions.empty()) break;
    const auto first =
        mesh.triangleRegions.begin() + static_cast<std::ptrdiff_t>(2 * given.index());
    checked.triangleRegions.insert(checked.triangleRegions.end(), first, first + 2);
  }
  BoundaryCheck boundary(checked, BoundarySource::kGivenSurface, options.innerShells);
  co_await work.finish(boundary);
  if (anyError(boundary.takeDiagnostics())) co_return dropped;
  dropped.origin = std::move(origin);
  dropped.merged = merger.merged();
  dropped.deviation = merger.deviation();
  mesh.points = std::move(made.points);
  mesh.triangles = std::move(made.triangles);
  if (groups.empty()) co_return dropped;
  std::vector<std::uint32_t> ofMade;
  for (const TriangleId given : dropped.origin) ofMade.push_back(groups[given.index()]);
  groups = std::move(ofMade);
  co_return dropped;
}

Task<> makeChanges(Work& work, RemeshSchedule& schedule, VolumeCorrection& correction) {
  work.beginPart(0.95);
  co_await schedule.run(work);
  work.beginPart(1.0);
  co_await correction.run(work);
}

}  // namespace

Task<SurfaceRemesh> remeshSurface(Work& work, SurfaceMesh& mesh, std::vector<std::uint32_t>& groups,
                                  const BackgroundGrid& grid, const RemeshOptions& options,
                                  const bool& isStopped) {
  work.beginPart(0.05);
  const bool areRegionsGiven = !mesh.triangleRegions.empty();
  std::vector<Diagnostic> problems = co_await checkInput(work, mesh, grid, options);
  if (anyError(problems)) co_return refused(std::move(problems));

  work.beginPart(0.1);
  const FeatureRules rules = rulesOf(options);
  if (!areRegionsGiven) mesh.triangleRegions = {};
  DroppedDetails dropped;
  if (options.dropDetails > 0.0) {
    dropped = co_await dropDetails(work, mesh, groups, rules, options);
  }
  ReferenceSurface reference(mesh, groups, rules);
  co_await reference.prepare(work);
  const bool hasTargets = options.size > 0.0 || usesGrid(grid, targetOptions(options));
  const RemeshLengths lengths = remeshLengthsOf(options, hasTargets, reference.diagonal());

  work.beginPart(0.15);
  TargetField targets = co_await findTargetField(work, reference, grid, options, lengths);
  if (!targets.diagnostics.empty()) co_return refused(std::move(targets.diagnostics));

  work.beginPart(0.9);
  SurfaceLimits limits;
  limits.tolerance = lengths.testedTolerance;
  GuardedSurface surface(reference, limits, lengths.maxSize);
  SurfaceEditor editor(surface, *targets.sizes);
  co_await work.yield();
  RemeshSchedule schedule(editor);
  VolumeCorrection correction(surface);
  Job<> changes([&](Work& inner) { return makeChanges(inner, schedule, correction); });
  bool isFinished = false;
  while (!isFinished && !isStopped) {
    isFinished = changes.advance(work.remaining());
    work.setFraction(changes.fraction());
    co_await work.yield();
  }

  work.beginPart(1.0);
  SurfaceRemesh result;
  result.isPartial = !isFinished;
  SurfaceMesh made;
  copyTriangles(surface, made, result);
  measureShapes(made, result);
  result.size = lengths.maxSize;
  result.minSize = lengths.minSize;
  result.tolerance = lengths.tolerance;
  result.patches = static_cast<std::uint32_t>(reference.patchCount());
  result.featureLines = static_cast<std::uint32_t>(reference.lines().size());
  // In the other direction, every change has kept the tolerance.
  DeviationBound deviation(surface, lengths.tolerance);
  co_await work.finish(deviation);
  result.deviation = deviation.bound() + dropped.deviation;
  result.mergedDetails = std::move(dropped.merged);
  for (std::uint32_t& triangle : result.origin) {
    if (!dropped.origin.empty()) triangle = dropped.origin[triangle].value;
  }
  result.points = std::move(made.points);
  result.triangles = std::move(made.triangles);
  result.diagnostics = std::move(problems);
  co_return result;
}

Task<SurfaceSizeProposal> proposeSurfaceSizes(Work& work, SurfaceMesh& mesh,
                                              std::span<const std::uint32_t> groups,
                                              const RemeshOptions& options) {
  const BackgroundGrid noGrid;
  SurfaceSizeProposal result;
  work.beginPart(0.1);
  result.diagnostics = co_await checkInput(work, mesh, noGrid, options);
  if (!result.diagnostics.empty()) co_return result;
  work.beginPart(0.2);
  ReferenceSurface reference(mesh, groups, rulesOf(options));
  co_await reference.prepare(work);
  const RemeshLengths lengths = remeshLengthsOf(options, options.size > 0.0, reference.diagonal());
  work.beginPart(0.6);
  TargetField targets = co_await findTargetField(work, reference, noGrid, options, lengths);
  result.diagnostics = std::move(targets.diagnostics);
  if (!result.diagnostics.empty()) co_return result;

  work.beginPart(0.9);
  std::vector<Vec3> positions;
  std::vector<double> sizes;
  RemeshSizes::Hint hint;
  for (const ReferenceSurface::Piece& piece : reference.pieces()) {
    positions.push_back(piece.centroid);
    sizes.push_back(targets.sizes->sizeAt(piece.centroid, hint));
    result.triangles += trianglesOn(piece.area, sizes.back());
  }
  result.size = *std::ranges::max_element(sizes);
  result.minSize = *std::ranges::min_element(sizes);
  result.tolerance = lengths.tolerance;
  SizeOctreeBuilder builder(positions, sizes, options.growth, lengths.maxSize);
  co_await work.finish(builder);
  result.tetrahedra = expectedTetrahedra(mesh, SizeField::fromOctree(builder.take()));
  co_return result;
}

namespace {

struct RemeshInput {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> groups;
  BackgroundGrid grid;
  RemeshOptions options;
  bool isStopped = false;
};

RemeshInput inputOf(std::span<const double> points, std::span<const std::uint32_t> triangles,
                    std::span<const std::uint32_t> groups, BackgroundGrid grid,
                    const RemeshOptions& options, std::span<const std::uint32_t> triangleRegions) {
  RemeshInput input;
  input.mesh.triangleRegions.assign(triangleRegions.begin(), triangleRegions.end());
  input.mesh.points.assign(points.begin(), points.end());
  input.mesh.triangles.assign(triangles.begin(), triangles.end());
  input.groups.assign(groups.begin(), groups.end());
  input.grid = std::move(grid);
  input.options = options;
  return input;
}

}  // namespace

SurfaceRemesher::SurfaceRemesher(std::span<const double> points,
                                 std::span<const std::uint32_t> triangles,
                                 std::span<const std::uint32_t> groups, BackgroundGrid grid,
                                 const RemeshOptions& options,
                                 std::span<const std::uint32_t> triangleRegions)
    : SlicedTool(makeToolJob<SurfaceRemesh>(
          inputOf(points, triangles, groups, std::move(grid), options, triangleRegions),
          [](Work& work, RemeshInput& input) {
            return remeshSurface(work, input.mesh, input.groups, input.grid, input.options,
                                 input.isStopped);
          })) {}

SurfaceSizeProposer::SurfaceSizeProposer(std::span<const double> points,
                                         std::span<const std::uint32_t> triangles,
                                         std::span<const std::uint32_t> groups,
                                         const RemeshOptions& options,
                                         std::span<const std::uint32_t> triangleRegions)
    : SlicedTool(makeToolJob<SurfaceSizeProposal>(
          inputOf(points, triangles, groups, {}, options, triangleRegions),
          [](Work& work, RemeshInput& input) {
            return proposeSurfaceSizes(work, input.mesh, input.groups, input.options);
          })) {}

}  // namespace tetrafront
