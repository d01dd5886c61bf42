#include "field/check_background_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "base/ids.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "field/grid_access.h"
#include "field/size_sources.h"
#include "field/size_tensor.h"
#include "geom/coordinates.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "tetrafront/options.h"
#include "topology/node_lists.h"

namespace tetrafront {
namespace {

/// Smallest volume of a tetrahedron / volume of the cube over its longest edge. The weights of a
/// flatter one would be rounding errors.
constexpr double kFlatVolume = 1e-12;

/// Nodes or tetrahedra per unit of budget: visiting one costs far less than a step of the front.
constexpr std::size_t kCheckedPerUnit = 8;

struct TetrahedronEntry {
  GridNodeQuad nodes;  ///< ascending
  GridTetId tetrahedron;
};

void checkNode(const BackgroundNode& node, GridNodeId id, double smallest,
               std::vector<Diagnostic>& found) {
  const auto report = [&](Diagnostic diagnostic) {
    found.push_back(std::move(diagnostic).about({entityOf(id)}));
    if (isFinite(node.position)) found.back() = std::move(found.back()).at(node.position);
  };
  if (!isFinite(node.position))
    report(diagnose<DiagnosticCode::kNotFinite>(refusedCoordinate(node.position)));
  if (!(node.size > 0.0 && node.size >= smallest && node.size <= kLargestCoordinate))
    report(diagnose<DiagnosticCode::kSizeOutOfRange>(node.size));
  const bool isInRange = node.stretching >= 1.0 && node.stretching <= kMaxStretching;
  const bool hasDirection = isFinite(node.direction) && node.direction != Vec3(0.0);
  if (!isInRange || (node.stretching > 1.0 && !hasDirection))
    report(diagnose<DiagnosticCode::kStretchingOutOfRange>(node.stretching));
}

/// Reports an invalid second stretching, and directions that are not orthogonal.
void checkSecond(const BackgroundNode& node, const SecondStretching& second, GridNodeId id,
                 std::vector<Diagnostic>& found) {
  const bool isInRange = second.stretching >= 1.0 && second.stretching <= kMaxStretching;
  const bool isStretched = second.stretching > 1.0;
  const bool hasDirection = isFinite(second.direction) && second.direction != Vec3(0.0);
  const bool areBoth = isStretched && hasDirection && node.stretching > 1.0 &&
                       isFinite(node.direction) && node.direction != Vec3(0.0);
  const double cosine =
      areBoth ? std::fabs(cosineBetween(scaledToOne(node.direction), scaledToOne(second.direction)))
              : 0.0;
  if (isInRange && (!isStretched || hasDirection) && cosine <= kMaxDirectionCosine) return;
  found.push_back(diagnose<DiagnosticCode::kSecondStretchingOutOfRange>(second.stretching, cosine)
                      .about({entityOf(id)}));
  if (isFinite(node.position)) found.back() = std::move(found.back()).at(node.position);
}

/// Reports sizes that are too small. checkSizeSources() reports those that are not positive.
void checkSourceSize(const SizeSource& source, SourceId id, double smallest,
                     std::vector<Diagnostic>& found) {
  if (!(source.size > 0.0 && source.size < smallest)) return;
  found.push_back(diagnose<DiagnosticCode::kSizeOutOfRange>(source.size).about({entityOf(id)}));
}

bool isDegenerate(const std::array<Vec3, 4>& p) {
  if (orient3d(p[0], p[1], p[2], p[3]) == 0) return true;
  double longest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      longest = std::max(longest, glm::dot(p[j] - p[i], p[j] - p[i]));
    }
  }
  const double sixVolumes = sixVolumesBelow(p[0], p[3], p[1], p[2]);
  return std::fabs(sixVolumes) < kFlatVolume * longest * std::sqrt(longest);
}

void checkTetrahedron(const BackgroundGrid& grid, GridTetId tet, std::vector<Diagnostic>& found) {
  for (const GridNodeId node : nodesOf(grid, tet)) {
    if (node.index() >= grid.nodes.size()) {
      found.push_back(
          diagnose<DiagnosticCode::kIndexOutOfRange>(node.value).about({entityOf(tet)}));
      return;
    }
    if (!isFinite(positionOf(grid, node))) return;  // reported with the node
  }
  const std::array<Vec3, 4> corners = cornersOf(grid, tet);
  if (!isDegenerate(corners)) return;
  found.push_back(diagnose<DiagnosticCode::kDegenerateBackgroundTetrahedron>()
                      .about({entityOf(tet)})
                      .at(0.25 * (corners[0] + corners[1] + corners[2] + corners[3])));
}

/// Reports the tetrahedra of a list that have the same four nodes as another.
void reportDuplicates(std::span<TetrahedronEntry> entries, std::vector<Diagnostic>& found) {
  sortFew(entries, [](const TetrahedronEntry& a, const TetrahedronEntry& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.tetrahedron < b.tetrahedron;
  });
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].nodes != entries[i - 1].nodes) continue;
    found.push_back(diagnose<DiagnosticCode::kDuplicateTriangle>().about(
        {entityOf(entries[i].tetrahedron), entityOf(entries[i - 1].tetrahedron)}));
  }
}

/// Box of the valid positions.
struct GridExtent {
  std::optional<Vec3> low;
  Vec3 high{0.0};

  void include(const Vec3& position) {
    if (!isFinite(position)) return;
    high = low ? glm::max(high, position) : position;
    low = low ? glm::min(*low, position) : position;
  }
  [[nodiscard]] double smallestSize() const {
    return low ? Tolerance::ofBox(*low, high).rounding() : 0.0;
  }
};

}  // namespace

Task<std::vector<Diagnostic>> checkBackgroundGrid(Work& work, const BackgroundGrid& grid,
                                                  GridPart part) {
  std::vector<Diagnostic> found = checkSizeSources(grid.sources);
  if (part == GridPart::kSources) co_return found;
  if (grid.nodes.empty() || grid.tetrahedra.empty()) {
    found.push_back(diagnose<DiagnosticCode::kEmptyBackgroundGrid>());
    co_return found;
  }
  const std::size_t nodes = grid.nodes.size();
  const std::size_t tetrahedra = grid.tetrahedra.size();
  const bool hasSecond = !grid.secondStretchings.empty();
  GridExtent extent;
  work.beginPart(0.05);
  co_await work.forEachId<GridNodeId>(
      nodes, [&](GridNodeId node) { extent.include(positionOf(grid, node)); }, kCheckedPerUnit);
  const double smallest = extent.smallestSize();
  work.beginPart(0.15);
  co_await work.forEachId<GridNodeId>(
      nodes,
      [&](GridNodeId node) {
        checkNode(nodeOf(grid, node), node, smallest, found);
        if (hasSecond) checkSecond(nodeOf(grid, node), secondOf(grid, node), node, found);
      },
      kCheckedPerUnit);
  for (const SourceId id : IdRange<SourceId>(grid.sources.size())) {
    checkSourceSize(grid.sources[id.index()], id, smallest, found);
  }

  // Tetrahedra by their lowest nodes. The last list holds those of invalid nodes.
  NodeLists<TetrahedronEntry, GridNodeId> entries(nodes + 1);
  const auto listOf = [nodes](const GridNodeQuad& ascending) {
    return std::min(ascending[0], GridNodeId(nodes));
  };
  work.beginPart(0.5);
  co_await work.forEachId<GridTetId>(
      tetrahedra,
      [&](GridTetId tet) {
        checkTetrahedron(grid, tet, found);
        entries.count(listOf(sorted(nodesOf(grid, tet))));
      },
      kCheckedPerUnit);
  entries.endCounting();
  work.beginPart(0.8);
  co_await work.forEachId<GridTetId>(
      tetrahedra,
      [&](GridTetId tet) {
        const GridNodeQuad ascending = sorted(nodesOf(grid, tet));
        entries.add(listOf(ascending), {ascending, tet});
      },
      kCheckedPerUnit);
  work.beginPart(1.0);
  co_await work.forEachId<GridNodeId>(
      nodes + 1, [&](GridNodeId list) { reportDuplicates(entries.at(list), found); },
      kCheckedPerUnit);
  co_return found;
}

std::vector<Diagnostic> checkBackgroundGrid(const BackgroundGrid& grid) {
  Job job([&](Work& work) { return checkBackgroundGrid(work, grid); });
  return job.finish();
}

}  // namespace tetrafront
