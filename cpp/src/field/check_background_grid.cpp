#include "field/check_background_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/budget.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "field/grid_access.h"
#include "field/size_sources.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "tetrafront/options.h"

namespace tetrafront {
namespace {

/// Smallest volume of a tetrahedron / volume of the cube over its longest edge. The weights of a
/// flatter one would be rounding errors.
constexpr double kFlatVolume = 1e-12;

/// Tetrahedra per unit of budget: visiting one costs far less than a step of the front.
constexpr std::size_t kPerBudget = 8;

Entity entityOf(GridNodeId node) { return {EntityKind::kBackgroundNode, node.value}; }
Entity entityOf(GridTetId tet) { return {EntityKind::kBackgroundTetrahedron, tet.value}; }
Entity entityOf(SourceId source) { return {EntityKind::kSource, source.value}; }

template <class AnyId>
Diagnostic about(DiagnosticCode code, AnyId subject) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.entities = {entityOf(subject)};
  return diagnostic;
}

void checkNode(const BackgroundNode& node, GridNodeId id, double smallest,
               std::vector<Diagnostic>& found) {
  const auto report = [&](DiagnosticCode code, std::vector<double> values) {
    Diagnostic diagnostic = about(code, id);
    diagnostic.values = std::move(values);
    if (isFinite(node.position)) {
      diagnostic.hasPosition = true;
      diagnostic.position = node.position;
    }
    found.push_back(std::move(diagnostic));
  };
  if (!isFinite(node.position))
    report(DiagnosticCode::kNotFinite, {refusedCoordinate(node.position)});
  if (!(node.size > 0.0 && node.size >= smallest && node.size <= kLargestCoordinate))
    report(DiagnosticCode::kSizeOutOfRange, {node.size});
  if (!(node.stretching >= 1.0 && node.stretching <= kMaxStretching)) {
    report(DiagnosticCode::kStretchingOutOfRange, {node.stretching});
  } else if (node.stretching > 1.0 && (!isFinite(node.direction) || node.direction == Vec3(0.0))) {
    report(DiagnosticCode::kStretchingOutOfRange, {node.stretching});
  }
}

/// Reports sizes that are too small. checkSizeSources() reports those that are not positive.
void checkSourceSize(const SizeSource& source, SourceId id, double smallest,
                     std::vector<Diagnostic>& found) {
  if (!(source.size > 0.0 && source.size < smallest)) return;
  found.push_back(about(DiagnosticCode::kSizeOutOfRange, id));
  found.back().values = {source.size};
}

bool isDegenerate(const std::array<Vec3, 4>& p) {
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

void checkTetrahedron(const BackgroundGrid& grid, GridTetId tet, std::vector<Diagnostic>& found) {
  for (const GridNodeId node : nodesOf(grid, tet)) {
    if (node.index() >= grid.nodes.size()) {
      found.push_back(about(DiagnosticCode::kIndexOutOfRange, tet));
      found.back().values = {static_cast<double>(node.value)};
      return;
    }
    if (!isFinite(positionOf(grid, node))) return;  // reported with the node
  }
  const std::array<Vec3, 4> corners = cornersOf(grid, tet);
  if (!isDegenerate(corners)) return;
  found.push_back(about(DiagnosticCode::kDegenerateBackgroundTetrahedron, tet));
  found.back().hasPosition = true;
  found.back().position = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
}

}  // namespace

bool BackgroundGridCheck::advance(std::uint32_t budget) {
  if (stage_ == Stage::kDone) return true;
  if (stage_ == Stage::kSources) checkSources();
  const std::size_t last = next_ + std::min(scaledBudget(budget, kPerBudget), end_ - next_);
  for (; next_ < last; ++next_) workOn(next_);
  if (next_ == end_) endStage();
  return stage_ == Stage::kDone;
}

void BackgroundGridCheck::checkSources() {
  found_ = checkSizeSources(grid_->sources);
  if (part_ == GridPart::kSources) {
    stage_ = Stage::kDuplicates;
    return;
  }
  if (!grid_->nodes.empty() && !grid_->tetrahedra.empty()) return;
  found_.emplace_back();
  found_.back().code = DiagnosticCode::kEmptyBackgroundGrid;
  stage_ = Stage::kDuplicates;
}

void BackgroundGridCheck::workOn(std::size_t i) {
  switch (stage_) {
    case Stage::kExtent:
      return extend(grid_->nodes[i].position);
    case Stage::kNodes:
      return checkNode(grid_->nodes[i], GridNodeId(i), smallest_, found_);
    case Stage::kTetrahedra:
      checkTetrahedron(*grid_, GridTetId(i), found_);
      return entries_.count(listOf(sorted(nodesOf(*grid_, GridTetId(i)))[0]));
    case Stage::kInsert: {
      const GridTetId tet(i);
      const GridNodeQuad nodes = sorted(nodesOf(*grid_, tet));
      return entries_.add(listOf(nodes[0]), {nodes, tet});
    }
    case Stage::kDuplicates:
      return checkDuplicatesAt(GridNodeId(i));
    case Stage::kSources:
    case Stage::kDone:
      return;
  }
}

void BackgroundGridCheck::endStage() {
  next_ = 0;
  end_ = grid_->nodes.size();
  switch (stage_) {
    case Stage::kExtent:
      if (low_) smallest_ = Tolerance::ofBox(*low_, high_).rounding();
      break;
    case Stage::kNodes:
      for (const SourceId id : IdRange<SourceId>(grid_->sources.size())) {
        checkSourceSize(grid_->sources[id.index()], id, smallest_, found_);
      }
      entries_ = NodeLists<Entry, GridNodeId>(grid_->nodes.size() + 1);
      end_ = grid_->tetrahedra.size();
      break;
    case Stage::kTetrahedra:
      entries_.endCounting();
      end_ = grid_->tetrahedra.size();
      break;
    case Stage::kInsert:
      end_ = grid_->nodes.size() + 1;
      break;
    case Stage::kDuplicates:
      entries_ = {};
      break;
    case Stage::kSources:
    case Stage::kDone:
      break;
  }
  stage_ = static_cast<Stage>(static_cast<std::uint8_t>(stage_) + 1);
}

void BackgroundGridCheck::extend(const Vec3& position) {
  if (!isFinite(position)) return;
  high_ = low_ ? glm::max(high_, position) : position;
  low_ = low_ ? glm::min(*low_, position) : position;
}

/// Reports duplicate tetrahedra: those with the same four nodes.
void BackgroundGridCheck::checkDuplicatesAt(GridNodeId node) {
  const std::span<Entry> entries = entries_.at(node);
  sortFew(entries, [](const Entry& a, const Entry& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.tetrahedron < b.tetrahedron;
  });
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].nodes != entries[i - 1].nodes) continue;
    Diagnostic duplicate = about(DiagnosticCode::kDuplicateTriangle, entries[i].tetrahedron);
    duplicate.entities.push_back(entityOf(entries[i - 1].tetrahedron));
    found_.push_back(std::move(duplicate));
  }
}

std::vector<Diagnostic> checkBackgroundGrid(const BackgroundGrid& grid) {
  BackgroundGridCheck check(grid);
  while (!check.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return check.take();
}

}  // namespace tetrafront
