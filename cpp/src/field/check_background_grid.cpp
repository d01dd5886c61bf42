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

Diagnostic about(DiagnosticCode code, EntityKind kind, std::uint32_t index) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.entities = {{kind, index}};
  return diagnostic;
}

void checkNode(const BackgroundNode& node, std::uint32_t index, double smallest,
               std::vector<Diagnostic>& found) {
  const auto report = [&](DiagnosticCode code, std::vector<double> values) {
    Diagnostic diagnostic = about(code, EntityKind::kBackgroundNode, index);
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
void checkSourceSize(const SizeSource& source, std::uint32_t index, double smallest,
                     std::vector<Diagnostic>& found) {
  if (!(source.size > 0.0 && source.size < smallest)) return;
  found.push_back(about(DiagnosticCode::kSizeOutOfRange, EntityKind::kSource, index));
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
  found.push_back(about(DiagnosticCode::kDegenerateBackgroundTetrahedron,
                        EntityKind::kBackgroundTetrahedron, t));
  found.back().hasPosition = true;
  found.back().position = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
}

}  // namespace

bool BackgroundGridCheck::advance(std::uint32_t budget) {
  if (stage_ == Stage::kDone) return true;
  if (stage_ == Stage::kSources) checkSources();
  const std::size_t last = next_ + std::min(scaledBudget(budget, kPerBudget), end_ - next_);
  for (; next_ < last; ++next_) workOn(static_cast<std::uint32_t>(next_));
  if (next_ == end_) endStage();
  return stage_ == Stage::kDone;
}

void BackgroundGridCheck::checkSources() {
  found_ = checkSizeSources(grid_->sources);
  if (part_ == GridPart::kSources) {
    stage_ = Stage::kRepeated;
    return;
  }
  if (!grid_->nodes.empty() && !grid_->tetrahedra.empty()) return;
  found_.emplace_back();
  found_.back().code = DiagnosticCode::kEmptyBackgroundGrid;
  stage_ = Stage::kRepeated;
}

void BackgroundGridCheck::workOn(std::uint32_t i) {
  switch (stage_) {
    case Stage::kExtent:
      return extend(grid_->nodes[i].position);
    case Stage::kNodes:
      return checkNode(grid_->nodes[i], i, smallest_, found_);
    case Stage::kTetrahedra:
      checkTetrahedron(*grid_, i, found_);
      return entries_.count(listOf(sorted(grid_->tetrahedra[i])[0]));
    case Stage::kPlace: {
      const std::array nodes = sorted(grid_->tetrahedra[i]);
      return entries_.add(listOf(nodes[0]), {nodes, i});
    }
    case Stage::kRepeated:
      return checkRepeatedAt(i);
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
      if (low_) smallest_ = Tolerance(glm::length(high_ - *low_)).rounding();
      break;
    case Stage::kNodes:
      for (std::uint32_t i = 0; i < grid_->sources.size(); ++i) {
        checkSourceSize(grid_->sources[i], i, smallest_, found_);
      }
      entries_ = NodeLists<Entry>(grid_->nodes.size() + 1);
      end_ = grid_->tetrahedra.size();
      break;
    case Stage::kTetrahedra:
      entries_.endCounting();
      end_ = grid_->tetrahedra.size();
      break;
    case Stage::kPlace:
      end_ = grid_->nodes.size() + 1;
      break;
    case Stage::kRepeated:
      entries_ = {};
      break;
    case Stage::kSources:
    case Stage::kDone:
      break;
  }
  stage_ = static_cast<Stage>(static_cast<std::uint8_t>(stage_) + 1);
}

void BackgroundGridCheck::extend(const Vec3& place) {
  if (!isFinite(place)) return;
  high_ = low_ ? glm::max(high_, place) : place;
  low_ = low_ ? glm::min(*low_, place) : place;
}

/// Reports duplicate tetrahedra: those with the same four nodes.
void BackgroundGridCheck::checkRepeatedAt(std::uint32_t node) {
  const std::span<Entry> entries = entries_.at(node);
  sortFew(entries, [](const Entry& a, const Entry& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.tetrahedron < b.tetrahedron;
  });
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].nodes != entries[i - 1].nodes) continue;
    Diagnostic repeated = about(DiagnosticCode::kDuplicateTriangle,
                                EntityKind::kBackgroundTetrahedron, entries[i].tetrahedron);
    repeated.entities.push_back({EntityKind::kBackgroundTetrahedron, entries[i - 1].tetrahedron});
    found_.push_back(std::move(repeated));
  }
}

std::vector<Diagnostic> checkBackgroundGrid(const BackgroundGrid& grid) {
  BackgroundGridCheck check(grid);
  while (!check.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return check.take();
}

}  // namespace tetrafront
