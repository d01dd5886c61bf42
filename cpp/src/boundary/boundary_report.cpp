#include "boundary/boundary_report.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

Entity entityOf(NodeId node) { return {EntityKind::kSurfaceNode, node.value}; }
Entity entityOf(TriangleId triangle) { return {EntityKind::kTriangle, triangle.value}; }
Entity entityOf(LineId line) { return {EntityKind::kLine, line.value}; }

}  // namespace

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

void BoundaryReport::add(DiagnosticCode code, std::vector<Entity> entities, const Vec3& position,
                         std::vector<double> values, std::span<const TriangleId> triangles) {
  ++errors_;
  Total& total = totalOf(code);
  ++total.reported;
  if (isDrawn()) {
    std::vector<std::uint64_t> key;
    for (const Entity& entity : entities) {
      key.push_back(static_cast<std::uint64_t>(entity.kind) << 32U | entity.index);
    }
    const auto [known, isNew] = known_.try_emplace({code, std::move(key)}, entries_.size());
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
  Entry entry;
  entry.diagnostic.code = code;
  entry.diagnostic.entities = std::move(entities);
  entry.diagnostic.values = std::move(values);
  entry.count = 1;
  addTriangles(entry, triangles);
  if (std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)) {
    entry.diagnostic.hasPosition = true;
    entry.diagnostic.position = origin_ + position;
  }
  entries_.push_back(std::move(entry));
}

void BoundaryReport::addNode(DiagnosticCode code, NodeId node, std::vector<double> values) {
  add(code, {entityOf(node)}, pointOf(mesh_, node), std::move(values));
}

void BoundaryReport::addNodePair(DiagnosticCode code, NodeId a, NodeId b) {
  add(code, {entityOf(a), entityOf(b)}, pointOf(mesh_, a), {});
}

void BoundaryReport::addTriangle(DiagnosticCode code, TriangleId triangle,
                                 std::vector<double> values) {
  const bool isInRange = std::ranges::all_of(
      nodesOf(mesh_, triangle), [this](NodeId node) { return node.index() < countNodes(mesh_); });
  const Vec3 position = isInRange ? centroidOf(cornersOf(mesh_, triangle)) : Vec3(std::nan(""));
  if (isDrawn()) {
    add(code, {patchOf(triangle)}, position, std::move(values), std::array{triangle});
  } else {
    add(code, {entityOf(triangle)}, position, std::move(values));
  }
}

void BoundaryReport::addTrianglePair(DiagnosticCode code, TriangleId a, TriangleId b,
                                     const Vec3& position) {
  if (!isDrawn()) {
    add(code, {entityOf(a), entityOf(b)}, position, {});
    return;
  }
  std::vector<Entity> entities{patchOf(a), patchOf(b)};
  if (entities[1].index < entities[0].index) std::swap(entities[0], entities[1]);
  if (entities[1].index == entities[0].index) entities.pop_back();
  add(code, std::move(entities), position, {}, std::array{a, b});
}

void BoundaryReport::addEdge(DiagnosticCode code, NodeId from, NodeId to,
                             std::span<const TriangleId> triangles) {
  const Vec3 middle = 0.5 * (pointOf(mesh_, from) + pointOf(mesh_, to));
  std::vector<Entity> entities;
  if (!isDrawn()) {
    for (const TriangleId triangle : triangles) entities.push_back(entityOf(triangle));
    add(code, std::move(entities), middle, {});
    return;
  }
  if (const std::optional<LineId> line = lineOf(from, to)) entities.push_back(entityOf(*line));
  std::vector<std::uint32_t> patches;
  for (const TriangleId triangle : triangles) patches.push_back(patchOf(triangle).index);
  sortUnique(patches);
  for (const std::uint32_t patch : patches) entities.push_back({EntityKind::kPatch, patch});
  add(code, std::move(entities), middle, {}, triangles);
}

void BoundaryReport::addInformation(DiagnosticCode code, std::vector<Entity> entities,
                                    const Vec3& position, std::vector<double> values) {
  Entry entry;
  entry.diagnostic = {code, Severity::kInformation, std::move(entities),
                      true, origin_ + position,     std::move(values)};
  entry.hasTotal = false;
  Total& total = totalOf(code);
  ++total.reported;
  // A given surface may have a million inverted shells.
  if (total.kept == maxDiagnostics_) return;
  ++total.kept;
  entries_.push_back(std::move(entry));
}

void BoundaryReport::addNesting(TriangleId triangle, std::uint32_t regions,
                                std::uint32_t cavities) {
  addInformation(DiagnosticCode::kNestedRegions,
                 {isDrawn() ? patchOf(triangle) : entityOf(triangle)},
                 centroidOf(cornersOf(mesh_, triangle)),
                 {static_cast<double>(regions), static_cast<double>(cavities)});
}

void BoundaryReport::addContact(TriangleId triangle, const Vec3& position, std::size_t edges,
                                std::size_t nodes) {
  addInformation(DiagnosticCode::kSurfaceContact,
                 {isDrawn() ? patchOf(triangle) : entityOf(triangle)}, position,
                 {static_cast<double>(edges), static_cast<double>(nodes)});
}

void BoundaryReport::addEmpty() {
  ++errors_;
  Entry entry;
  entry.diagnostic.code = DiagnosticCode::kEmptyModel;
  entry.hasTotal = false;
  entries_.push_back(std::move(entry));
}

void BoundaryReport::addIncomplete(EntityKind kind, std::size_t index) {
  add(DiagnosticCode::kIndexOutOfRange, {{kind, static_cast<std::uint32_t>(index)}},
      Vec3(std::nan("")), {static_cast<double>(index)});
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
