#include "repair/surface_repair.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/sort.h"
#include "boundary/boundary.h"
#include "boundary/edge_table.h"
#include "boundary/half_faces.h"
#include "boundary/surface_access.h"
#include "boundary/surface_checks.h"
#include "repair/hole_filling.h"
#include "repair/sliver_splitting.h"
#include "repair/weld.h"

namespace tetrafront {
namespace {

/// Returns the values of the ids; none becomes kNoOrigin.
std::vector<std::uint32_t> valuesOf(const std::vector<TriangleId>& ids) {
  static_assert(kNoIndex == kNoOrigin);
  std::vector<std::uint32_t> values;
  values.reserve(ids.size());
  for (const TriangleId id : ids) values.push_back(id.value);
  return values;
}

/// A surface under repair. Its nodes keep their given indices until take().
class RepairedSurface {
 public:
  RepairedSurface(SurfaceMesh& mesh, const RepairOptions& options)
      : mesh_(mesh), options_(options), isWelded_(countNodes(mesh), 0) {
    for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) origin_.emplace_back(t);
  }

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
    if (options_.orient) {
      work.beginPart(1.0);
      co_await orient(work);
    }
  }

  /// Returns the result, in which only the used nodes are left, in their order.
  [[nodiscard]] SurfaceRepair take();

 private:
  Task<> weld(Work& work);
  Task<> removeInvalidTriangles(Work& work);
  Task<> fill(Work& work);
  Task<> orient(Work& work);

  void removeTrianglesWithRepeatedNodes();
  void removeDuplicates();
  void splitSlivers();
  void removeSlivers();
  void remove(const std::vector<std::uint8_t>& isRemoved);
  void orientIfManifold(SurfaceMesh& oriented) const;

  void add(RepairKind kind, std::uint32_t first, std::uint32_t second, const Vec3& position) {
    changes_.push_back({kind, first, second, position});
  }
  void addAt(RepairKind kind, TriangleId triangle, TriangleId second = {}) {
    add(kind, origin_[triangle.index()].value, second.value,
        centroidOf(cornersOf(mesh_, triangle)));
  }

  SurfaceMesh& mesh_;
  const RepairOptions& options_;
  std::vector<TriangleId> origin_;      ///< per triangle: its index in the given surface, or none
  std::vector<std::uint8_t> isWelded_;  ///< per node: whether it is replaced by another
  std::vector<RepairChange> changes_;
};

Task<> RepairedSurface::weld(Work& work) {
  const std::vector<NodeId> target =
      co_await findWeldTargets(work, mesh_.points, options_.weldDistance);
  for (std::uint32_t i = 0; i < target.size(); ++i) {
    if (target[i] == NodeId(i)) continue;
    isWelded_[i] = 1;
    add(RepairKind::kWeldedNode, i, target[i].value, pointOf(mesh_, NodeId(i)));
  }
  for (std::uint32_t& node : mesh_.triangles) node = target[node].value;
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

void RepairedSurface::remove(const std::vector<std::uint8_t>& isRemoved) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < isRemoved.size(); ++t) {
    if (isRemoved[t] != 0) continue;
    for (std::size_t k = 0; k < 3; ++k) mesh_.triangles[3 * kept + k] = mesh_.triangles[3 * t + k];
    origin_[kept++] = origin_[t];
  }
  mesh_.triangles.resize(3 * kept);
  origin_.resize(kept);
}

void RepairedSurface::removeTrianglesWithRepeatedNodes() {
  std::vector<std::uint8_t> isRemoved(countTriangles(mesh_), 0);
  for (std::uint32_t t = 0; t < isRemoved.size(); ++t) {
    const auto [a, b, c] = nodesOf(mesh_, TriangleId(t));
    if (a != b && b != c && c != a) continue;
    isRemoved[t] = 1;
    addAt(RepairKind::kRemovedTriangle, TriangleId(t));
  }
  remove(isRemoved);
}

/// Splits triangles next to slivers, which does not change the shape.
void RepairedSurface::splitSlivers() {
  for (const auto& [sliver, other, middle] : splitBesideSlivers(mesh_)) {
    const TriangleId origin = origin_[other.index()];
    add(RepairKind::kSplitTriangle, origin_[sliver.index()].value, origin.value,
        pointOf(mesh_, middle));
    origin_[sliver.index()] = origin;
  }
}

void RepairedSurface::removeSlivers() {
  std::vector<std::uint8_t> isRemoved(countTriangles(mesh_), 0);
  for (std::uint32_t t = 0; t < isRemoved.size(); ++t) {
    if (!isSliver(mesh_, TriangleId(t))) continue;
    isRemoved[t] = 1;
    addAt(RepairKind::kRemovedTriangle, TriangleId(t));
  }
  remove(isRemoved);
}

void RepairedSurface::removeDuplicates() {
  struct Entry {
    NodeTriple nodes;  ///< ascending
    TriangleId triangle;
  };
  std::vector<Entry> byNodes;
  for (std::uint32_t t = 0; t < countTriangles(mesh_); ++t) {
    byNodes.push_back({sorted(nodesOf(mesh_, TriangleId(t))), TriangleId(t)});
  }
  stableSort(byNodes, [](const Entry& a, const Entry& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.triangle < b.triangle;
  });
  std::vector<TriangleId> firstOf(countTriangles(mesh_));
  for (std::size_t i = 1; i < byNodes.size(); ++i) {
    if (byNodes[i].nodes != byNodes[i - 1].nodes) continue;
    const TriangleId before = byNodes[i - 1].triangle;
    const TriangleId first = firstOf[before.index()];
    firstOf[byNodes[i].triangle.index()] = first.isNone() ? before : first;
  }
  std::vector<std::uint8_t> isRemoved(countTriangles(mesh_), 0);
  for (std::uint32_t t = 0; t < isRemoved.size(); ++t) {
    if (firstOf[t].isNone()) continue;
    isRemoved[t] = 1;
    addAt(RepairKind::kRemovedDuplicate, TriangleId(t), origin_[firstOf[t].index()]);
  }
  remove(isRemoved);
}

Task<> RepairedSurface::fill(Work& work) {
  const std::uint32_t maxEdges = std::min(options_.maxHoleEdges, kMaxHoleEdges);
  const std::vector<FilledHole> filled = co_await fillHoles(work, mesh_, maxEdges);
  for (const FilledHole& hole : filled) {
    Vec3 position(0.0);
    for (std::uint32_t t = 0; t < hole.triangleCount; ++t) {
      const TriangleId triangle(hole.firstTriangle.value + t);
      const std::array<Vec3, 3> p = cornersOf(mesh_, triangle);
      position += (p[0] + p[1] + p[2]) / (3.0 * hole.triangleCount);
    }
    add(RepairKind::kFilledHole, hole.firstTriangle.value, hole.triangleCount, position);
  }
  origin_.resize(countTriangles(mesh_));
}

/// Orients the triangles as the boundary check does. If the check refuses the surface, makes the triangles of each
/// component agree with each other.
Task<> RepairedSurface::orient(Work& work) {
  SurfaceMesh oriented = mesh_;
  BoundaryCheck check(oriented, BoundarySource::kGivenSurface, options_.innerShells);
  co_await work.finish(check);
  if (!check.result().isValid) {
    oriented.triangles = mesh_.triangles;
    orientIfManifold(oriented);
  }
  for (std::uint32_t t = 0; t < countTriangles(mesh_); ++t) {
    const std::size_t second = 3 * std::size_t{t} + 1;
    const bool isFlipped = mesh_.triangles[second] != oriented.triangles[second];
    if (isFlipped && !origin_[t].isNone()) addAt(RepairKind::kFlippedTriangle, TriangleId(t));
  }
  mesh_.triangles = std::move(oriented.triangles);
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
  std::vector<std::uint8_t> isUsed(countNodes(mesh_), 0);
  for (const std::uint32_t node : mesh_.triangles) isUsed[node] = 1;
  std::vector<NodeId> newNode(isUsed.size());
  for (std::uint32_t i = 0; i < isUsed.size(); ++i) {
    const Vec3 p = pointOf(mesh_, NodeId(i));
    if (isUsed[i] == 0) {
      if (isWelded_[i] == 0) add(RepairKind::kRemovedNode, i, kNoIndex, p);
      continue;
    }
    newNode[i] = NodeId(result.points.size() / 3);
    result.points.insert(result.points.end(), {p.x, p.y, p.z});
  }
  for (std::uint32_t& node : mesh_.triangles) node = newNode[node].value;
  mesh_.points = {};
  result.triangles = std::move(mesh_.triangles);
  result.origin = valuesOf(origin_);
  stableSort(changes_,
             [](const RepairChange& a, const RepairChange& b) { return a.kind < b.kind; });
  result.changes = std::move(changes_);
  return result;
}

SurfaceRepair unrepaired(SurfaceMesh& mesh, std::vector<Diagnostic> diagnostics) {
  SurfaceRepair result;
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) result.origin.push_back(t);
  result.points = std::move(mesh.points);
  result.triangles = std::move(mesh.triangles);
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
