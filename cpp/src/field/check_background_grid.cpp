#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "field/grid_locator.h"
#include "base/sort.h"
#include "field/size_sources.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "tetrafront/options.h"

namespace tetrafront {
namespace {

/// A tetrahedron with less than this share of the volume of the cube over its longest edge is
/// flat: its weights would be rounding errors.
constexpr double kFlatVolume = 1e-12;

/// Sizes below this share of the grid's extent are a slip: places that near each other could not be
/// told from rounding, and no line would hold the sides.
constexpr double kSmallestSize = 1e-12;

Diagnostic about(DiagnosticCode code, EntityKind kind, std::uint32_t index) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.entities = {{kind, index}};
  return diagnostic;
}

/// The smallest size that the grid may ask for.
double smallestSize(const BackgroundGrid& grid) {
  std::optional<Vec3> low;
  Vec3 high(0.0);
  for (const BackgroundNode& node : grid.nodes) {
    if (!isFinite(node.position)) continue;
    high = low ? glm::max(high, node.position) : node.position;
    low = low ? glm::min(*low, node.position) : node.position;
  }
  return low ? kSmallestSize * glm::length(high - *low) : 0.0;
}

void checkNode(const BackgroundNode& node, std::uint32_t index, double smallest,
               std::vector<Diagnostic>& found) {
  const auto report = [&](DiagnosticCode code, std::vector<double> values) {
    Diagnostic diagnostic = about(code, EntityKind::kBackgroundNode, index);
    diagnostic.values = std::move(values);
    if (isFinite(node.position)) {
      diagnostic.hasPlace = true;
      diagnostic.place = node.position;
    }
    found.push_back(std::move(diagnostic));
  };
  if (!isFinite(node.position))
    report(DiagnosticCode::kNotFinite, {refusedCoordinate(node.position)});
  if (!(node.size > 0.0 && node.size >= smallest && node.size <= kLargestCoordinate))
    report(DiagnosticCode::kBadSize, {node.size});
  if (!(node.stretching >= 1.0 && node.stretching <= kMostStretching)) {
    report(DiagnosticCode::kBadStretching, {node.stretching});
  } else if (node.stretching > 1.0 && (!isFinite(node.direction) || node.direction == Vec3(0.0))) {
    report(DiagnosticCode::kBadStretching, {node.stretching});
  }
}

/// Those that are not above 0 are reported by checkSizeSources().
void checkSourceSize(const SizeSource& source, std::uint32_t index, double smallest,
                     std::vector<Diagnostic>& found) {
  if (!(source.size > 0.0 && source.size < smallest)) return;
  found.push_back(about(DiagnosticCode::kBadSize, EntityKind::kSource, index));
  found.back().values = {source.size};
}

bool isFlat(const std::array<Vec3, 4>& p) {
  if (orient3d(p[0], p[1], p[2], p[3]) == 0) return true;
  double longest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      longest = std::max(longest, glm::dot(p[j] - p[i], p[j] - p[i]));
    }
  }
  const double sixVolumes = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
  return std::fabs(sixVolumes) < kFlatVolume * longest * std::sqrt(longest);
}

void checkTetrahedron(const BackgroundGrid& grid, std::uint32_t t, std::vector<Diagnostic>& found) {
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint32_t node = grid.tetrahedra[t][i];
    if (node >= grid.nodes.size()) {
      found.push_back(
          about(DiagnosticCode::kIndexOutOfRange, EntityKind::kBackgroundTetrahedron, t));
      found.back().values = {static_cast<double>(node)};
      return;
    }
    corners[i] = grid.nodes[node].position;
    if (!isFinite(corners[i])) return;  // reported with the node
  }
  if (!isFlat(corners)) return;
  found.push_back(
      about(DiagnosticCode::kFlatBackgroundTetrahedron, EntityKind::kBackgroundTetrahedron, t));
  found.back().hasPlace = true;
  found.back().place = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
}

/// Tetrahedra with the same four nodes overlap.
void checkRepeated(const BackgroundGrid& grid, std::vector<Diagnostic>& found) {
  struct Entry {
    std::array<std::uint32_t, 4> nodes;
    std::uint32_t tetrahedron;
  };
  std::vector<Entry> entries;
  entries.reserve(grid.tetrahedra.size());
  for (std::uint32_t t = 0; t < grid.tetrahedra.size(); ++t) {
    entries.push_back({sorted(grid.tetrahedra[t]), t});
  }
  stableSort(entries, [](const Entry& a, const Entry& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.tetrahedron < b.tetrahedron;
  });
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].nodes != entries[i - 1].nodes) continue;
    Diagnostic repeated = about(DiagnosticCode::kDuplicateTriangle,
                                EntityKind::kBackgroundTetrahedron, entries[i].tetrahedron);
    repeated.entities.push_back({EntityKind::kBackgroundTetrahedron, entries[i - 1].tetrahedron});
    found.push_back(std::move(repeated));
  }
}

}  // namespace

std::vector<Diagnostic> checkBackgroundGrid(const BackgroundGrid& grid) {
  std::vector<Diagnostic> found = checkSizeSources(grid.sources);
  if (grid.nodes.empty() || grid.tetrahedra.empty()) {
    found.emplace_back();
    found.back().code = DiagnosticCode::kEmptyBackgroundGrid;
    return found;
  }
  const double smallest = smallestSize(grid);
  for (std::uint32_t i = 0; i < grid.nodes.size(); ++i) {
    checkNode(grid.nodes[i], i, smallest, found);
  }
  for (std::uint32_t i = 0; i < grid.sources.size(); ++i) {
    checkSourceSize(grid.sources[i], i, smallest, found);
  }
  for (std::uint32_t t = 0; t < grid.tetrahedra.size(); ++t) checkTetrahedron(grid, t, found);
  checkRepeated(grid, found);
  return found;
}

}  // namespace tetrafront
