#include "sizing/target_sizes.h"

#include <algorithm>
#include <utility>

#include "base/diagnostics.h"
#include "field/check_background_grid.h"
#include "field/grid_locator_builder.h"
#include "field/size_octree_builder.h"
#include "sizing/surface_coverage.h"
#include "sizing/volume_sizes.h"
#include "topology/surface_access.h"

namespace tetrafront {

bool usesGrid(const BackgroundGrid& grid, const MeshOptions& options) {
  return !(options.size > 0.0) && (!grid.nodes.empty() || !grid.tetrahedra.empty());
}

bool hasTargetSizes(const BackgroundGrid& grid, const MeshOptions& options) {
  return options.size > 0.0 || options.maxVolume > 0.0 || usesGrid(grid, options) ||
         !grid.sources.empty();
}

Task<std::vector<Diagnostic>> checkTargetGrid(Work& work, const BackgroundGrid& grid,
                                              const MeshOptions& options) {
  return checkBackgroundGrid(work, grid,
                             usesGrid(grid, options) ? GridPart::kWhole : GridPart::kSources);
}

std::vector<Diagnostic> checkLargestSize(const SurfaceMesh& surface, double size) {
  const Bounds bounds = boundsOf(surface);
  const Vec3 edges = bounds.high - bounds.low;
  const double largest = std::max({edges.x, edges.y, edges.z});
  if (!(size > largest)) return {};
  return {diagnose<DiagnosticCode::kSizeTooLarge>(size, largest).withSeverity(Severity::kWarning)};
}

SizeField explicitTargetSizes(const BackgroundGrid& grid, const MeshOptions& options) {
  // Magnitudes of coordinates are 2^-100 to 1e30. These limits lie beyond any size that can be meshed, and their
  // cubes, which the inversion of a tensor computes, are still finite.
  constexpr double kMinSize = 1e-60;
  constexpr double kMaxSize = 1e60;
  SizeField sizes = SizeField::uniform(
      options.size > 0.0 ? std::clamp(options.size, kMinSize, kMaxSize) : kMaxSize);
  sizes.addSources(grid.sources);
  sizes.capSizes(sizeForVolume(options.maxVolume), {});
  return sizes;
}

Task<> TargetSizes::makeField(Work& work) {
  if (usesGrid(grid_, options_)) {
    co_await locateGrid(work);
    co_await checkCoverage(work);
  } else if (edgeSizes_ == EdgeSizes::kCount) {
    co_await measureEdges(work);
  } else {
    field_ = explicitTargetSizes(grid_, options_);
  }
  field_->capSizes(sizeForVolume(options_.maxVolume), {});
}

Task<> TargetSizes::locateGrid(Work& work) {
  work.beginPart(0.5);
  GridLocator locator = co_await buildGridLocator(work, grid_, options_.gradation - 1.0);
  field_ = SizeField::fromGrid(std::move(locator));
  field_->addSources(grid_.sources);
}

Task<> TargetSizes::checkCoverage(Work& work) {
  work.beginPart(1.0);
  SurfaceCoverage coverage(surface_, *field_);
  co_await work.finish(coverage);
  diagnostics_ = coverage.diagnostics();
}

Task<> TargetSizes::measureEdges(Work& work) {
  SizeOctreeBuilder builder(pointsOf(surface_), surface_.triangles, options_.growth, options_.size);
  co_await work.finish(builder);
  field_ = SizeField::fromOctree(builder.take());
  field_->addSources(grid_.sources);
}

double metricLengthAt(const SizeField& field, const Vec3& position, const Vec3& edge,
                      FieldHint& hint) {
  if (!field.isStretched()) return glm::length(edge) / field.targetSizeAt(position, hint);
  return glm::length(field.targetTensorAt(position, hint).inverse() * edge);
}

double metricLength(const SizeField& field, const Vec3& a, const Vec3& b, FieldHint& hint) {
  const Vec3 edge = b - a;
  return (metricLengthAt(field, a, edge, hint) +
          4.0 * metricLengthAt(field, 0.5 * (a + b), edge, hint) +
          metricLengthAt(field, b, edge, hint)) /
         6.0;
}

}  // namespace tetrafront
