#include "remesh/surface_remeshing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "base/mesh_access.h"
#include "base/tool_job.h"
#include "boundary/boundary.h"
#include "boundary/surface_access.h"
#include "field/size_octree_builder.h"
#include "geom/coordinates.h"
#include "remesh/detail_merger.h"
#include "remesh/deviation.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_pass.h"
#include "remesh/remesh_sizes.h"
#include "remesh/remesh_targets.h"
#include "sizing/check_options.h"
#include "sizing/expected_count.h"
#include "sizing/target_sizes.h"

namespace tetrafront {
namespace {

/// Smallest angle, in degrees, below which poor details are dropped.
constexpr double kPoorAngle = 10.0;
/// Difference of the mean radius ratio that does not matter.
constexpr double kRatioNoise = 0.005;
/// Merges of poor details, each followed by a remeshing: a merge brings other lines closer.
constexpr int kMaxDetailPasses = 2;
/// Shares of the tolerance: of the remeshing before the merges, of each merge, and of the remeshing after it. Their sum is
/// at most 1.
constexpr double kFirstShare = 0.4;
constexpr double kDroppedShare = 0.1;
constexpr double kNextShare = 0.2;

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

/// Details that were dropped.
struct DroppedDetails {
  std::vector<MergedDetail> merged;
  double deviation = 0.0;
};

/// Returns what is beside the triangles; nothing if that is not given.
std::vector<std::uint32_t> regionsOf(const PassSurface& surface,
                                     std::span<const std::uint32_t> given) {
  std::vector<std::uint32_t> regions;
  if (given.empty()) return regions;
  for (const std::size_t triangle : surface.origin) {
    regions.push_back(given[2 * triangle]);
    regions.push_back(given[2 * triangle + 1]);
  }
  return regions;
}

/// `regions`: beside the given triangles, or nothing. Keeps all details if a region would be left without volume.
Task<DroppedDetails> dropDetails(Work& work, PassSurface& surface,
                                 std::span<const std::uint32_t> regions,
                                 const RemeshOptions& options, double distance,
                                 DetailChoice choice) {
  ReferenceSurface reference(surface.mesh, surface.groups, featureRulesOf(options));
  co_await reference.prepare(work);
  DetailMerger merger(reference, distance, choice);
  co_await merger.run(work);
  DroppedDetails dropped;
  if (merger.merged().empty()) co_return dropped;
  PassSurface made;
  std::vector<TriangleId> parents;
  merger.copyTo(made.mesh, parents);
  for (const TriangleId parent : parents) {
    made.origin.push_back(surface.origin[parent.index()]);
    if (!surface.groups.empty()) made.groups.push_back(surface.groups[parent.index()]);
  }
  SurfaceMesh checked = made.mesh;
  checked.triangleRegions = regionsOf(made, regions);
  BoundaryCheck boundary(checked, BoundarySource::kGivenSurface, options.innerShells);
  co_await work.finish(boundary);
  if (anyError(boundary.takeDiagnostics())) co_return dropped;
  surface = std::move(made);
  dropped.merged = merger.merged();
  dropped.deviation = merger.deviation();
  co_return dropped;
}

bool isPoor(const SurfaceRemesh& result) {
  return result.diagnostics.empty() && !result.isPartial && result.smallestAngle < kPoorAngle;
}

/// Returns true if the smallest angle is larger, without poorer triangles on average.
bool isBetter(const SurfaceRemesh& one, const SurfaceRemesh& other) {
  return one.smallestAngle > other.smallestAngle &&
         one.meanRadiusRatio > other.meanRadiusRatio - kRatioNoise;
}

/// Returns a remeshed surface as the next one to be remeshed, with the feature lines that it has.
PassSurface nextSurface(RemeshPass& pass) {
  PassSurface surface;
  surface.mesh.points = std::move(pass.remesh.points);
  surface.mesh.triangles = std::move(pass.remesh.triangles);
  surface.groups = std::move(pass.patches);
  surface.origin = std::move(pass.remesh.origin);
  return surface;
}

/// Measures the distance of the triangles from the given surface.
Task<> measureDeviation(Work& work, SurfaceRemesh& result, const PassSurface& given,
                        const RemeshOptions& options) {
  ReferenceSurface reference(given.mesh, given.groups, featureRulesOf(options));
  co_await reference.prepare(work);
  SurfaceMesh made;
  made.points = result.points;
  made.triangles = result.triangles;
  co_await work.forEachBlock(result.origin.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      result.triangleDeviation[t] =
          sampledDeviation(reference, cornersOf(made, TriangleId(t)), TriangleId(result.origin[t]),
                           result.tolerance);
    }
  });
}

/// Remeshes a surface, drops the details at which triangles are poor, and remeshes it again, twice. Merges need
/// well-shaped triangles: in needles along a strip, the nodes of both lines lie anywhere. The deviations of all steps add
/// up to at most the tolerance of `plain`, the result with all details. Returns nothing if it is not better than `plain`.
Task<std::optional<SurfaceRemesh>> remeshWithoutPoorDetails(
    Work& work, const PassSurface& given, std::span<const std::uint32_t> regions,
    const BackgroundGrid& grid, const RemeshOptions& options, const SurfaceRemesh& plain,
    const bool& isStopped) {
  work.beginPart(0.4);
  RemeshOptions ofPass = options;
  ofPass.tolerance = kFirstShare * plain.tolerance;
  RemeshPass pass = co_await remeshOnce(work, given, grid, ofPass, isStopped);
  double deviation = pass.remesh.deviation;
  std::vector<MergedDetail> merged;
  for (int i = 1; i <= kMaxDetailPasses && isPoor(pass.remesh); ++i) {
    work.beginPart(0.4 + 0.55 * i / kMaxDetailPasses);
    PassSurface surface = nextSurface(pass);
    const DroppedDetails dropped =
        co_await dropDetails(work, surface, regions, options, kDroppedShare * plain.tolerance,
                             DetailChoice::kPoor);
    ofPass.tolerance = kNextShare * plain.tolerance;
    pass = co_await remeshOnce(work, surface, grid, ofPass, isStopped);
    deviation += dropped.deviation + pass.remesh.deviation;
    merged.insert(merged.end(), dropped.merged.begin(), dropped.merged.end());
  }
  work.beginPart(1.0);
  SurfaceRemesh& result = pass.remesh;
  const bool isUsable = result.diagnostics.empty() && !result.isPartial;
  if (!isUsable || merged.empty() || !isBetter(result, plain)) co_return std::nullopt;
  result.size = plain.size;
  result.minSize = plain.minSize;
  result.tolerance = plain.tolerance;
  result.deviation = std::max(deviation, plain.tolerance);
  result.mergedDetails = std::move(merged);
  result.patches = plain.patches;
  result.featureLines = plain.featureLines;
  co_await measureDeviation(work, result, given, options);
  co_return std::move(result);
}

}  // namespace

Task<SurfaceRemesh> remeshSurface(Work& work, SurfaceMesh& mesh, std::vector<std::uint32_t>& groups,
                                  const BackgroundGrid& grid, const RemeshOptions& options,
                                  const bool& isStopped) {
  work.beginPart(0.05);
  std::vector<std::uint32_t> regions = mesh.triangleRegions;
  std::vector<Diagnostic> problems = co_await checkInput(work, mesh, grid, options);
  if (anyError(problems)) co_return refused(std::move(problems));

  mesh.triangleRegions = {};
  PassSurface surface{std::move(mesh), std::move(groups), {}};
  surface.origin.resize(countTriangles(surface.mesh));
  std::iota(surface.origin.begin(), surface.origin.end(), 0U);
  DroppedDetails dropped;
  if (options.dropDetails > 0.0) {
    work.beginPart(0.1);
    dropped = co_await dropDetails(work, surface, regions, options, options.dropDetails,
                                   DetailChoice::kAll);
  }
  work.beginPart(options.dropPoorDetails ? 0.5 : 1.0);
  RemeshPass pass = co_await remeshOnce(work, surface, grid, options, isStopped);
  SurfaceRemesh result = std::move(pass.remesh);
  if (!result.diagnostics.empty()) co_return result;
  if (options.dropPoorDetails && isPoor(result)) {
    work.beginPart(1.0);
    std::optional<SurfaceRemesh> better = co_await remeshWithoutPoorDetails(
        work, surface, regions, grid, options, result, isStopped);
    if (better) result = std::move(*better);
    result.isPartial = isStopped;
  }
  result.deviation += dropped.deviation;
  result.mergedDetails.insert(result.mergedDetails.begin(), dropped.merged.begin(),
                              dropped.merged.end());
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
  ReferenceSurface reference(mesh, groups, featureRulesOf(options));
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
