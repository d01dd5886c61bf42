#include "sizing/surface_coverage.h"

#include <array>

#include "base/diagnostics.h"
#include "topology/surface_access.h"

namespace tetrafront {

/// The items of the pass are the nodes, then the triangles.
bool SurfaceCoverage::advance(std::uint32_t budget) {
  const std::size_t nodes = surface_.points.size() / 3;
  const auto [first, last] = take(budget);
  for (std::size_t i = first; i < last; ++i) {
    if (i < nodes) {
      const NodeId node(i);
      check(pointOf(surface_, node), entityOf(node));
    } else {
      const TriangleId triangle(i - nodes);
      const auto [a, b, c] = cornersOf(surface_, triangle);
      check((a + b + c) * (1.0 / 3.0), entityOf(triangle));
    }
  }
  return isPassDone();
}

std::vector<Diagnostic> SurfaceCoverage::diagnostics() const {
  if (outside_ == 0) return {};
  return {diagnose<DiagnosticCode::kOutsideBackgroundGrid>(outside_).about({first_}).at(
      firstPosition_)};
}

void SurfaceCoverage::check(const Vec3& position, const Entity& entity) {
  if (field_.covers(position, hint_)) return;
  if (outside_++ > 0) return;
  first_ = entity;
  firstPosition_ = position;
}

}  // namespace tetrafront
