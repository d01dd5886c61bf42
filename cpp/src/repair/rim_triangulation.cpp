#include "repair/rim_triangulation.h"

#include <utility>

#include "geom/predicates.h"
#include "topology/surface_access.h"

namespace tetrafront {

RimTriangulation::RimTriangulation(const SurfaceMesh& mesh, Rim rim)
    : mesh_(mesh),
      rim_(std::move(rim)),
      cost_(rim_.size() * rim_.size(), 0.0),
      apex_(rim_.size() * rim_.size(), 0) {}

NumberedTriangle RimTriangulation::triangleOf(const Corners& corners) const {
  const NodeId a = rim_[corners.last];
  const NodeId b = rim_[corners.apex];
  const NodeId c = rim_[corners.first];
  return {{a.value, b.value, c.value}, {pointOf(mesh_, a), pointOf(mesh_, b), pointOf(mesh_, c)}};
}

void RimTriangulation::exclude(const Corners& corners) {
  const std::size_t count = rim_.size();
  if (isExcluded_.empty()) isExcluded_.assign(count * count * count, false);
  isExcluded_[at(corners)] = true;
}

void RimTriangulation::chooseApex(std::size_t first, std::size_t last) {
  const Vec3 a = pointOf(mesh_, rim_[first]);
  const Vec3 b = pointOf(mesh_, rim_[last]);
  double& least = cost_[at(first, last)];
  for (std::size_t apex = first + 1; apex < last; ++apex) {
    const double rest = cost_[at(first, apex)] + cost_[at(apex, last)];
    if (!(rest < least)) continue;
    const Vec3 c = pointOf(mesh_, rim_[apex]);
    const double cost = rest + glm::length(glm::cross(b - a, c - a));
    if (!(cost < least) || collinear(a, b, c)) continue;
    if (!isExcluded_.empty() && isExcluded_[at({first, apex, last})]) continue;
    least = cost;
    apex_[at(first, last)] = apex;
  }
}

std::vector<RimTriangulation::Corners> RimTriangulation::chosen() const {
  std::vector<Corners> triangles;
  const std::size_t count = rim_.size();
  const bool exists =
      count >= 3 && cost_[at(0, count - 1)] < std::numeric_limits<double>::infinity();
  if (!exists) return triangles;
  struct Chord {
    std::size_t first;
    std::size_t last;
  };
  std::vector<Chord> waiting{{0, count - 1}};
  while (!waiting.empty()) {
    const auto [first, last] = waiting.back();
    waiting.pop_back();
    if (last - first < 2) continue;
    const std::size_t apex = apex_[at(first, last)];
    triangles.push_back({first, apex, last});
    waiting.push_back({apex, last});
    waiting.push_back({first, apex});
  }
  return triangles;
}

}  // namespace tetrafront
