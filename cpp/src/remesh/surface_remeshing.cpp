#include "remesh/surface_remeshing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "base/tool_job.h"
#include "boundary/boundary.h"
#include "boundary/centred_surface.h"
#include "field/size_octree_builder.h"
#include "geom/angles.h"
#include "geom/coordinates.h"
#include "geom/measure.h"
#include "model/joined_solids.h"
#include "model/model_numbers.h"
#include "remesh/centred.h"
#include "remesh/deviation.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_pass.h"
#include "remesh/remesh_sizes.h"
#include "remesh/remesh_steps.h"
#include "remesh/remesh_targets.h"
#include "remesh/triangle_parts.h"
#include "sizing/check_options.h"
#include "sizing/expected_count.h"
#include "sizing/region_sizes.h"
#include "sizing/target_sizes.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// The automatic tolerance is relative to the smallest region, which is a bolt of an assembly, but not to a smaller one than
/// this share of the diagonal of all: the whole surface has one tolerance.
constexpr double kMinRegion = 1.0 / 8.0;
/// Largest automatic tolerance / mean thickness: the sides of a thin wall must not come near each other.
constexpr double kTolerancePerThickness = 0.5;
/// Smallest automatic tolerance / diagonal: six digits, as text files have. A smaller one would keep their rounding as shape.
constexpr double kMinTolerancePerDiagonal = 1e-6;

/// Returns whether there are several regions beside triangles.
bool areSeveral(std::span<const std::uint32_t> regions) {
  return std::ranges::any_of(
      regions, [](std::uint32_t region) { return region != SurfaceMesh::kNoRegion && region > 0; });
}

/// Returns the diagonal of the smallest region beside the triangles, two regions each; at least the share above.
double smallestDiagonal(const SurfaceMesh& mesh, std::span<const std::uint32_t> regions,
                        double diagonal) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  std::vector<Bounds> bounds;
  for (std::size_t half = 0; half < regions.size(); ++half) {
    const std::uint32_t region = regions[half];
    if (region == SurfaceMesh::kNoRegion) continue;
    if (region >= bounds.size()) bounds.resize(region + 1, {Vec3(kInfinite), Vec3(-kInfinite)});
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 position = pointOf(mesh, NodeId(mesh.triangles[3 * (half / 2) + corner]));
      bounds[region].low = glm::min(bounds[region].low, position);
      bounds[region].high = glm::max(bounds[region].high, position);
    }
  }
  double smallest = diagonal;
  for (const Bounds& each : bounds) {
    if (each.low.x <= each.high.x) smallest = std::min(smallest, glm::length(each.high - each.low));
  }
  return std::max(smallest, kMinRegion * diagonal);
}

/// Returns 2 V / A of the thinnest region beside the triangles, two regions each: the thickness of a body that is thin everywhere.
double meanThickness(const SurfaceMesh& mesh, std::span<const std::uint32_t> regions) {
  struct Measures {
    double sixfoldVolume = 0.0;
    double area = 0.0;
  };
  std::vector<Measures> measures(1);
  const auto add = [&](std::uint32_t region, double sixfoldVolume, double area) {
    if (region == SurfaceMesh::kNoRegion) return;
    if (region >= measures.size()) measures.resize(region + 1);
    measures[region].sixfoldVolume += sixfoldVolume;
    measures[region].area += area;
  };
  for (std::size_t t = 0; t < countTriangles(mesh); ++t) {
    const auto [a, b, c] = cornersOf(mesh, TriangleId(t));
    const double sixfold = sixVolumesBelow(Vec3(0.0), a, b, c);
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    add(regions[2 * t], sixfold, area);
    add(regions[2 * t + 1], -sixfold, area);
  }
  double thinnest = std::numeric_limits<double>::infinity();
  for (const auto& [sixfold, area] : measures) {
    if (area > 0.0) thinnest = std::min(thinnest, std::fabs(sixfold) / (3.0 * area));
  }
  return thinnest;
}

/// Returns the volume that a new surface encloses. `regions`: two per given triangle.
double volumeOf(const SurfaceRemesh& made, std::span<const std::uint32_t> regions) {
  double sixfold = 0.0;
  const auto pointAt = [&](std::size_t corner) {
    const double* position = &made.points[3 * std::size_t{made.triangles[corner]}];
    return Vec3(position[0], position[1], position[2]);
  };
  for (std::size_t t = 0; t < made.origin.size(); ++t) {
    const std::size_t given = made.origin[t];
    // Interfaces bound the volumes on both sides.
    if (regions[2 * given + 1] != SurfaceMesh::kNoRegion) continue;
    sixfold += glm::dot(pointAt(3 * t), glm::cross(pointAt(3 * t + 1), pointAt(3 * t + 2)));
  }
  return sixfold / 6.0;
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
  const double factor = options.sizeFactor;
  const bool isFactor = factor >= kMinSizeFactor && factor <= kMaxSizeFactor;
  const std::array<OptionValue, 8> checked{{
      {CheckedOption::kSizeFactor, factor, isFactor},
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

/// Returns the result of all steps.
Task<SurfaceRemesh> finish(Work& work, const Remeshing& remeshing, SimplifiedSurface& surface) {
  SurfaceRemesh result = std::move(surface.pass.remesh);
  TrackedSurface& made = surface.pass.surface;
  if (!result.diagnostics.empty()) co_return result;
  result.tolerance = remeshing.lengths.tolerance;
  result.deviation = std::max(surface.deviation, result.tolerance);
  result.mergedDetails = std::move(surface.merged);
  const bool isSampled = !result.triangleDeviation.empty();
  if (isComplete(result) && !remeshing.isStopped && !isSampled) {
    const ReferenceSurface& reference = remeshing.reference;
    result.patches = static_cast<std::uint32_t>(reference.patchCount());
    result.featureLines = static_cast<std::uint32_t>(reference.lines().size());
    co_await sampleDeviation(work, reference, made.mesh, made.origin, remeshing.isStopped, result);
  }
  moveTo(made, result);
  if (remeshing.isStopped) {
    result.isPartial = true;
    result.triangleDeviation.clear();
  }
  co_return result;
}

/// Returns the faces of a model about a centre, those once that two solids share; none if they cannot be evaluated.
std::optional<JoinedSolids> readSolids(std::span<const double> numbers, const Vec3& centre) {
  if (numbers.empty()) return std::nullopt;
  std::optional<ReadModel> read = readModel(numbers);
  if (!read || !read->isSound) return std::nullopt;
  return joinSolids(relativeTo(centre, std::move(read->model)));
}

}  // namespace

Task<SurfaceRemesh> remeshSurface(Work& work, SurfaceMesh& mesh, std::vector<std::uint32_t>& groups,
                                  GivenSizes sizes, const RemeshOptions& options,
                                  const bool& isStopped, std::span<const double> model) {
  work.beginPart(0.05);
  std::vector<std::uint32_t> regions = mesh.triangleRegions;
  std::vector<Diagnostic> problems = co_await checkInput(work, mesh, sizes.grid, options);
  if (anyError(problems)) co_return refused(std::move(problems));
  work.beginPart(1.0);
  const double givenVolume = enclosedVolume(mesh);
  const std::vector<std::uint32_t> found = std::exchange(mesh.triangleRegions, std::move(regions));
  mesh.trianglePatch = std::move(groups);
  TrackedSurface given = trackedFrom(std::move(mesh));
  const Vec3 centre = moveToCentre(given.mesh);
  const BackgroundGrid movedGrid = relativeTo(centre, sizes.grid);
  const GivenSizes movedSizes{movedGrid, sizes.ofRegions};
  ReferenceSurface reference(given.mesh, featureRulesOf(options), centre);
  const double diagonal = reference.diagonal();
  const bool hasTargets = options.size > 0.0 || usesGrid(sizes.grid, targetOptions(options));
  RemeshOptions settled = options;
  if (settled.tolerance <= 0.0) {
    const double extent = smallestDiagonal(given.mesh, found, diagonal);
    const double automatic = automaticTolerance(options, hasTargets, extent);
    const double smallest =
        areSeveral(found) ? kMinRegion * automatic : kMinTolerancePerDiagonal * diagonal;
    const double ofThickness = kTolerancePerThickness * meanThickness(given.mesh, found);
    settled.tolerance = std::min(automatic, std::max(smallest, ofThickness));
  }
  const RemeshLengths lengths = remeshLengthsOf(settled, hasTargets, diagonal);
  work.beginPart(0.1);
  co_await reference.prepare(work);
  const std::optional<JoinedSolids> solids = readSolids(model, centre);
  const TrimmedModel* faces = solids ? &solids->model : nullptr;
  const Remeshing remeshing{given, reference, movedSizes, settled, lengths, isStopped, faces};
  work.beginPart(0.95);
  SimplifiedSurface surface = co_await remeshAndDrop(work, remeshing);
  for (std::uint32_t& face : surface.pass.remesh.failedFaces) face = solids->givenFaces[face];
  work.beginPart(1.0);
  SurfaceRemesh result = co_await finish(work, remeshing, surface);
  result.givenVolume = givenVolume;
  result.volume = volumeOf(result, found);
  moveBack(centre, result);
  if (result.diagnostics.empty()) result.diagnostics = std::move(problems);
  co_return result;
}

Task<SurfaceSizeProposal> proposeSurfaceSizes(Work& work, SurfaceMesh& mesh,
                                              std::vector<std::uint32_t>& groups,
                                              const RemeshOptions& options) {
  const BackgroundGrid noGrid;
  const RegionSizes noRegions;
  const GivenSizes given{noGrid, noRegions};
  SurfaceSizeProposal result;
  work.beginPart(0.1);
  result.diagnostics = co_await checkInput(work, mesh, noGrid, options);
  if (!result.diagnostics.empty()) co_return result;
  work.beginPart(0.2);
  mesh.trianglePatch = std::move(groups);
  const Vec3 centre = moveToCentre(mesh);
  ReferenceSurface reference(mesh, featureRulesOf(options), centre);
  co_await reference.prepare(work);
  const RemeshLengths lengths = remeshLengthsOf(options, options.size > 0.0, reference.diagonal());
  work.beginPart(0.6);
  TargetField targets = co_await findTargetField(work, reference, {}, given, options, lengths);
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
  result.tetrahedra =
      expectedTetrahedra(mesh, SizeField::fromOctree(builder.take()), result.triangles);
  co_return result;
}

namespace {

struct RemeshInput {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> groups;
  BackgroundGrid grid;
  RegionSizes regionSizes;
  RemeshOptions options;
  std::vector<double> model;
  bool isStopped = false;
};

RemeshInput inputOf(std::span<const double> points, std::span<const std::uint32_t> triangles,
                    std::span<const std::uint32_t> groups, BackgroundGrid grid,
                    const RemeshOptions& options, const GivenRegions& regions,
                    std::span<const double> model) {
  RemeshInput input;
  input.mesh.triangleRegions = regions.triangleRegions;
  input.regionSizes = RegionSizes(regions);
  input.mesh.points.assign(points.begin(), points.end());
  input.mesh.triangles.assign(triangles.begin(), triangles.end());
  input.groups.assign(groups.begin(), groups.end());
  input.grid = std::move(grid);
  input.options = options;
  input.model.assign(model.begin(), model.end());
  return input;
}

}  // namespace

SurfaceRemesher::SurfaceRemesher(std::span<const double> points,
                                 std::span<const std::uint32_t> triangles,
                                 std::span<const std::uint32_t> groups, BackgroundGrid grid,
                                 const RemeshOptions& options, const GivenRegions& regions,
                                 std::span<const double> model)
    : SlicedTool(makeToolJob<SurfaceRemesh>(
          inputOf(points, triangles, groups, std::move(grid), options, regions, model),
          [](Work& work, RemeshInput& input) {
            const GivenSizes sizes{input.grid, input.regionSizes};
            return remeshSurface(work, input.mesh, input.groups, sizes, input.options,
                                 input.isStopped, input.model);
          })) {}

SurfaceSizeProposer::SurfaceSizeProposer(std::span<const double> points,
                                         std::span<const std::uint32_t> triangles,
                                         std::span<const std::uint32_t> groups,
                                         const RemeshOptions& options,
                                         std::span<const std::uint32_t> triangleRegions)
    : SlicedTool(makeToolJob<SurfaceSizeProposal>(
          inputOf(points, triangles, groups, {}, options,
                  {{triangleRegions.begin(), triangleRegions.end()}, {}}, {}),
          [](Work& work, RemeshInput& input) {
            return proposeSurfaceSizes(work, input.mesh, input.groups, input.options);
          })) {}

}  // namespace tetrafront
