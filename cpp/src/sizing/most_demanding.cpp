#include "sizing/most_demanding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
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

/// Returns the box around the points that the source uses.
Bounds boundsOf(const SizeSource& source) {
  const auto& [a, b, c] = source.points;
  switch (source.type) {
    case SourceType::kPoint:
      return {a, a};
    case SourceType::kSegment:
      return {glm::min(a, b), glm::max(a, b)};
    case SourceType::kTriangle:
      return {glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)};
  }
  return {a, a};
}

/// Returns the volume common to two boxes.
double commonVolume(const Bounds& a, const Bounds& b) {
  const Vec3 edges = glm::max(glm::min(a.high, b.high) - glm::max(a.low, b.low), Vec3(0.0));
  return edges.x * edges.y * edges.z;
}

/// Returns the box, widened if it is thinner than one element: a flat surface has elements as well.
Bounds atLeastAsThickAs(double size, const Bounds& bounds) {
  const Vec3 missing = glm::max(Vec3(size) - (bounds.high - bounds.low), Vec3(0.0));
  return {bounds.low - 0.5 * missing, bounds.high + 0.5 * missing};
}

/// The surroundings of a source in the model's box.
class Surroundings {
 public:
  Surroundings(const SizeSource& source, const Bounds& model)
      : measures_(measuresOf(source)),
        source_(boundsOf(source)),
        model_(atLeastAsThickAs(source.size, model)) {}

  /// Returns an upper estimate of the volume in the box up to a distance from the source.
  [[nodiscard]] double volumeWithin(double distance) const {
    const Bounds near{source_.low - Vec3(distance), source_.high + Vec3(distance)};
    return std::min(measures_.volumeWithin(distance), commonVolume(near, model_));
  }

  /// Returns a distance from the source within which the whole box lies.
  [[nodiscard]] double reach() const {
    return glm::length(glm::max(source_.high, model_.high) - glm::min(source_.low, model_.low));
  }

 private:
  Measures measures_;
  Bounds source_;
  Bounds model_;
};

/// Returns the number of elements that a source requires in the model's box, where its size is below `limit`.
double elementsOf(const SizeSource& source, const Bounds& model, double limit) {
  if (!(source.size < limit)) return 0.0;
  const Surroundings surroundings(source, model);
  const auto elementsIn = [](double volume, double size) {
    return kTetrahedraPerUnitVolume * volume / (size * size * size);
  };
  const double reach = surroundings.reach();
  double inner = source.growth > 0.0 ? std::min(source.distance, reach) : reach;
  double within = surroundings.volumeWithin(inner);
  double elements = elementsIn(within, source.size);
  for (double size = source.size; inner < reach && size < limit; size *= kSizeRatioOfShell) {
    inner = std::min(reach, inner + (kSizeRatioOfShell - 1.0) * size / source.growth);
    const double before = std::exchange(within, surroundings.volumeWithin(inner));
    elements += elementsIn(within - before, size);
  }
  return elements;
}

/// Returns the number of elements that each node requires in the model's box: in a quarter of each of its tetrahedra.
std::vector<double> elementsOfNodes(const BackgroundGrid& grid, const Bounds& model) {
  std::vector<double> elements(grid.nodes.size(), 0.0);
  for (const GridTetId tet : IdRange<GridTetId>(grid.tetrahedra.size())) {
    const auto [a, b, c, d] = cornersOf(grid, tet);
    const Bounds box{glm::min(glm::min(a, b), glm::min(c, d)),
                     glm::max(glm::max(a, b), glm::max(c, d))};
    const double whole = std::fabs(glm::dot(b - a, glm::cross(c - a, d - a))) / 6.0;
    for (const GridNodeId id : nodesOf(grid, tet)) {
      const BackgroundNode& node = nodeOf(grid, id);
      const double volume = std::min(whole, commonVolume(box, atLeastAsThickAs(node.size, model)));
      const double perElement =
          node.size * node.size * node.size * node.stretching * secondOf(grid, id).stretching;
      elements[id.index()] += kTetrahedraPerUnitVolume * 0.25 * volume / perElement;
    }
  }
  return elements;
}

/// Returns what nameMostDemanding() adds. `expected`: number of elements in all.
std::optional<Entity> mostDemandingSize(const BackgroundGrid& grid, const MeshOptions& options,
                                        const Bounds& bounds, double expected) {
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
    consider(EntityKind::kSource, i, elementsOf(grid.sources[i], bounds, limit));
  }
  if (usesGrid(grid, options)) {
    const std::vector<double> elements = elementsOfNodes(grid, bounds);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      consider(EntityKind::kBackgroundNode, i, elements[i]);
    }
    return found;
  }
  // The other elements have the size of the options or of the surface's own edges.
  return expected - sum > most ? std::nullopt : found;
}

}  // namespace

void nameMostDemanding(Diagnostic& tooMany, const BackgroundGrid& grid, const MeshOptions& options,
                       const Bounds& bounds) {
  const std::optional<Entity> entity =
      mostDemandingSize(grid, options, bounds, tooMany.values.front());
  if (entity) tooMany.entities.push_back(*entity);
}

}  // namespace tetrafront
