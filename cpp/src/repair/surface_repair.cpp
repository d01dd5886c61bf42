#include "repair/surface_repair.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "arrangement/enclosed_surface.h"
#include "base/diagnostics.h"
#include "base/sort.h"
#include "boundary/boundary.h"
#include "boundary/surface_checks.h"
#include "boundary/weld.h"
#include "repair/crack_welding.h"
#include "repair/duplicate_triangles.h"
#include "repair/hole_filling.h"
#include "repair/hole_regions.h"
#include "repair/resolved_changes.h"
#include "repair/shared_volumes.h"
#include "repair/sliver_splitting.h"
#include "repair/surface_closing.h"
#include "topology/edge_table.h"
#include "topology/half_faces.h"
#include "topology/surface_access.h"
#include "topology/tracked_surface.h"

namespace tetrafront {
namespace {

/// Largest area of sheets / area of the surface, for a surface that is replaced by the boundary of what it encloses. If most
/// of it encloses nothing, the enclosed volumes are no body.
constexpr double kMaxSheetShare = 0.5;

/// A surface under repair. Its nodes keep their given indices until take().
class RepairedSurface {
 public:
  RepairedSurface(SurfaceMesh& mesh, const RepairOptions& options)
      : options_(options),
        givenRegions_(std::exchange(mesh.triangleRegions, {})),
        surface_(trackedFrom(std::move(mesh))),
        isWelded_(countNodes(surface_.mesh), 0) {}

  Task<> run(Work& work) {
    if (options_.weldDistance >= 0.0) {
      work.beginPart(0.2);
      co_await weld(work);
    }
    if (options_.removeTriangles) {
      work.beginPart(0.4);
      co_await removeInvalidTriangles(work);
    }
    if (options_.maxHoleEdges > 0) {
      work.beginPart(0.6);
      co_await fill(work);
    }
    if (!options_.orient && !options_.resolveIntersections) co_return;
    work.beginPart(0.7);
    bool isValid = co_await check(work);
    if (!isValid && options_.resolveIntersections) {
      work.beginPart(0.75);
      const bool isWelded = co_await closeCracks(work);
      if (isWelded) isValid = co_await check(work);
    }
    if (!isValid && options_.resolveIntersections) {
      work.beginPart(1.0);
      const bool isResolved = co_await resolve(work);
      if (isResolved) co_return;
    }
    if (options_.orient) orient(isValid);
  }

  /// Returns the result, in which only the used nodes are left, in their order.
  [[nodiscard]] SurfaceRepair take();

 private:
  Task<> weld(Work& work);
  Task<> removeInvalidTriangles(Work& work);
  Task<> fill(Work& work);
  Task<bool> check(Work& work);
  Task<bool> closeCracks(Work& work);
  Task<bool> resolve(Work& work);
  Task<bool> resolveRegions(Work& work, const TrackedSurface& closed,
                            const std::vector<FilledHole>& closedHoles);
  void reportUnresolved(const TrackedSurface& closed, const EnclosedSurface& enclosed);
  Task<bool> takeAny(Work& work, const TrackedSurface& closed,
                     const std::vector<FilledHole>& closedHoles,
                     std::vector<EnclosedSurface>& results);
  Task<bool> takeEnclosed(Work& work, const TrackedSurface& closed,
                          const std::vector<FilledHole>& closedHoles, EnclosedSurface& enclosed);

  void applyWeld(const std::vector<NodeId>& target);
  void removeTrianglesWithRepeatedNodes();
  void removeDuplicates();
  void keepDuplicate(TriangleId triangle);
  void splitSlivers();
  void removeSlivers();
  template <class Condition>
  void removeIf(const Condition& condition);
  void orient(bool isValid);
  void orientIfManifold(SurfaceMesh& oriented) const;
  void keepHoles(const SurfaceMesh& mesh, const std::vector<FilledHole>& holes);
  void takeResolved(const TrackedSurface& closed, EnclosedSurface& enclosed);

  void add(RepairKind kind, std::uint32_t first, std::uint32_t second, const Vec3& position) {
    changes_.push_back({kind, first, second, position});
  }
  void addAt(RepairKind kind, TriangleId triangle, TriangleId second = {}) {
    add(kind, surface_.origin[triangle.index()].value, second.value,
        centroidOf(cornersOf(surface_.mesh, triangle)));
  }

  struct Hole {
    FilledHole triangles;
    Vec3 position{0.0};
  };

  const RepairOptions& options_;
  std::vector<std::uint32_t> givenRegions_;  ///< two per given triangle, or empty
  TrackedSurface surface_;
  /// Triangles that were removed because others have the same nodes, if regions are given: they may bound another region. Their
  /// nodes are those of the surface.
  TrackedSurface duplicates_;
  std::vector<std::uint32_t> triangleRegions_;  ///< of the result
  std::vector<SharedVolume> sharedVolumes_;
  SurfaceMesh oriented_;                ///< the surface as the boundary check leaves it
  std::vector<std::uint8_t> isWelded_;  ///< per node: whether it is replaced by another, or new
  std::vector<Hole> holes_;             ///< in the order of their triangles
  std::vector<RepairChange> changes_;
  double deviation_ = 0.0;
  std::vector<Diagnostic> warnings_;
};

Task<> RepairedSurface::weld(Work& work) {
  const std::vector<NodeId> target =
      co_await findWeldTargets(work, surface_.mesh.points, options_.weldDistance);
  applyWeld(target);
}

void RepairedSurface::applyWeld(const std::vector<NodeId>& target) {
  for (std::uint32_t i = 0; i < target.size(); ++i) {
    if (target[i] == NodeId(i)) continue;
    isWelded_[i] = 1;
    add(RepairKind::kWeldedNode, i, target[i].value, pointOf(surface_.mesh, NodeId(i)));
    const double distance =
        glm::length(pointOf(surface_.mesh, target[i]) - pointOf(surface_.mesh, NodeId(i)));
    deviation_ = std::max(deviation_, distance);
  }
  for (std::uint32_t& node : surface_.mesh.triangles) node = target[node].value;
  for (std::uint32_t& node : duplicates_.mesh.triangles) node = target[node].value;
}

/// Welds nodes of cracks. Returns whether there were any.
Task<bool> RepairedSurface::closeCracks(Work& work) {
  const std::vector<NodeId> target = co_await weldCracks(work, surface_.mesh);
  if (target.empty()) co_return false;
  applyWeld(target);
  if (options_.removeTriangles) co_await removeInvalidTriangles(work);
  co_return true;
}

Task<> RepairedSurface::removeInvalidTriangles(Work& work) {
  removeTrianglesWithRepeatedNodes();
  co_await work.yield();
  removeDuplicates();
  co_await work.yield();
  splitSlivers();
  co_await work.yield();
  removeSlivers();
  co_await work.yield();
  // A split can produce a triangle that exists already.
  removeDuplicates();
  co_await work.yield();
}

/// Removes the triangles for which the condition holds, and lists them.
template <class Condition>
void RepairedSurface::removeIf(const Condition& condition) {
  removeTriangles(surface_, [&](TriangleId t) {
    if (!condition(t)) return false;
    addAt(RepairKind::kRemovedTriangle, t);
    return true;
  });
}

void RepairedSurface::removeTrianglesWithRepeatedNodes() {
  removeIf(
      [this](TriangleId triangle) { return hasRepeatedNode(nodesOf(surface_.mesh, triangle)); });
}

/// Splits triangles next to slivers, which does not change the shape.
void RepairedSurface::splitSlivers() {
  for (const auto& [sliver, other, middle] : splitBesideSlivers(surface_.mesh)) {
    const TriangleId origin = surface_.origin[other.index()];
    add(RepairKind::kSplitTriangle, surface_.origin[sliver.index()].value, origin.value,
        pointOf(surface_.mesh, middle));
    surface_.origin[sliver.index()] = origin;
  }
}

void RepairedSurface::removeSlivers() {
  removeIf([this](TriangleId triangle) { return isSliver(surface_.mesh, triangle); });
}

void RepairedSurface::removeDuplicates() {
  const std::vector<TriangleId> firstOf = findDuplicateTriangles(surface_.mesh);
  removeTriangles(surface_, [&](TriangleId t) {
    const TriangleId first = firstOf[t.index()];
    if (first.isNone()) return false;
    addAt(RepairKind::kRemovedDuplicate, t, surface_.origin[first.index()]);
    keepDuplicate(t);
    return true;
  });
}

void RepairedSurface::keepDuplicate(TriangleId triangle) {
  if (givenRegions_.empty()) return;
  for (const NodeId node : nodesOf(surface_.mesh, triangle)) {
    duplicates_.mesh.triangles.push_back(node.value);
  }
  duplicates_.origin.push_back(surface_.origin[triangle.index()]);
}

Task<> RepairedSurface::fill(Work& work) {
  const std::uint32_t maxEdges = std::min(options_.maxHoleEdges, kMaxHoleEdges);
  const std::vector<FilledHole> filled = co_await fillHoles(work, surface_.mesh, maxEdges);
  keepHoles(surface_.mesh, filled);
  surface_.origin.resize(countTriangles(surface_.mesh));
}

void RepairedSurface::keepHoles(const SurfaceMesh& mesh, const std::vector<FilledHole>& holes) {
  for (const FilledHole& hole : holes) {
    Vec3 position(0.0);
    for (std::uint32_t t = 0; t < hole.triangleCount; ++t) {
      const TriangleId triangle(hole.firstTriangle.value + t);
      const std::array<Vec3, 3> p = cornersOf(mesh, triangle);
      position += (p[0] + p[1] + p[2]) / (3.0 * hole.triangleCount);
    }
    holes_.push_back({hole, position});
  }
}

/// Returns whether the boundary check accepts the surface.
Task<bool> RepairedSurface::check(Work& work) {
  oriented_.points = surface_.mesh.points;
  oriented_.triangles = surface_.mesh.triangles;
  BoundaryCheck boundary(oriented_, BoundarySource::kGivenSurface, options_.innerShells);
  co_await work.finish(boundary);
  co_return boundary.result().isValid;
}

/// Replaces the surface by the boundary of what it encloses. Returns false, without a change, if the boundary check
/// does not accept this boundary.
Task<bool> RepairedSurface::resolve(Work& work) {
  TrackedSurface closed = surface_;
  const std::vector<FilledHole> closedHoles = closeSurface(closed.mesh);
  closed.origin.resize(countTriangles(closed.mesh));
  co_await work.yield();
  if (!givenRegions_.empty()) {
    work.beginPart(0.4);
    const bool isTaken = co_await resolveRegions(work, closed, closedHoles);
    if (isTaken) co_return true;
  }
  work.beginPart(0.8);
  std::vector<EnclosedSurface> results =
      co_await encloseSurface(work, closed.mesh, options_.weldIntersections);
  work.beginPart(1.0);
  const bool isTaken = co_await takeAny(work, closed, closedHoles, results);
  if (!isTaken) reportUnresolved(closed, results.back());
  co_return isTaken;
}

/// Replaces the surface by the first result that is accepted. Returns false, without a change, if none is.
Task<bool> RepairedSurface::takeAny(Work& work, const TrackedSurface& closed,
                                    const std::vector<FilledHole>& closedHoles,
                                    std::vector<EnclosedSurface>& results) {
  for (EnclosedSurface& enclosed : results) {
    const bool isTaken = co_await takeEnclosed(work, closed, closedHoles, enclosed);
    if (isTaken) co_return true;
  }
  co_return false;
}

/// Replaces the surface by the boundaries of its regions, if some of them share volumes. Returns false, without a change, if none
/// do, if a hole is between different regions, or if the result is not accepted.
Task<bool> RepairedSurface::resolveRegions(Work& work, const TrackedSurface& closed,
                                           const std::vector<FilledHole>& closedHoles) {
  TrackedSurface whole = closed;
  std::vector<std::uint32_t>& triangles = whole.mesh.triangles;
  triangles.insert(triangles.end(), duplicates_.mesh.triangles.begin(),
                   duplicates_.mesh.triangles.end());
  whole.origin.insert(whole.origin.end(), duplicates_.origin.begin(), duplicates_.origin.end());
  if (!assignRegions(whole, givenRegions_)) co_return false;
  work.beginPart(0.8);
  std::vector<EnclosedSurface> results =
      co_await encloseSurface(work, whole.mesh, options_.weldIntersections);
  work.beginPart(1.0);
  const bool isTaken = co_await takeAny(work, whole, closedHoles, results);
  co_return isTaken;
}

/// Says why the surface stays as it is, and where.
void RepairedSurface::reportUnresolved(const TrackedSurface& closed,
                                       const EnclosedSurface& enclosed) {
  Diagnostic warning =
      diagnose<DiagnosticCode::kUnresolvedSurface>(enclosed.reason, enclosed.pairs, enclosed.limit)
          .withSeverity(Severity::kWarning);
  if (!enclosed.where.isNone()) {
    warning = std::move(warning).at(centroidOf(cornersOf(closed.mesh, enclosed.where)));
    const TriangleId given = closed.origin[enclosed.where.index()];
    if (!given.isNone()) warning.entities = {entityOf(given)};
  }
  warnings_.push_back(std::move(warning));
}

/// Takes one result, if the boundary check accepts it. Otherwise notes why not.
Task<bool> RepairedSurface::takeEnclosed(Work& work, const TrackedSurface& closed,
                                         const std::vector<FilledHole>& closedHoles,
                                         EnclosedSurface& enclosed) {
  if (!enclosed.isResolved) co_return false;
  if (enclosed.sheetShare > kMaxSheetShare) {
    enclosed.reason = Unresolved::kMostlySheets;
    enclosed.where = firstLeftOut(countTriangles(closed.mesh), enclosed);
    co_return false;
  }
  // The check numbers the regions anew.
  std::vector<std::uint32_t> regions = enclosed.mesh.triangleRegions;
  BoundaryCheck boundary(enclosed.mesh, BoundarySource::kGivenSurface, options_.innerShells);
  boundary.setEmbedded();
  co_await work.finish(boundary);
  if (!boundary.result().isValid) {
    enclosed.reason = Unresolved::kNotAccepted;
    for (const Diagnostic& found : boundary.takeDiagnostics()) {
      if (found.severity != Severity::kError || found.entities.empty()) continue;
      const Entity& entity = found.entities[0];
      if (entity.kind != EntityKind::kTriangle) continue;
      enclosed.where = enclosed.origin[entity.index];
      break;
    }
    co_return false;
  }
  keepHoles(closed.mesh, closedHoles);
  triangleRegions_ = std::move(regions);
  sharedVolumes_ = findSharedVolumes(enclosed.shared);
  const std::vector<RepairChange> resolved = resolvedChanges(surface_, enclosed);
  changes_.insert(changes_.end(), resolved.begin(), resolved.end());
  takeResolved(closed, enclosed);
  co_return true;
}

void RepairedSurface::takeResolved(const TrackedSurface& closed, EnclosedSurface& enclosed) {
  for (Hole& hole : holes_) {
    FilledHole& range = hole.triangles;
    const TriangleId end(range.firstTriangle.value + range.triangleCount);
    const auto first = std::ranges::lower_bound(enclosed.origin, range.firstTriangle);
    const auto last = std::ranges::lower_bound(enclosed.origin, end);
    range = {TriangleId(static_cast<std::size_t>(first - enclosed.origin.begin())),
             static_cast<std::uint32_t>(last - first)};
  }
  std::erase_if(holes_, [](const Hole& hole) { return hole.triangles.triangleCount == 0; });
  surface_.origin = inherited(closed.origin, enclosed.origin);
  deviation_ += enclosed.deviation;
  surface_.mesh = {};
  surface_.mesh.points = std::move(enclosed.mesh.points);
  surface_.mesh.triangles = std::move(enclosed.mesh.triangles);
  isWelded_.resize(countNodes(surface_.mesh), 1);
}

/// Orients the triangles as the boundary check does. If the check refuses the surface, makes the triangles of each
/// component agree with each other.
void RepairedSurface::orient(bool isValid) {
  if (!isValid) {
    oriented_.triangles = surface_.mesh.triangles;
    orientIfManifold(oriented_);
  }
  for (std::uint32_t t = 0; t < countTriangles(surface_.mesh); ++t) {
    const std::size_t second = 3 * std::size_t{t} + 1;
    const bool isFlipped = surface_.mesh.triangles[second] != oriented_.triangles[second];
    if (isFlipped && !surface_.origin[t].isNone())
      addAt(RepairKind::kFlippedTriangle, TriangleId(t));
  }
  surface_.mesh.triangles = std::move(oriented_.triangles);
}

/// At a non-manifold edge it is unknown which triangles should agree, so one such edge prevents any change.
void RepairedSurface::orientIfManifold(SurfaceMesh& oriented) const {
  const EdgeTable edges(oriented.triangles, countNodes(oriented), {});
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    if (edges.halfEdgesOf(EdgeId(e)).size() > 2) return;
  }
  static_cast<void>(orientConsistently(oriented, edges));
}

SurfaceRepair RepairedSurface::take() {
  SurfaceRepair result;
  std::vector<std::uint8_t> isUsed(countNodes(surface_.mesh), 0);
  for (const std::uint32_t node : surface_.mesh.triangles) isUsed[node] = 1;
  std::vector<double> points;
  std::vector<NodeId> newNode(isUsed.size());
  for (std::uint32_t i = 0; i < isUsed.size(); ++i) {
    const Vec3 p = pointOf(surface_.mesh, NodeId(i));
    if (isUsed[i] == 0) {
      if (isWelded_[i] == 0) add(RepairKind::kRemovedNode, i, kNoIndex, p);
      continue;
    }
    newNode[i] = NodeId(points.size() / 3);
    points.insert(points.end(), {p.x, p.y, p.z});
  }
  for (std::uint32_t& node : surface_.mesh.triangles) node = newNode[node].value;
  surface_.mesh.points = std::move(points);
  static_assert(kNoIndex == kNoOrigin);
  moveTo(surface_, result);
  result.deviation = deviation_;
  result.diagnostics = std::move(warnings_);
  for (const auto& [hole, position] : holes_) {
    add(RepairKind::kFilledHole, hole.firstTriangle.value, hole.triangleCount, position);
  }
  stableSort(changes_,
             [](const RepairChange& a, const RepairChange& b) { return a.kind < b.kind; });
  result.changes = std::move(changes_);
  result.triangleRegions = std::move(triangleRegions_);
  result.sharedVolumes = std::move(sharedVolumes_);
  return result;
}

SurfaceRepair unrepaired(SurfaceMesh& mesh, std::vector<Diagnostic> diagnostics) {
  SurfaceRepair result;
  TrackedSurface given = trackedFrom(std::move(mesh));
  moveTo(given, result);
  result.diagnostics = std::move(diagnostics);
  return result;
}

}  // namespace

Task<SurfaceRepair> repairSurface(Work& work, SurfaceMesh& mesh, RepairOptions options) {
  BoundaryReport report(mesh, BoundarySource::kGivenSurface);
  checkNumbers(mesh, report);
  if (report.hasErrors()) co_return unrepaired(mesh, report.take());
  co_await work.yield();
  RepairedSurface surface(mesh, options);
  co_await surface.run(work);
  co_return surface.take();
}

}  // namespace tetrafront
