#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "surface/boundary.h"
#include "surface/boundary_soundness.h"
#include "surface/edge_table.h"
#include "surface/hole_filling.h"
#include "surface/sliver_splitting.h"
#include "surface/surface_access.h"
#include "surface/surface_sides.h"
#include "surface/weld.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {
namespace {

/// A surface under repair: its nodes keep their given numbers until the end.
class Repair {
 public:
  Repair(std::span<const double> points, std::span<const std::uint32_t> triangles) {
    mesh_.points.assign(points.begin(), points.end());
    mesh_.triangles.assign(triangles.begin(), triangles.end());
    origin_.resize(triangles.size() / 3);
    for (std::uint32_t t = 0; t < origin_.size(); ++t) origin_[t] = t;
    isWelded_.resize(points.size() / 3, 0);
  }

  [[nodiscard]] std::vector<Diagnostic> brokenNumbers() const {
    BoundaryReport report(mesh_, BoundarySource::kGivenSurface);
    checkNumbers(mesh_, report);
    return report.take();
  }

  void weld(double distance);
  void removeTriangles();
  void fill(std::uint32_t mostEdges);
  void turn();

  /// With the nodes that are used only, in their order.
  [[nodiscard]] SurfaceRepair take();

 private:
  using Triangle = std::array<std::uint32_t, 3>;

  [[nodiscard]] Triangle nodesOfTriangle(std::uint32_t t) const {
    const std::size_t i = 3 * std::size_t{t};
    return {mesh_.triangles[i], mesh_.triangles[i + 1], mesh_.triangles[i + 2]};
  }
  void put(std::uint32_t t, const Triangle& nodes) {
    std::copy(nodes.begin(), nodes.end(), &mesh_.triangles[3 * std::size_t{t}]);
  }
  [[nodiscard]] std::uint32_t triangleCount() const {
    return static_cast<std::uint32_t>(mesh_.triangles.size() / 3);
  }
  void add(RepairKind kind, std::uint32_t first, std::uint32_t second, const Vec3& place) {
    changes_.push_back({kind, first, second, place});
  }
  void addAt(RepairKind kind, std::uint32_t triangle, std::uint32_t second);

  void removeRepeating();
  void dissolveSlivers();
  void removeSlivers();
  void removeDuplicates();
  void keep(const std::vector<std::uint8_t>& isGone);
  void turnOutward();

  SurfaceMesh mesh_;
  std::vector<std::uint32_t> origin_;
  std::vector<std::uint8_t> isWelded_;  ///< nodes that are others now
  std::vector<RepairChange> changes_;
};

void Repair::addAt(RepairKind kind, std::uint32_t triangle, std::uint32_t second) {
  const std::array<Vec3, 3> p = cornersOf(mesh_, triangle);
  add(kind, origin_[triangle], second, (p[0] + p[1] + p[2]) / 3.0);
}

void Repair::weld(double distance) {
  const std::vector<std::uint32_t> target = weldedNodes(mesh_.points, distance);
  for (std::uint32_t i = 0; i < target.size(); ++i) {
    if (target[i] == i) continue;
    isWelded_[i] = 1;
    add(RepairKind::kWeldedNode, i, target[i], pointOf(mesh_, i));
  }
  for (std::uint32_t& node : mesh_.triangles) node = target[node];
}

void Repair::keep(const std::vector<std::uint8_t>& isGone) {
  std::uint32_t kept = 0;
  for (std::uint32_t t = 0; t < isGone.size(); ++t) {
    if (isGone[t] != 0) continue;
    const Triangle nodes = nodesOfTriangle(t);
    put(kept, nodes);
    origin_[kept++] = origin_[t];
  }
  mesh_.triangles.resize(3 * std::size_t{kept});
  origin_.resize(kept);
}

void Repair::removeTriangles() {
  removeRepeating();
  removeDuplicates();
  dissolveSlivers();
  removeSlivers();
  removeDuplicates();
}

void Repair::removeRepeating() {
  std::vector<std::uint8_t> isGone(triangleCount(), 0);
  for (std::uint32_t t = 0; t < isGone.size(); ++t) {
    const auto [a, b, c] = nodesOfTriangle(t);
    if (a != b && b != c && c != a) continue;
    isGone[t] = 1;
    addAt(RepairKind::kRemovedTriangle, t, kNoOrigin);
  }
  keep(isGone);
}

/// Those beside others that have area; the shape is the same.
void Repair::dissolveSlivers() {
  for (const auto& [sliver, other, middle] : splitBesideSlivers(mesh_)) {
    add(RepairKind::kSplitTriangle, origin_[sliver], origin_[other], pointOf(mesh_, middle));
    origin_[sliver] = origin_[other];
  }
}

void Repair::removeSlivers() {
  std::vector<std::uint8_t> isGone(triangleCount(), 0);
  for (std::uint32_t t = 0; t < isGone.size(); ++t) {
    if (!isSliver(mesh_, t)) continue;
    isGone[t] = 1;
    addAt(RepairKind::kRemovedTriangle, t, kNoOrigin);
  }
  keep(isGone);
}

void Repair::removeDuplicates() {
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  for (std::uint32_t t = 0; t < triangleCount(); ++t) {
    Triangle nodes = nodesOfTriangle(t);
    std::sort(nodes.begin(), nodes.end());
    sorted.emplace_back(nodes, t);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> sameAs(triangleCount(), kNoOrigin);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    const std::uint32_t before = sorted[i - 1].second;
    sameAs[sorted[i].second] = sameAs[before] == kNoOrigin ? before : sameAs[before];
  }
  std::vector<std::uint8_t> isGone(triangleCount(), 0);
  for (std::uint32_t t = 0; t < isGone.size(); ++t) {
    if (sameAs[t] == kNoOrigin) continue;
    isGone[t] = 1;
    addAt(RepairKind::kRemovedDuplicate, t, origin_[sameAs[t]]);
  }
  keep(isGone);
}

void Repair::fill(std::uint32_t mostEdges) {
  for (const FilledHole& hole : fillHoles(mesh_, mostEdges)) {
    Vec3 place(0.0);
    for (std::uint32_t t = 0; t < hole.triangles; ++t) {
      const std::array<Vec3, 3> p = cornersOf(mesh_, hole.firstTriangle + t);
      place += (p[0] + p[1] + p[2]) / (3.0 * hole.triangles);
    }
    add(RepairKind::kFilledHole, hole.firstTriangle, hole.triangles, place);
  }
  origin_.resize(triangleCount(), kNoOrigin);
}

void Repair::turn() {
  const std::vector<std::uint32_t> before = mesh_.triangles;
  turnOutward();
  for (std::uint32_t t = 0; t < triangleCount(); ++t) {
    const bool isTurned = before[3 * std::size_t{t} + 1] != mesh_.triangles[3 * std::size_t{t} + 1];
    if (isTurned && origin_[t] != kNoOrigin) addAt(RepairKind::kTurnedTriangle, t, kNoOrigin);
  }
}

/// As the boundary check does it; where that refuses, triangles at least agree with each other. With
/// crowded edges nobody knows who the neighbours are, and nothing is turned.
void Repair::turnOutward() {
  SurfaceMesh outward = mesh_;
  std::vector<Diagnostic> ignored;
  if (closeBoundary(outward, BoundarySource::kGivenSurface, ignored).valid) {
    mesh_.triangles = outward.triangles;
    return;
  }
  const EdgeTable edges(mesh_.triangles, mesh_.points.size() / 3, {});
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    if (edges.halfEdgesOf(e).size() > 2) return;
  }
  static_cast<void>(turnAlike(mesh_, edges));
}

SurfaceRepair Repair::take() {
  SurfaceRepair repair;
  constexpr std::uint32_t kUnused = 0xffffffffU;
  std::vector<std::uint32_t> number(mesh_.points.size() / 3, kUnused);
  for (const std::uint32_t node : mesh_.triangles) number[node] = 0;
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    const Vec3 p = pointOf(mesh_, i);
    if (number[i] == kUnused) {
      if (isWelded_[i] == 0) add(RepairKind::kDroppedNode, i, kNoOrigin, p);
      continue;
    }
    number[i] = count++;
    repair.points.insert(repair.points.end(), {p.x, p.y, p.z});
  }
  for (std::uint32_t& node : mesh_.triangles) node = number[node];
  repair.triangles = std::move(mesh_.triangles);
  repair.origin = std::move(origin_);
  for (std::uint8_t kind = 0; kind <= static_cast<std::uint8_t>(RepairKind::kTurnedTriangle);
       ++kind) {
    std::copy_if(changes_.begin(), changes_.end(), std::back_inserter(repair.changes),
                 [kind](const RepairChange& change) {
                   return static_cast<std::uint8_t>(change.kind) == kind;
                 });
  }
  return repair;
}

}  // namespace

SurfaceRepair repairSurface(std::span<const double> points,
                            std::span<const std::uint32_t> triangles,
                            const RepairOptions& options) {
  Repair repair(points, triangles);
  if (std::vector<Diagnostic> broken = repair.brokenNumbers(); !broken.empty()) {
    SurfaceRepair nothing;
    nothing.points.assign(points.begin(), points.end());
    nothing.triangles.assign(triangles.begin(), triangles.end());
    for (std::uint32_t t = 0; t < triangles.size() / 3; ++t) nothing.origin.push_back(t);
    nothing.diagnostics = std::move(broken);
    return nothing;
  }
  if (options.weldDistance >= 0.0) repair.weld(options.weldDistance);
  if (options.removesTriangles) repair.removeTriangles();
  if (options.fillsUpTo > 0) repair.fill(std::min(options.fillsUpTo, kMostHoleEdges));
  if (options.turns) repair.turn();
  return repair.take();
}

}  // namespace tetrafront
