#include "boundary/boundary_report.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "boundary/surface_access.h"

namespace tetrafront {

Vec3 BoundaryReport::centreOf(std::uint32_t triangle) const {
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

void BoundaryReport::addTriangles(Finding& finding, std::span<const std::uint32_t> triangles) {
  for (const std::uint32_t triangle : triangles) {
    std::vector<std::uint32_t>& known = finding.triangles;
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
    const auto [at, isNew] = known_.try_emplace({code, std::move(key)}, findings_.size());
    if (!isNew) {
      if (at->second == kNotKept) return;
      ++findings_[at->second].count;
      addTriangles(findings_[at->second], triangles);
      return;
    }
    if (kind.kept == listed_) at->second = kNotKept;
  }
  if (kind.kept == listed_) return;
  ++kind.kept;
  Finding finding;
  finding.diagnostic.code = code;
  finding.diagnostic.entities = std::move(entities);
  finding.diagnostic.values = std::move(values);
  finding.count = 1;
  addTriangles(finding, triangles);
  if (std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z)) {
    finding.diagnostic.hasPlace = true;
    finding.diagnostic.place = place;
  }
  findings_.push_back(std::move(finding));
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
    place = centreOf(triangle);
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
  Finding finding;
  finding.diagnostic = {code,  Severity::kInformation, std::move(entities), true,
                        place, std::move(values)};
  finding.isCounted = false;
  Kind& kind = kindOf(code);
  ++kind.total;
  // A given surface may have a million inverted shells.
  if (kind.kept == listed_) return;
  ++kind.kept;
  findings_.push_back(std::move(finding));
}

void BoundaryReport::addNesting(std::uint32_t triangle, std::uint32_t regions,
                                std::uint32_t cavities) {
  const Entity entity = isDrawn() ? patchOf(triangle) : Entity{EntityKind::kTriangle, triangle};
  addInformation(DiagnosticCode::kNestedBodies, {entity}, centreOf(triangle),
                 {static_cast<double>(regions), static_cast<double>(cavities)});
}

void BoundaryReport::addEmpty() {
  ++errors_;
  Finding finding;
  finding.diagnostic.code = DiagnosticCode::kEmptyModel;
  finding.isCounted = false;
  findings_.push_back(std::move(finding));
}

void BoundaryReport::addCutOff(EntityKind kind, std::size_t index) {
  add(DiagnosticCode::kIndexOutOfRange, {{kind, static_cast<std::uint32_t>(index)}},
      Vec3(std::nan("")), {static_cast<double>(index)});
}

std::vector<Diagnostic> BoundaryReport::take() {
  std::vector<Diagnostic> diagnostics;
  for (Finding& finding : findings_) {
    if (finding.isCounted) {
      const Kind& kind = kindOf(finding.diagnostic.code);
      const std::uint64_t count = isDrawn() ? finding.count : kind.total;
      finding.diagnostic.values.push_back(static_cast<double>(count));
      if (kind.endedEarly) finding.diagnostic.values.push_back(1.0);
    }
    for (const std::uint32_t triangle : finding.triangles) {
      finding.diagnostic.entities.push_back({EntityKind::kTriangle, triangle});
    }
    diagnostics.push_back(std::move(finding.diagnostic));
  }
  findings_.clear();
  return diagnostics;
}

}  // namespace tetrafront
