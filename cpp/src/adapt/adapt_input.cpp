#include "adapt/adapt_input.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "geom/coordinates.h"
#include "metric/metric.h"

namespace tetrafront {
namespace {

bool areCoordinates(std::span<const double> points) {
  return points.size() % 3 == 0 &&
         std::ranges::all_of(points, [](double x) { return std::fabs(x) <= kLargestCoordinate; });
}

bool areIndices(std::span<const std::uint32_t> nodes, std::size_t perItem, std::size_t points) {
  return nodes.size() % perItem == 0 &&
         std::ranges::all_of(nodes, [points](std::uint32_t node) { return node < points; });
}

bool areMetrics(std::span<const double> metrics, std::size_t nodes) {
  if (metrics.size() != kTensorNumbers * nodes) return false;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (!isMetric(tensorAt(metrics, i))) return false;
  }
  return true;
}

}  // namespace

bool isUsable(const AdaptInput& mesh) {
  return areCoordinates(mesh.points) && areIndices(mesh.tetrahedra, 4, mesh.points.size() / 3) &&
         areIndices(mesh.triangles, 3, mesh.points.size() / 3) && !mesh.tetrahedra.empty() &&
         (mesh.regions.empty() || 4 * mesh.regions.size() == mesh.tetrahedra.size()) &&
         (mesh.trianglePatch.empty() || 3 * mesh.trianglePatch.size() == mesh.triangles.size());
}

bool isUsable(const MetricMesh& background) {
  const std::size_t nodes = background.points.size() / 3;
  return areCoordinates(background.points) && areIndices(background.tetrahedra, 4, nodes) &&
         !background.tetrahedra.empty() && areMetrics(background.metrics, nodes);
}

bool isUsable(const AdaptOptions& options) {
  return options.leastQuality >= 0.0 && options.leastQuality <= 1.0;
}

BackgroundGrid locatorGridOf(const MetricMesh& mesh) {
  BackgroundGrid grid;
  grid.nodes.resize(mesh.points.size() / 3);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    const double* const at = &mesh.points[3 * i];
    grid.nodes[i] = {.position = Vec3(at[0], at[1], at[2]), .size = 1.0};
  }
  grid.tetrahedra.resize(mesh.tetrahedra.size() / 4);
  for (std::size_t t = 0; t < grid.tetrahedra.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) grid.tetrahedra[t][k] = mesh.tetrahedra[4 * t + k];
  }
  return grid;
}

}  // namespace tetrafront
