#include "sizing/most_demanding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/ids.h"
#include "field/grid_access.h"
#include "sizing/expected_count.h"
#include "sizing/target_sizes.h"

namespace tetrafront {
namespace {

/// Ratio of the sizes at the outer and the inner surface of one shell around a source.
constexpr double kSizeRatioOfShell = 1.25;

/// Measures of a point, segment or triangle. Steiner's formula gives the volume within a distance of it.
struct Measures {
  double length = 0.0;  ///< of the segment, or half the perimeter of the triangle
  double area = 0.0;

  [[nodiscard]] double volumeWithin(double distance) const {
    constexpr double kPi = std::numbers::pi;
    return 4.0 / 3.0 * kPi * distance * distance * distance + kPi * length * distance * distance +
           2.0 * area * distance;
  }
};

Measures measuresOf(const SizeSource& source) {
  const auto& [a, b, c] = source.points;
  switch (source.type) {
    case SourceType::kPoint:
      return {};
    case SourceType::kSegment:
      return {glm::length(b - a), 0.0};
    case SourceType::kTriangle:
      return {0.5 * (glm::length(b - a) + glm::length(c - b) + glm::length(a - c)),
              0.5 * glm::length(glm::cross(b - a, c - a))};
  }
  return {};
}

/// Returns the number of elements within `extent` of a source, where its size is below `limit`.
double elementsOf(const SizeSource& source, double extent, double limit) {
  if (!(source.size < limit)) return 0.0;
  const Measures measures = measuresOf(source);
  const auto elementsIn = [](double volume, double size) {
    return kTetrahedraPerUnitVolume * volume / (size * size * size);
  };
  double inner = source.growth > 0.0 ? std::min(source.distance, extent) : extent;
  double elements = elementsIn(measures.volumeWithin(inner), source.size);
  for (double size = source.size; inner < extent && size < limit; size *= kSizeRatioOfShell) {
    const double outer = std::min(extent, inner + (kSizeRatioOfShell - 1.0) * size / source.growth);
    elements += elementsIn(measures.volumeWithin(outer) - measures.volumeWithin(inner), size);
    inner = outer;
  }
  return elements;
}

/// Returns per node the number of elements in a quarter of each of its tetrahedra.
std::vector<double> elementsOfNodes(const BackgroundGrid& grid) {
  std::vector<double> elements(grid.nodes.size(), 0.0);
  for (const GridTetId tet : IdRange<GridTetId>(grid.tetrahedra.size())) {
    const auto [a, b, c, d] = cornersOf(grid, tet);
    const double volume = std::fabs(glm::dot(b - a, glm::cross(c - a, d - a))) / 6.0;
    for (const GridNodeId id : nodesOf(grid, tet)) {
      const BackgroundNode& node = nodeOf(grid, id);
      const double perElement = node.size * node.size * node.size * node.stretching;
      elements[id.index()] += kTetrahedraPerUnitVolume * 0.25 * volume / perElement;
    }
  }
  return elements;
}

}  // namespace

std::optional<Entity> mostDemandingSize(const BackgroundGrid& grid, const MeshOptions& options,
                                        double extent, double expected) {
  const double limit = options.size > 0.0 ? options.size : std::numeric_limits<double>::max();
  std::optional<Entity> found;
  double most = 0.0;
  double sum = 0.0;
  const auto consider = [&](EntityKind kind, std::size_t index, double elements) {
    sum += elements;
    if (!(elements > most)) return;
    most = elements;
    found = {kind, static_cast<std::uint32_t>(index)};
  };
  for (std::size_t i = 0; i < grid.sources.size(); ++i) {
    consider(EntityKind::kSource, i, elementsOf(grid.sources[i], extent, limit));
  }
  if (usesGrid(grid, options)) {
    const std::vector<double> elements = elementsOfNodes(grid);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      consider(EntityKind::kBackgroundNode, i, elements[i]);
    }
    return found;
  }
  // The other elements have the size of the options or of the surface's own edges.
  return expected - sum > most ? std::nullopt : found;
}

}  // namespace tetrafront
