#include "surface/boundary_orientation.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geom/predicates.h"
#include "surface/surface_access.h"

namespace tetrafront {
namespace {

/// Disjoint sets of triangles whose root is the lowest member; each knows whether it is turned
/// against its root.
class TurnedSets {
 public:
  explicit TurnedSets(std::size_t count) : parent_(count), isTurned_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  struct Root {
    std::uint32_t triangle;
    std::uint8_t isTurned;
  };
  Root find(std::uint32_t t) {
    std::uint8_t turned = 0;
    while (parent_[t] != t) {
      const std::uint32_t parent = parent_[t];
      const std::uint8_t toParent = isTurned_[t];
      turned ^= toParent;
      // Path halving: skip the parent, unless that is the root already.
      isTurned_[t] = toParent ^ (parent_[parent] == parent ? 0 : isTurned_[parent]);
      parent_[t] = parent_[parent];
      t = parent;
    }
    return {t, turned};
  }

  /// False if a and b are in one set already and related otherwise.
  bool join(std::uint32_t a, std::uint32_t b, bool areOpposite) {
    const Root ra = find(a);
    const Root rb = find(b);
    const auto turned =
        static_cast<std::uint8_t>(ra.isTurned ^ rb.isTurned ^ (areOpposite ? 1 : 0));
    if (ra.triangle == rb.triangle) return turned == 0;
    const auto [low, high] = std::minmax(ra.triangle, rb.triangle);
    parent_[high] = low;
    isTurned_[high] = turned;
    return true;
  }

  /// Numbers the sets from 0 in order of their lowest members.
  std::vector<std::uint32_t> numbers() {
    std::vector<std::uint32_t> number(parent_.size());
    std::uint32_t count = 0;
    for (std::uint32_t t = 0; t < number.size(); ++t) {
      const std::uint32_t root = find(t).triangle;
      number[t] = root == t ? count++ : number[root];
    }
    return number;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> isTurned_;
};

}  // namespace

void turnRound(SurfaceMesh& mesh, std::uint32_t triangle) {
  const std::size_t i = 3 * std::size_t{triangle};
  std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
}

void sortByAngle(const SurfaceMesh& mesh, std::vector<std::uint32_t>& halfEdges) {
  const HalfEdgeNodes first = nodesOf(mesh.triangles, halfEdges[0]);
  const Vec3 low = pointOf(mesh, std::min(first.from, first.to));
  const Vec3 high = pointOf(mesh, std::max(first.from, first.to));
  const Vec3 reference = pointOf(mesh, first.apex);
  struct Entry {
    int quarter;  ///< 0 the reference, 1 the half turn after it, 2 opposite to it, 3 the rest
    Vec3 apex;
    std::uint32_t halfEdge;
  };
  std::vector<Entry> entries;
  for (const std::uint32_t h : halfEdges) {
    const Vec3 apex = pointOf(mesh, nodesOf(mesh.triangles, h).apex);
    const int side = orient3d(low, high, reference, apex);
    entries.push_back({h == halfEdges[0] ? 0 : 2 - side, apex, h});
  }
  std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
    if (a.quarter != b.quarter) return a.quarter < b.quarter;
    return orient3d(low, high, a.apex, b.apex) > 0;
  });
  for (std::size_t i = 0; i < entries.size(); ++i) halfEdges[i] = entries[i].halfEdge;
}

std::vector<std::uint32_t> orientConsistently(SurfaceMesh& mesh, const EdgeTable& edges,
                                              BoundaryReport& report) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size() / 3);
  TurnedSets sets(count);
  std::vector<std::uint32_t> around;
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    around.assign(halfEdges.begin(), halfEdges.end());
    if (around.size() > 2) sortByAngle(mesh, around);
    for (std::size_t i = 1; i < around.size(); ++i) {
      const HalfEdgeNodes a = nodesOf(mesh.triangles, around[i - 1]);
      const HalfEdgeNodes b = nodesOf(mesh.triangles, around[i]);
      if (sets.join(around[i - 1] / 3, around[i] / 3, a.from == b.from)) continue;
      const Vec3 place = 0.5 * (pointOf(mesh, a.from) + pointOf(mesh, a.to));
      report.addTrianglePair(DiagnosticCode::kInconsistentOrientation, around[i - 1] / 3,
                             around[i] / 3, place);
    }
  }
  for (std::uint32_t t = 0; t < count; ++t) {
    if (sets.find(t).isTurned != 0) turnRound(mesh, t);
  }
  return sets.numbers();
}

std::vector<std::uint32_t> innerShells(const SurfaceMesh& mesh, const EdgeTable& edges) {
  TurnedSets sets(mesh.triangles.size() / 3);
  std::vector<std::uint32_t> around;
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    if (halfEdges.size() == 2) {
      sets.join(halfEdges[0] / 3, halfEdges[1] / 3, false);
      continue;
    }
    around.assign(halfEdges.begin(), halfEdges.end());
    sortByAngle(mesh, around);
    for (std::size_t i = 0; i < around.size(); ++i) {
      // Outside is where the triangle is seen counter-clockwise: behind a half-edge that runs
      // from the higher to the lower node, the region lies towards the next triangle.
      const HalfEdgeNodes nodes = nodesOf(mesh.triangles, around[i]);
      if (nodes.from < nodes.to) continue;
      sets.join(around[i] / 3, around[(i + 1) % around.size()] / 3, false);
    }
  }
  return sets.numbers();
}

}  // namespace tetrafront
