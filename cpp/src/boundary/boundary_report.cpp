#include "boundary/boundary_report.h"

#include <algorithm>
#include <cmath>

#include "base/diagnostics.h"
#include "base/sort.h"
#include "topology/surface_access.h"

namespace tetrafront {

Entity BoundaryReport::patchOf(TriangleId triangle) const {
  return {EntityKind::kPatch, mesh_.trianglePatch[triangle.index()]};
}

std::optional<LineId> BoundaryReport::lineOf(NodeId a, NodeId b) {
  if (sides_.empty()) {
    for (std::size_t s = 0; s < mesh_.sideLine.size(); ++s) {
      const auto [low, high] = std::minmax(mesh_.sides[2 * s], mesh_.sides[2 * s + 1]);
      sides_.push_back({NodeId(low), NodeId(high), LineId(mesh_.sideLine[s])});
    }
    stableSort(sides_);
  }
  const auto [low, high] = std::minmax(a, b);
  const auto found = std::ranges::lower_bound(sides_, Side{low, high, LineId(0U)});
  if (found == sides_.end() || found->low != low || found->high != high) return std::nullopt;
  return found->line;
}

void BoundaryReport::addTriangles(Entry& entry, std::span<const TriangleId> triangles) {
  for (const TriangleId triangle : triangles) {
    std::vector<TriangleId>& known = entry.triangles;
    if (known.size() == kMaxTriangles) return;
    if (std::ranges::find(known, triangle) == known.end()) known.push_back(triangle);
  }
}

void BoundaryReport::add(Diagnostic found, const Vec3& position,
                         std::span<const TriangleId> triangles) {
  ++errors_;
  Total& total = totalOf(found.code);
  ++total.reported;
  if (isDrawn()) {
    std::vector<std::uint64_t> key;
    for (const Entity& entity : found.entities) {
      key.push_back(static_cast<std::uint64_t>(entity.kind) << 32U | entity.index);
    }
    const auto [known, isNew] = known_.try_emplace({found.code, std::move(key)}, entries_.size());
    if (!isNew) {
      if (known->second == kNotKept) return;
      ++entries_[known->second].count;
      addTriangles(entries_[known->second], triangles);
      return;
    }
    if (total.kept == maxDiagnostics_) known->second = kNotKept;
  }
  if (total.kept == maxDiagnostics_) return;
  ++total.kept;
  if (std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)) {
    found = std::move(found).at(origin_ + position);
  }
  entries_.push_back({.diagnostic = std::move(found), .count = 1});
  addTriangles(entries_.back(), triangles);
}

void BoundaryReport::addNode(Diagnostic found, NodeId node) {
  add(std::move(found).about({entityOf(node)}), pointOf(mesh_, node));
}

void BoundaryReport::addNodePair(Diagnostic found, NodeId a, NodeId b) {
  add(std::move(found).about({entityOf(a), entityOf(b)}), pointOf(mesh_, a));
}

void BoundaryReport::addTriangle(Diagnostic found, TriangleId triangle) {
  const bool isInRange = std::ranges::all_of(
      nodesOf(mesh_, triangle), [this](NodeId node) { return node.index() < countNodes(mesh_); });
  const Vec3 position = isInRange ? centroidOf(cornersOf(mesh_, triangle)) : Vec3(std::nan(""));
  if (isDrawn()) {
    add(std::move(found).about({patchOf(triangle)}), position, std::array{triangle});
  } else {
    add(std::move(found).about({entityOf(triangle)}), position);
  }
}

void BoundaryReport::addTrianglePair(Diagnostic found, TriangleId a, TriangleId b,
                                     const Vec3& position) {
  if (!isDrawn()) {
    add(std::move(found).about({entityOf(a), entityOf(b)}), position);
    return;
  }
  std::vector<Entity> entities{patchOf(a), patchOf(b)};
  if (entities[1].index < entities[0].index) std::swap(entities[0], entities[1]);
  if (entities[1].index == entities[0].index) entities.pop_back();
  add(std::move(found).about(std::move(entities)), position, std::array{a, b});
}

void BoundaryReport::addEdge(Diagnostic found, NodeId from, NodeId to,
                             std::span<const TriangleId> triangles) {
  const Vec3 middle = 0.5 * (pointOf(mesh_, from) + pointOf(mesh_, to));
  std::vector<Entity> entities;
  if (!isDrawn()) {
    for (const TriangleId triangle : triangles) entities.push_back(entityOf(triangle));
    add(std::move(found).about(std::move(entities)), middle);
    return;
  }
  if (const std::optional<LineId> line = lineOf(from, to)) entities.push_back(entityOf(*line));
  std::vector<std::uint32_t> patches;
  for (const TriangleId triangle : triangles) patches.push_back(patchOf(triangle).index);
  sortUnique(patches);
  for (const std::uint32_t patch : patches) entities.push_back({EntityKind::kPatch, patch});
  add(std::move(found).about(std::move(entities)), middle, triangles);
}

void BoundaryReport::addInformation(Diagnostic found) {
  Total& total = totalOf(found.code);
  ++total.reported;
  // A given surface may have a million inverted shells.
  if (total.kept == maxDiagnostics_) return;
  ++total.kept;
  found.position += origin_;
  entries_.push_back(
      {.diagnostic = std::move(found).withSeverity(Severity::kInformation), .hasTotal = false});
}

void BoundaryReport::addNesting(TriangleId triangle, std::uint32_t regions,
                                std::uint32_t cavities) {
  addInformation(diagnose<DiagnosticCode::kNestedRegions>(regions, cavities)
                     .about({isDrawn() ? patchOf(triangle) : entityOf(triangle)})
                     .at(centroidOf(cornersOf(mesh_, triangle))));
}

void BoundaryReport::addContact(TriangleId triangle, const Vec3& position, std::size_t edges,
                                std::size_t nodes) {
  addInformation(diagnose<DiagnosticCode::kSurfaceContact>(edges, nodes)
                     .about({isDrawn() ? patchOf(triangle) : entityOf(triangle)})
                     .at(position));
}

void BoundaryReport::addEmpty() {
  ++errors_;
  entries_.push_back({.diagnostic = diagnose<DiagnosticCode::kEmptyModel>(), .hasTotal = false});
}

void BoundaryReport::addIncomplete(EntityKind kind, std::size_t index) {
  add(diagnoseCounted<DiagnosticCode::kIndexOutOfRange>(index).about(
          {{kind, static_cast<std::uint32_t>(index)}}),
      Vec3(std::nan("")));
}

std::vector<Diagnostic> BoundaryReport::take() {
  std::vector<Diagnostic> diagnostics;
  for (Entry& entry : entries_) {
    Diagnostic& diagnostic = entry.diagnostic;
    if (entry.hasTotal) {
      const Total& total = totalOf(diagnostic.code);
      const std::uint64_t count = isDrawn() ? entry.count : total.reported;
      diagnostic.values.push_back(static_cast<double>(count));
      if (total.isLowerBound) diagnostic.values.push_back(1.0);
    }
    for (const TriangleId triangle : entry.triangles) {
      diagnostic.entities.push_back(entityOf(triangle));
    }
    diagnostics.push_back(std::move(diagnostic));
  }
  entries_.clear();
  return diagnostics;
}

}  // namespace tetrafront
