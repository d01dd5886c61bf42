#include "sizing/target_sizes.h"

#include <algorithm>
#include <utility>

#include "boundary/surface_access.h"

namespace tetrafront {

bool usesGrid(const BackgroundGrid& grid, const MeshOptions& options) {
  return !(options.size > 0.0) && (!grid.nodes.empty() || !grid.tetrahedra.empty());
}

bool hasTargetSizes(const BackgroundGrid& grid, const MeshOptions& options) {
  return options.size > 0.0 || usesGrid(grid, options) || !grid.sources.empty();
}

BackgroundGridCheck targetSizeCheck(const BackgroundGrid& grid, const MeshOptions& options) {
  return BackgroundGridCheck(grid, usesGrid(grid, options) ? GridPart::kWhole : GridPart::kSources);
}

std::vector<Diagnostic> checkLargestSize(const SurfaceMesh& surface, double size) {
  std::vector<Diagnostic> found;
  Vec3 low = pointOf(surface, NodeId(surface.triangles[0]));
  Vec3 high = low;
  for (const std::uint32_t node : surface.triangles) {
    low = glm::min(low, pointOf(surface, NodeId(node)));
    high = glm::max(high, pointOf(surface, NodeId(node)));
  }
  const Vec3 across = high - low;
  const double extent = std::max({across.x, across.y, across.z});
  if (!(size > extent)) return found;
  Diagnostic& tooLarge = found.emplace_back();
  tooLarge.code = DiagnosticCode::kSizeTooLarge;
  tooLarge.severity = Severity::kWarning;
  tooLarge.values = {size, extent};
  return found;
}

SizeField explicitTargetSizes(const BackgroundGrid& grid, const MeshOptions& options) {
  // Coordinates have magnitudes from 2^-100 to 1e30: these are beyond any size that can be meshed, and
  // their cubes, which inverting a tensor takes, are numbers still.
  constexpr double kLeast = 1e-60;
  constexpr double kMost = 1e60;
  SizeField asked =
      SizeField::uniform(options.size > 0.0 ? std::clamp(options.size, kLeast, kMost) : kMost);
  asked.addSources(grid.sources);
  return asked;
}

TargetSizes::TargetSizes(const SurfaceMesh& surface, const BackgroundGrid& grid,
                         const MeshOptions& options, EdgeSizes own)
    : grid_(grid), surface_(surface) {
  if (usesGrid(grid, options)) {
    locator_.emplace(grid, options.gradation - 1.0);
  } else if (own == EdgeSizes::kIgnored) {
    field_ = explicitTargetSizes(grid, options);
  } else {
    builder_.emplace(pointsOf(surface), surface.triangles, options.growth, options.size);
  }
}

bool TargetSizes::advance(std::uint32_t budget) {
  if (locator_) {
    if (!locator_->advance(budget)) return false;
    field_ = SizeField::fromGrid(locator_->take());
    field_->addSources(grid_.sources);
    locator_.reset();
    coverage_.emplace(surface_, *field_);
    return false;
  }
  if (coverage_) return coverage_->advance(budget);
  if (!builder_) return true;
  if (!builder_->advance(budget)) return false;
  field_ = SizeField::fromOctree(builder_->take());
  field_->addSources(grid_.sources);
  builder_.reset();
  return true;
}

std::vector<Diagnostic> TargetSizes::diagnostics() const {
  return coverage_ ? coverage_->diagnostics() : std::vector<Diagnostic>{};
}

SizeField TargetSizes::take() { return std::move(*field_); }

double metricLengthAt(const SizeField& field, const Vec3& place, const Vec3& edge,
                      FieldHint& hint) {
  if (!field.isStretched()) return glm::length(edge) / field.wantedSizeAt(place, hint);
  return glm::length(field.wantedTensorAt(place, hint).inverse() * edge);
}

double metricLength(const SizeField& field, const Vec3& a, const Vec3& b, FieldHint& hint) {
  const Vec3 edge = b - a;
  return (metricLengthAt(field, a, edge, hint) +
          4.0 * metricLengthAt(field, 0.5 * (a + b), edge, hint) +
          metricLengthAt(field, b, edge, hint)) /
         6.0;
}

}  // namespace tetrafront
