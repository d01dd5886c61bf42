#include "sizing/surface_coverage.h"

#include <algorithm>

namespace tetrafront {

bool SurfaceCoverage::advance(std::uint32_t budget) {
  const std::size_t nodes = surface_->points.size() / 3;
  const std::size_t places = nodes + surface_->triangles.size() / 3;
  const std::size_t last = seen_ + std::min<std::size_t>(budget, places - seen_);
  for (; seen_ < last; ++seen_) {
    const bool isNode = seen_ < nodes;
    const std::size_t index = isNode ? seen_ : seen_ - nodes;
    look(isNode ? placeOf(index) : middleOf(index),
         {isNode ? EntityKind::kSurfaceNode : EntityKind::kTriangle,
          static_cast<std::uint32_t>(index)});
  }
  return seen_ == places;
}

std::vector<Diagnostic> SurfaceCoverage::diagnostics() const {
  if (outside_ == 0) return {};
  Diagnostic diagnostic;
  diagnostic.code = DiagnosticCode::kOutsideBackgroundGrid;
  diagnostic.entities = {first_};
  diagnostic.hasPlace = true;
  diagnostic.place = firstPlace_;
  diagnostic.values = {static_cast<double>(outside_)};
  return {diagnostic};
}

Vec3 SurfaceCoverage::placeOf(std::size_t node) const {
  return {surface_->points[3 * node], surface_->points[3 * node + 1],
          surface_->points[3 * node + 2]};
}

Vec3 SurfaceCoverage::middleOf(std::size_t triangle) const {
  const std::uint32_t* corners = surface_->triangles.data() + 3 * triangle;
  return (placeOf(corners[0]) + placeOf(corners[1]) + placeOf(corners[2])) * (1.0 / 3.0);
}

void SurfaceCoverage::look(const Vec3& place, const Entity& entity) {
  if (field_->covers(place, hint_)) return;
  if (outside_++ > 0) return;
  first_ = entity;
  firstPlace_ = place;
}

}  // namespace tetrafront
