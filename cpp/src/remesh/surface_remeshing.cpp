#include "remesh/surface_remeshing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "base/mesh_access.h"
#include "base/resumable.h"
#include "base/tool_job.h"
#include "boundary/boundary.h"
#include "boundary/surface_access.h"
#include "field/size_octree_builder.h"
#include "field/size_sites.h"
#include "geom/angles.h"
#include "geom/coordinates.h"
#include "quality/metrics.h"
#include "remesh/automatic_sizes.h"
#include "remesh/cusps.h"
#include "remesh/detail_merger.h"
#include "remesh/deviation.h"
#include "remesh/guarded_surface.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_schedule.h"
#include "remesh/remesh_sizes.h"
#include "remesh/surface_editor.h"
#include "remesh/volume_correction.h"
#include "sizing/check_options.h"
#include "sizing/expected_count.h"
#include "sizing/target_sizes.h"
#include "sizing/volume_sizes.h"

namespace tetrafront {
namespace {

// Automatic lengths / diagonal of the surface, or / size.
constexpr double kMaxSizePerDiagonal = 1.0 / 20.0;
constexpr double kMinSizePerDiagonal = 1.0 / 300.0;
constexpr double kMinSizePerSize = 0.1;
/// Smallest sizes at short feature lines and at narrow gaps / smallest automatic size. Triangles around a short line grow
/// quickly and are few; along a gap there are many.
constexpr double kLineSizePerMinSize = 1.0 / 1000.0;
constexpr double kGapSizePerMinSize = 1.0 / 25.0;
/// Upper bound of the triangles that one size below the smallest one adds. Around a point at which the size is 1/1000 of
/// the smallest, and from which it grows by 0.3 per unit of distance, there are about 900.
constexpr double kTrianglesPerDetail = 1000.0;
constexpr double kTolerancePerDiagonal = 1.0 / 700.0;
constexpr double kTolerancePerSize = 0.05;
constexpr double kDegreesPerEdge = 20.0;
/// Angle per edge if sizes are given: a coarse limit that keeps round shapes round.
constexpr double kCoarseDegreesPerEdge = 60.0;
/// Turn of a feature line, in degrees, at which it has a corner.
constexpr double kCornerDegrees = 50.0;
/// The checks of a change use this fraction of the tolerance. From the remeshed surface to the
/// given one, they hold for every point. In the other direction they test the guests only, and
/// between them the distance may be slightly larger.
constexpr double kTestedTolerance = 0.85;
/// Deviation that sizes aim at / tolerance: changes need some room.
constexpr double kPlannedTolerance = 0.7;
/// Deviation of the longest edges at a cusp from their feature lines / tested tolerance. Edges are between .75 and 1.4 times
/// their target length, and those that would leave the tolerance are not made.
constexpr double kCuspTolerance = 1.25;
/// Largest edge at a cusp / size that follows from the shape without gaps.
constexpr double kCuspPerSize = 1.6;
/// Relative error of the sizes that the shape asks for.
constexpr float kSlack = 0.01F;
/// Sizes sorted per unit of budget.
constexpr std::size_t kSitesPerUnit = 32;
/// Area of an equilateral triangle, in squared edge lengths.
constexpr double kTriangleArea = 0.4330127018922193;

/// The lengths of a remeshing, with all automatic values replaced.
struct Lengths {
  double maxSize;
  double minSize;
  double minSizeAtLines;
  double minSizeAtGaps;
  double tolerance;
  double radiansPerEdge;
  double layers;
};

Lengths lengthsOf(const RemeshOptions& options, bool hasTargets, double diagonal) {
  const bool hasSize = options.size > 0.0;
  Lengths lengths{};
  lengths.maxSize = options.maxSize > 0.0 ? options.maxSize : kMaxSizePerDiagonal * diagonal;
  if (hasTargets) lengths.maxSize = hasSize ? options.size : diagonal;
  if (options.maxVolume > 0.0) {
    lengths.maxSize = std::min(lengths.maxSize, sizeForVolume(options.maxVolume));
  }
  lengths.minSize = hasSize ? kMinSizePerSize * options.size : kMinSizePerDiagonal * diagonal;
  if (options.minSize > 0.0) lengths.minSize = options.minSize;
  lengths.minSize = std::min(lengths.minSize, lengths.maxSize);
  const bool isExact = options.minSize > 0.0;
  lengths.minSizeAtLines = (isExact ? 1.0 : kLineSizePerMinSize) * lengths.minSize;
  lengths.minSizeAtGaps = (isExact ? 1.0 : kGapSizePerMinSize) * lengths.minSize;
  lengths.tolerance = kTolerancePerDiagonal * diagonal;
  if (hasSize) lengths.tolerance = std::min(lengths.tolerance, kTolerancePerSize * options.size);
  if (options.tolerance > 0.0) lengths.tolerance = options.tolerance;
  const double automatic = hasTargets ? kCoarseDegreesPerEdge : kDegreesPerEdge;
  lengths.radiansPerEdge = radians(options.anglePerEdge > 0.0 ? options.anglePerEdge : automatic);
  lengths.layers = options.layers;
  if (options.layers < 0.0) lengths.layers = hasTargets ? 0.0 : 1.0;
  return lengths;
}

MeshOptions targetOptions(const RemeshOptions& options) {
  MeshOptions targets;
  targets.size = options.size;
  targets.growth = options.growth;
  targets.maxVolume = options.maxVolume;
  return targets;
}

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

/// Returns the number of triangles of one size that cover an area.
double trianglesOn(double area, double size) { return area / (kTriangleArea * size * size); }

double areaOf(const ReferenceSurface& reference) {
  double sum = 0.0;
  for (const ReferenceSurface::Piece& piece : reference.pieces()) sum += piece.area;
  return sum;
}

/// Counts the triangles that the sizes ask for, per given triangle. O(pieces).
std::vector<double> countExpected(const ReferenceSurface& reference, const RemeshSizes& sizes) {
  std::vector<double> expected(countTriangles(reference.mesh()), 0.0);
  RemeshSizes::Hint hint;
  for (const ReferenceSurface::Piece& piece : reference.pieces()) {
    expected[piece.triangle.index()] += trianglesOn(piece.area, sizes.sizeAt(piece.centroid, hint));
  }
  return expected;
}

/// Returns kTooManyElements if the sizes ask for more triangles than the limit, and than there are.
std::vector<Diagnostic> checkTriangleCount(const ReferenceSurface& reference,
                                           std::span<const double> expected,
                                           std::uint32_t maxTriangles) {
  const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
  const double limit = std::max(static_cast<double>(maxTriangles),
                                static_cast<double>(countTriangles(reference.mesh())));
  if (total <= limit) return {};
  Diagnostic tooMany;
  tooMany.code = DiagnosticCode::kTooManyElements;
  const auto most = std::max_element(expected.begin(), expected.end()) - expected.begin();
  tooMany.entities = {{EntityKind::kTriangle, static_cast<std::uint32_t>(most)}};
  tooMany.values = {cappedCount(total), limit};
  return {tooMany};
}

/// Returns the cusps. Their edges may exceed the sizes that curvature, thickness and short lines ask for by a factor only:
/// a small hole near the tip keeps its triangles.
Task<std::vector<Cusp>> findLimitedCusps(Work& work, const ReferenceSurface& reference,
                                         const ShapeSizes& sizes, const RemeshOptions& options,
                                         const Lengths& lengths) {
  const CuspRules rules{lengths.minSize, lengths.maxSize,
                        kCuspTolerance * kTestedTolerance * lengths.tolerance};
  std::vector<Cusp> cusps = findCusps(reference, rules);
  co_await work.yield();
  const std::size_t count = sizes.countWithoutGaps;
  if (cusps.empty() || count == 0) co_return cusps;
  SizeSites sites(std::span(sizes.positions).first(count), std::span(sizes.sizes).first(count),
                  options.growth, kSlack);
  co_await work.finish(sites, kSitesPerUnit);
  for (Cusp& cusp : cusps) {
    cusp.reach = std::min(cusp.reach, kCuspPerSize * sites.at(cusp.tip, SiteId(0U)).size);
  }
  co_return cusps;
}

struct TargetField {
  std::optional<RemeshSizes> sizes;
  std::vector<Diagnostic> diagnostics;  ///< not empty if the grid or the sizes cannot be used
};

/// Makes the size field: given sizes, capped by those of the shape. Too many triangles are refused as soon as the sizes
/// are known: work on the shape takes longer if they are small.
Task<TargetField> findTargetField(Work& work, const ReferenceSurface& reference,
                                  const BackgroundGrid& grid, const RemeshOptions& options,
                                  const Lengths& lengths) {
  MeshOptions targets = targetOptions(options);
  if (!usesGrid(grid, targets)) targets.size = lengths.maxSize;
  work.beginPart(0.2);
  TargetSizes given(reference.mesh(), grid, targets, EdgeSizes::kIgnored);
  co_await work.finish(given);
  TargetField found;
  found.diagnostics = given.diagnostics();
  if (anyError(found.diagnostics)) co_return found;
  found.sizes.emplace(given.take());
  const std::vector<double> ofGiven = countExpected(reference, *found.sizes);
  found.diagnostics = checkTriangleCount(reference, ofGiven, options.maxTriangles);
  if (!found.diagnostics.empty()) co_return found;
  co_await work.yield();

  work.beginPart(0.7);
  const ShapeSizeRules rules{lengths.maxSize,
                             lengths.minSize,
                             lengths.minSizeAtLines,
                             lengths.minSizeAtGaps,
                             kPlannedTolerance * lengths.tolerance,
                             lengths.radiansPerEdge,
                             lengths.layers};
  ShapeSizes sizes = co_await findShapeSizes(work, reference, rules);
  if (sizes.positions.empty()) co_return found;
  work.beginPart(0.8);
  std::vector<Cusp> cusps = co_await findLimitedCusps(work, reference, sizes, options, lengths);
  work.beginPart(1.0);
  const std::size_t belowMin = sizes.countBelowMin;
  SizeSites sites(sizes.positions, sizes.sizes, options.growth, kSlack);
  co_await work.finish(sites, kSitesPerUnit);
  found.sizes->capTo(std::move(sites), std::move(sizes.axes));
  found.sizes->raiseTo(CuspSizes(std::move(cusps)));
  // Counting takes longer than this bound, which only very many small details exceed without need.
  const double most = std::accumulate(ofGiven.begin(), ofGiven.end(), 0.0) +
                      trianglesOn(areaOf(reference), lengths.minSize) +
                      kTrianglesPerDetail * static_cast<double>(belowMin);
  if (most > static_cast<double>(options.maxTriangles)) {
    found.diagnostics =
        checkTriangleCount(reference, countExpected(reference, *found.sizes), options.maxTriangles);
  }
  co_await work.yield();
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
  const Lengths lengths = lengthsOf(options, hasTargets, reference.diagonal());

  work.beginPart(0.15);
  TargetField targets = co_await findTargetField(work, reference, grid, options, lengths);
  if (!targets.diagnostics.empty()) co_return refused(std::move(targets.diagnostics));

  work.beginPart(0.9);
  SurfaceLimits limits;
  limits.tolerance = kTestedTolerance * lengths.tolerance;
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
  const Lengths lengths = lengthsOf(options, options.size > 0.0, reference.diagonal());
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
