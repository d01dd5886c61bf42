#include "boundary/boundary_report.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "boundary/surface_access.h"

namespace tetrafront {

Vec3 BoundaryReport::centroidOf(std::uint32_t triangle) const {
  const std::array<Vec3, 3> p = cornersOf(mesh_, triangle);
  return (p[0] + p[1] + p[2]) / 3.0;
}

Entity BoundaryReport::patchOf(std::uint32_t triangle) const {
  return {EntityKind::kPatch, mesh_.trianglePatch[triangle]};
}

bool BoundaryReport::lineOf(std::uint32_t a, std::uint32_t b, std::uint32_t& line) {
  if (sides_.empty()) {
    for (std::size_t s = 0; s < mesh_.sideLine.size(); ++s) {
      const auto [low, high] = std::minmax(mesh_.sides[2 * s], mesh_.sides[2 * s + 1]);
      sides_.push_back({low, high, mesh_.sideLine[s]});
    }
    stableSort(sides_);
  }
  const std::array<std::uint32_t, 3> key{std::min(a, b), std::max(a, b), 0};
  const auto at = std::lower_bound(sides_.begin(), sides_.end(), key);
  if (at == sides_.end() || (*at)[0] != key[0] || (*at)[1] != key[1]) return false;
  line = (*at)[2];
  return true;
}

void BoundaryReport::addTriangles(Entry& entry, std::span<const std::uint32_t> triangles) {
  for (const std::uint32_t triangle : triangles) {
    std::vector<std::uint32_t>& known = entry.triangles;
    if (known.size() == kMaxTriangles) return;
    if (std::find(known.begin(), known.end(), triangle) == known.end()) known.push_back(triangle);
  }
}

void BoundaryReport::add(DiagnosticCode code, std::vector<Entity> entities, const Vec3& place,
                         std::vector<double> values, std::span<const std::uint32_t> triangles) {
  ++errors_;
  Kind& kind = kindOf(code);
  ++kind.total;
  if (isDrawn()) {
    std::vector<std::uint64_t> key;
    for (const Entity& entity : entities) {
      key.push_back(static_cast<std::uint64_t>(entity.kind) << 32U | entity.index);
    }
    const auto [at, isNew] = known_.try_emplace({code, std::move(key)}, entries_.size());
    if (!isNew) {
      if (at->second == kNotKept) return;
      ++entries_[at->second].count;
      addTriangles(entries_[at->second], triangles);
      return;
    }
    if (kind.kept == maxDiagnostics_) at->second = kNotKept;
  }
  if (kind.kept == maxDiagnostics_) return;
  ++kind.kept;
  Entry entry;
  entry.diagnostic.code = code;
  entry.diagnostic.entities = std::move(entities);
  entry.diagnostic.values = std::move(values);
  entry.count = 1;
  addTriangles(entry, triangles);
  if (std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z)) {
    entry.diagnostic.hasPlace = true;
    entry.diagnostic.place = place;
  }
  entries_.push_back(std::move(entry));
}

void BoundaryReport::addNode(DiagnosticCode code, std::uint32_t node, std::vector<double> values) {
  add(code, {{EntityKind::kSurfaceNode, node}}, pointOf(mesh_, node), std::move(values));
}

void BoundaryReport::addNodePair(DiagnosticCode code, std::uint32_t a, std::uint32_t b) {
  add(code, {{EntityKind::kSurfaceNode, a}, {EntityKind::kSurfaceNode, b}}, pointOf(mesh_, a), {});
}

void BoundaryReport::addTriangle(DiagnosticCode code, std::uint32_t triangle,
                                 std::vector<double> values) {
  const std::array<std::uint32_t, 1> triangles{triangle};
  const std::size_t i = 3 * std::size_t{triangle};
  const std::size_t nodes = mesh_.points.size() / 3;
  Vec3 place(std::nan(""));
  if (std::max({mesh_.triangles[i], mesh_.triangles[i + 1], mesh_.triangles[i + 2]}) < nodes) {
    place = centroidOf(triangle);
  }
  if (isDrawn()) {
    add(code, {patchOf(triangle)}, place, std::move(values), triangles);
  } else {
    add(code, {{EntityKind::kTriangle, triangle}}, place, std::move(values));
  }
}

void BoundaryReport::addTrianglePair(DiagnosticCode code, std::uint32_t a, std::uint32_t b,
                                     const Vec3& place) {
  if (!isDrawn()) {
    add(code, {{EntityKind::kTriangle, a}, {EntityKind::kTriangle, b}}, place, {});
    return;
  }
  std::vector<Entity> entities{patchOf(a), patchOf(b)};
  if (entities[1].index < entities[0].index) std::swap(entities[0], entities[1]);
  if (entities[1].index == entities[0].index) entities.pop_back();
  add(code, std::move(entities), place, {}, std::array{a, b});
}

void BoundaryReport::addEdge(DiagnosticCode code, std::uint32_t from, std::uint32_t to,
                             std::span<const std::uint32_t> triangles) {
  std::vector<Entity> entities;
  std::uint32_t line = 0;
  if (isDrawn()) {
    if (lineOf(from, to, line)) entities.push_back({EntityKind::kLine, line});
    std::vector<std::uint32_t> patches;
    for (const std::uint32_t t : triangles) patches.push_back(mesh_.trianglePatch[t]);
    sortUnique(patches);
    for (const std::uint32_t patch : patches) entities.push_back({EntityKind::kPatch, patch});
  } else {
    for (const std::uint32_t t : triangles) entities.push_back({EntityKind::kTriangle, t});
  }
  add(code, std::move(entities), 0.5 * (pointOf(mesh_, from) + pointOf(mesh_, to)), {},
      isDrawn() ? triangles : std::span<const std::uint32_t>{});
}

void BoundaryReport::addInformation(DiagnosticCode code, std::vector<Entity> entities,
                                    const Vec3& place, std::vector<double> values) {
  Entry entry;
  entry.diagnostic = {code,  Severity::kInformation, std::move(entities), true,
                      place, std::move(values)};
  entry.isCounted = false;
  Kind& kind = kindOf(code);
  ++kind.total;
  // A given surface may have a million inverted shells.
  if (kind.kept == maxDiagnostics_) return;
  ++kind.kept;
  entries_.push_back(std::move(entry));
}

void BoundaryReport::addNesting(std::uint32_t triangle, std::uint32_t regions,
                                std::uint32_t cavities) {
  const Entity entity = isDrawn() ? patchOf(triangle) : Entity{EntityKind::kTriangle, triangle};
  addInformation(DiagnosticCode::kNestedBodies, {entity}, centroidOf(triangle),
                 {static_cast<double>(regions), static_cast<double>(cavities)});
}

void BoundaryReport::addEmpty() {
  ++errors_;
  Entry entry;
  entry.diagnostic.code = DiagnosticCode::kEmptyModel;
  entry.isCounted = false;
  entries_.push_back(std::move(entry));
}

void BoundaryReport::addIncomplete(EntityKind kind, std::size_t index) {
  add(DiagnosticCode::kIndexOutOfRange, {{kind, static_cast<std::uint32_t>(index)}},
      Vec3(std::nan("")), {static_cast<double>(index)});
}

std::vector<Diagnostic> BoundaryReport::take() {
  std::vector<Diagnostic> diagnostics;
  for (Entry& entry : entries_) {
    if (entry.isCounted) {
      const Kind& kind = kindOf(entry.diagnostic.code);
      const std::uint64_t count = isDrawn() ? entry.count : kind.total;
      entry.diagnostic.values.push_back(static_cast<double>(count));
      if (kind.setIncomplete) entry.diagnostic.values.push_back(1.0);
    }
    for (const std::uint32_t triangle : entry.triangles) {
      entry.diagnostic.entities.push_back({EntityKind::kTriangle, triangle});
    }
    diagnostics.push_back(std::move(entry.diagnostic));
  }
  entries_.clear();
  return diagnostics;
}

}  // namespace tetrafront
