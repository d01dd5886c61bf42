#include "repair/surface_refinement.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/diagnostics.h"
#include "boundary/boundary_report.h"
#include "boundary/surface_checks.h"
#include "repair/edge_bisection.h"
#include "sizing/check_options.h"
#include "sizing/expected_count.h"
#include "sizing/target_sizes.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Typical area of the resulting triangles, in squared target lengths: right isosceles triangles have between a
/// quarter and a half.
constexpr double kTypicalArea = 0.36;
/// A mesh has at least this many tetrahedra per boundary triangle, unless the region is thin.
constexpr std::uint32_t kTetrahedraPerTriangle = 4;

SurfaceRefinement refused(std::vector<Diagnostic> diagnostics) {
  SurfaceRefinement result;
  result.diagnostics = std::move(diagnostics);
  return result;
}

/// Reports invalid numbers and triangles with a repeated node.
std::vector<Diagnostic> checkSurface(const SurfaceMesh& mesh) {
  BoundaryReport report(mesh, BoundarySource::kGivenSurface);
  checkNumbers(mesh, report);
  for (std::uint32_t t = 0; t < countTriangles(mesh) && !report.hasErrors(); ++t) {
    if (hasRepeatedNode(nodesOf(mesh, TriangleId(t)))) {
      report.addTriangle(diagnoseCounted<DiagnosticCode::kDegenerateTriangle>(), TriangleId(t));
    }
  }
  return report.take();
}

/// Returns what is wrong with the surface, the options and the grid.
Task<std::vector<Diagnostic>> check(Work& work, const SurfaceMesh& mesh, const BackgroundGrid& grid,
                                    const MeshOptions& options) {
  std::vector<Diagnostic> found = checkSurface(mesh);
  const std::vector<Diagnostic> ofOptions = checkOptions(options);
  found.insert(found.end(), ofOptions.begin(), ofOptions.end());
  co_await work.yield();
  const std::vector<Diagnostic> ofGrid = co_await checkTargetGrid(work, grid, options);
  found.insert(found.end(), ofGrid.begin(), ofGrid.end());
  co_return found;
}

struct FoundSizes {
  std::optional<SizeField> field;
  std::vector<Diagnostic> diagnostics;  ///< not empty if the grid does not cover the surface
};

Task<FoundSizes> findSizes(Work& work, const SurfaceMesh& mesh, const BackgroundGrid& grid,
                           const MeshOptions& options, const RegionSizes& regions) {
  // Without sizes, triangles follow those near them.
  const bool isGiven = hasTargetSizes(grid, options) || regions.areGiven();
  TargetSizes sizes(mesh, grid, options, isGiven ? EdgeSizes::kIgnored : EdgeSizes::kCount);
  co_await work.finish(sizes);
  FoundSizes found;
  found.diagnostics = sizes.diagnostics();
  if (found.diagnostics.empty()) {
    found.field.emplace(sizes.take());
    if (regions.areGiven()) regions.cap(*found.field, options.maxVolume);
  }
  co_return found;
}

/// Expected number of triangles of the result.
struct TriangleEstimate {
  double total = 0.0;
  double most = 0.0;  ///< of one given triangle
  TriangleId triangleWithMost{0U};
};

void addExpected(TriangleEstimate& estimate, const SurfaceMesh& mesh, TriangleId triangle,
                 const SizeField& field, FieldHint& hint) {
  const auto [a, b, c] = cornersOf(mesh, triangle);
  const SymmetricTensor toUnit = field.targetTensorAt((a + b + c) / 3.0, hint).inverse();
  const Vec3 ab = toUnit * (b - a);
  const Vec3 ac = toUnit * (c - a);
  const double longest = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
  const double area = 0.5 * glm::length(glm::cross(ab, ac));
  const double expected = longest <= kMaxEdgeLength ? 1.0 : std::max(1.0, area / kTypicalArea);
  estimate.total += expected;
  if (expected > estimate.most) {
    estimate.most = expected;
    estimate.triangleWithMost = triangle;
  }
}

}  // namespace

Task<SurfaceRefinement> refineSurface(Work& work, SurfaceMesh& mesh, const BackgroundGrid& grid,
                                      const MeshOptions& options, const RegionSizes& regions,
                                      double volume) {
  work.beginPart(0.05);
  std::vector<Diagnostic> problems = co_await check(work, mesh, grid, options);
  if (anyError(problems)) co_return refused(std::move(problems));
  work.beginPart(0.1);
  FoundSizes sizes = co_await findSizes(work, mesh, grid, options, regions);
  if (!sizes.field) co_return refused(std::move(sizes.diagnostics));
  const SizeField& field = *sizes.field;
  FieldHint hint;

  work.beginPart(0.15);
  TriangleEstimate estimate;
  co_await work.forEachBlock(countTriangles(mesh), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      hint.region = regions.regionOf(t);
      addExpected(estimate, mesh, TriangleId(t), field, hint);
    }
  });
  // The given triangles are never too many here: the mesher decides about them.
  const double maxTriangles =
      std::max(static_cast<double>(options.maxTetrahedra) / kTetrahedraPerTriangle,
               static_cast<double>(countTriangles(mesh)));
  const Entity demanding = entityOf(estimate.triangleWithMost);
  // Negated, so that NaN is refused too.
  if (!(estimate.total <= maxTriangles)) {
    co_return refused({tooManyElements(estimate.total, maxTriangles).about({demanding})});
  }
  if (volume > 0.0) {
    // The estimate of a run. The given triangles can only raise the number.
    const double expected = tetrahedraWithin(volume, mesh, field);
    const auto limit = static_cast<double>(options.maxTetrahedra);
    if (!(expected <= limit)) co_return refused({tooManyElements(expected, limit)});
  }
  co_await work.yield();

  TrackedSurface surface = trackedFrom(std::move(mesh));
  EdgeBisection bisection(surface, field, regions, hint);
  co_await work.yield();
  work.beginPart(0.25);
  co_await work.forEachBlock(bisection.edgeCount(), [&](std::size_t first, std::size_t last) {
    bisection.measureEdges(first, last);
  });
  work.beginPart(0.35);
  co_await work.forEachBlock(
      countTriangles(surface.mesh),
      [&](std::size_t first, std::size_t last) { bisection.measureTriangles(first, last); });
  const double lengthRatio = bisection.longest();
  work.beginPart(1.0);
  while (!bisection.advance(work.remaining(), maxTriangles)) {
    work.setFraction(std::min(1.0, countTriangles(surface.mesh) / estimate.total));
    co_await work.yield();
  }
  if (!bisection.isFinished()) {
    co_return refused(
        {tooManyElements(countTriangles(surface.mesh), maxTriangles).about({demanding})});
  }

  SurfaceRefinement result;
  moveTo(surface, result);
  result.splitEdges = bisection.bisectedEdges();
  result.lengthRatio = lengthRatio;
  co_return result;
}

}  // namespace tetrafront
