#include "tetrafront/mesh_improvement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/diagnostics.h"
#include "base/ids.h"
#include "base/tool_job.h"
#include "field/grid_locator_builder.h"
#include "field/size_field.h"
#include "geom/coordinates.h"
#include "optimize/element_cost.h"
#include "optimize/given_mesh.h"
#include "optimize/locality.h"
#include "optimize/optimizer.h"
#include "quality/metrics.h"
#include "quality/quality_analysis.h"
#include "quality/verify_mesh.h"
#include "tetrafront/grid_from_mesh.h"
#include "topology/mesh_access.h"
#include "topology/tet_mesh.h"

namespace tetrafront {
namespace {

/// What MeshImprover was given.
struct ImproverInput {
  VolumeMesh mesh;
  std::vector<std::uint32_t> keptTriangles;
  ImproveOptions options;
  bool isStopped = false;
};

bool hasNodesAndElements(const VolumeMesh& mesh) {
  return mesh.points.size() % 3 == 0 && mesh.tetrahedra.size() % 4 == 0 &&
         !mesh.tetrahedra.empty() &&
         (mesh.regions.empty() || mesh.regions.size() == countTetrahedra(mesh)) &&
         std::ranges::all_of(mesh.points,
                             [](double x) { return std::fabs(x) <= kLargestCoordinate; });
}

bool isUsable(const ImproverInput& input) {
  const std::size_t nodes = countNodes(input.mesh);
  const auto exists = [nodes](std::uint32_t node) { return node < nodes; };
  return hasNodesAndElements(input.mesh) && input.options.maxGrowth >= 0.0 &&
         input.keptTriangles.size() % 3 == 0 &&
         std::ranges::all_of(input.mesh.tetrahedra, exists) &&
         std::ranges::all_of(input.keptTriangles, exists);
}

Task<MeshShapes> measureShapes(Work& work, const VolumeMesh& mesh, const SurfaceMesh& surface) {
  VolumeMesh ofOneRegion = mesh;
  ofOneRegion.regions.assign(countTetrahedra(mesh), 0);
  const SizeField field = SizeField::uniform(1.0);
  QualityAnalysis analysis(ofOneRegion, surface, field);
  co_await work.finish(analysis);
  MeshShapes shapes;
  shapes.nodes = countNodes(mesh);
  shapes.tetrahedra = countTetrahedra(mesh);
  shapes.quality = analysis.summary();
  shapes.limitedByBoundary = analysis.statistics().limitedByBoundary;
  shapes.outOfRange = analysis.statistics().outOfRange + shapes.limitedByBoundary;
  co_return shapes;
}

Task<SizeField> fieldOfOwnEdges(Work& work, const VolumeMesh& mesh) {
  MeshGridBuilder grid(mesh, {});
  work.beginPart(0.3);
  co_await work.finish(grid);
  work.beginPart(1.0);
  GridLocator locator =
      co_await buildGridLocator(work, grid.result(), MeshOptions{}.gradation - 1.0);
  co_return SizeField::fromGrid(std::move(locator));
}

/// Smallest difference that counts: above the rounding of a measure.
constexpr double kMinDifference = 1e-9;

/// Returns how much better `after` is: the least gain of all measures, and the largest.
struct Gains {
  double least;
  double largest;
};
Gains gainsBetween(const MeshShapes& before, const MeshShapes& after) {
  const auto share = [](const MeshShapes& shapes) {
    return static_cast<double>(shapes.outOfRange) / static_cast<double>(shapes.tetrahedra);
  };
  const auto [least, largest] =
      std::minmax({after.quality.minDihedral - before.quality.minDihedral,
                   after.quality.minRadiusRatio - before.quality.minRadiusRatio,
                   before.quality.maxDihedral - after.quality.maxDihedral,
                   after.quality.meanRadiusRatio - before.quality.meanRadiusRatio,
                   share(before) - share(after)});
  return {least, largest};
}

bool isBetter(const MeshShapes& before, const MeshShapes& after) {
  const Gains gains = gainsBetween(before, after);
  return gains.least > -kMinDifference && gains.largest > kMinDifference;
}

/// Proves that the mesh is valid and has the kept faces. A defect is a mistake of the engine.
Task<bool> isProved(Work& work, const VolumeMesh& mesh, const GivenMesh& given,
                    std::vector<Diagnostic>& diagnostics) {
  MeshVerifier verifier(mesh, given.surface);
  co_await work.finish(verifier);
  const MeshDefects& defects = verifier.defects();
  // The given mesh may have coincident nodes.
  const std::uint64_t count = defects.count() - defects.coincidentNodes;
  if (count == 0) co_return true;
  diagnostics.push_back(
      diagnose<DiagnosticCode::kVerificationFailed>(count).about(defects.examples));
  co_return false;
}

/// A mesh and its shapes.
struct Attempt {
  VolumeMesh mesh;
  MeshShapes shapes;
  bool isGrowthLimited = false;
};

/// Returns this many elements with that growth.
std::size_t grown(std::uint32_t elements, double growth) {
  const double most = static_cast<double>(elements) * (1.0 + growth);
  return static_cast<std::size_t>(std::min(most, double{kNoIndex}));
}

/// Returns the worst values of the elements. Degrees would not do: the arc cosine differs between libraries. O(elements).
ElementLimits worstOf(const VolumeMesh& mesh) {
  // An element that only has another order of nodes must not be beyond the limits.
  constexpr double kRounding = 1e-12;
  ElementLimits worst{.leastRadiusRatio = 1.0, .greatestCosine = -1.0, .leastCosine = 1.0};
  for (const TetId tet : IdRange<TetId>(countTetrahedra(mesh))) {
    const TetrahedronMeasures measures = measureTetrahedron(cornersOf(mesh, tet));
    worst.leastRadiusRatio = std::min(worst.leastRadiusRatio, measures.radiusRatio);
    worst.greatestCosine = std::max(worst.greatestCosine, measures.largestCosine);
    worst.leastCosine = std::min(worst.leastCosine, measures.smallestCosine);
  }
  return {.leastRadiusRatio = worst.leastRadiusRatio * (1.0 - kRounding),
          .greatestCosine = worst.greatestCosine + kRounding,
          .leastCosine = worst.leastCosine - kRounding};
}

MeshLimits limitsOf(const VolumeMesh& given, const MeshShapes& before, double maxGrowth) {
  return {.ofElements = worstOf(given),
          .elements = grown(before.tetrahedra, std::max(0.0, maxGrowth - kGrowthForPoor)),
          .elementsWithRepairs = grown(before.tetrahedra, maxGrowth)};
}

/// Tries to improve the mesh by the given level; then, if some measure is worse, with caution.
Task<Attempt> bestAttempt(Work& work, const GivenMesh& given, const MeshShapes& before,
                          const ImproverInput& input) {
  work.beginPart(0.05);
  const SizeField field = co_await fieldOfOwnEdges(work, given.mesh);
  work.beginPart(0.1);
  TetMesh ordered = toTetMesh(given.mesh, given.keptNodes);
  co_await orderAlongMortonCurve(work, ordered);
  const MeshLimits limits = limitsOf(given.mesh, before, input.options.maxGrowth);
  Attempt made;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const bool isCautious = attempt == 1;
    work.beginPart(isCautious ? 0.95 : 0.65);
    MeshOptimizer optimizer =
        isCautious ? MeshOptimizer::cautious(ordered, field, limits)
                   : MeshOptimizer(ordered, field, input.options.optimization, limits);
    Job<> optimizing([&optimizer](Work& inner) { return optimizer.run(inner); });
    co_await finishUnlessStopped(work, optimizing, input.isStopped);
    made.mesh = toVolumeMesh(optimizer.take());
    made.isGrowthLimited = optimizer.hasRefusedGrowth();
    work.beginPart(isCautious ? 1.0 : 0.7);
    made.shapes = co_await measureShapes(work, made.mesh, given.surface);
    if (input.isStopped || isBetter(before, made.shapes)) break;
  }
  co_return made;
}

/// Moves a mesh of parts to the result.
void takeMesh(VolumeMesh&& mesh, const GivenMesh& given, MeshImprovement& out) {
  out.points = std::move(mesh.points);
  out.tetrahedra = std::move(mesh.tetrahedra);
  out.regions.reserve(mesh.regions.size());
  for (const std::uint32_t part : mesh.regions) out.regions.push_back(given.regionOfPart[part]);
  out.nodeOrigin = given.nodeOrigin;
  if (!out.isImproved) return;
  out.nodeOrigin.resize(given.keptNodes);
  out.nodeOrigin.resize(out.points.size() / 3, kNoIndex);
}

Task<MeshImprovement> improve(Work& work, ImproverInput& input) {
  MeshImprovement out;
  out.isReadable = isUsable(input);
  if (!out.isReadable) co_return out;
  input.mesh.regions.resize(countTetrahedra(input.mesh), 0);
  work.beginPart(0.1);
  GivenMesh given = co_await prepareGivenMesh(work, input.mesh, input.keptTriangles);
  out.orientedTetrahedra = given.orientedTetrahedra;
  out.diagnostics = given.diagnostics;
  if (anyError(out.diagnostics)) co_return out;
  work.beginPart(0.12);
  out.before = co_await measureShapes(work, given.mesh, given.surface);
  work.beginPart(0.98);
  Attempt made = co_await bestAttempt(work, given, out.before, input);
  out.isPartial = input.isStopped;
  out.isGrowthLimited = made.isGrowthLimited;
  out.isImproved = isBetter(out.before, made.shapes);
  if (out.isImproved) {
    work.beginPart(1.0);
    const bool isValid = co_await isProved(work, made.mesh, given, out.diagnostics);
    if (!isValid) co_return out;
    out.after = made.shapes;
    takeMesh(std::move(made.mesh), given, out);
  } else {
    out.after = out.before;
    takeMesh(VolumeMesh(given.mesh), given, out);
  }
  co_return out;
}

ImproverInput copyOf(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
                     std::span<const std::uint32_t> regions,
                     std::span<const std::uint32_t> keptTriangles, const ImproveOptions& options) {
  ImproverInput input;
  input.mesh.points.assign(points.begin(), points.end());
  input.mesh.tetrahedra.assign(tetrahedra.begin(), tetrahedra.end());
  input.mesh.regions.assign(regions.begin(), regions.end());
  input.keptTriangles.assign(keptTriangles.begin(), keptTriangles.end());
  input.options = options;
  return input;
}

}  // namespace

MeshImprover::MeshImprover(std::span<const double> points,
                           std::span<const std::uint32_t> tetrahedra,
                           std::span<const std::uint32_t> regions,
                           std::span<const std::uint32_t> keptTriangles,
                           const ImproveOptions& options)
    : SlicedTool(makeToolJob<MeshImprovement>(
          copyOf(points, tetrahedra, regions, keptTriangles, options), improve)) {}

}  // namespace tetrafront
