#include "optimize/locality.h"

#include <cstdint>
#include <numeric>
#include <vector>

#include "base/ids.h"
#include "search/morton.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Elements per unit of budget: copying one in the order of a list costs far less than a step of the front.
constexpr std::size_t kVisitedPerUnit = 32;

Vec3 centroidOf(const VolumeMesh& mesh, TetId tet) {
  Vec3 sum(0.0);
  for (const Vec3& corner : cornersOf(mesh, tet)) sum += corner;
  return sum * 0.25;
}

/// Copies elements, and those of their nodes that no earlier element has.
class OrderedCopy {
 public:
  OrderedCopy(const VolumeMesh& mesh, std::size_t boundaryNodes)
      : mesh_(mesh), newId_(countNodes(mesh), kNoIndex) {
    std::iota(newId_.begin(), newId_.begin() + static_cast<std::ptrdiff_t>(boundaryNodes), 0U);
    ordered_.front = mesh.front;
    ordered_.points.reserve(mesh.points.size());
    ordered_.points.assign(mesh.points.begin(),
                           mesh.points.begin() + static_cast<std::ptrdiff_t>(3 * boundaryNodes));
    ordered_.tetrahedra.reserve(mesh.tetrahedra.size());
    ordered_.regions.reserve(mesh.regions.size());
  }

  void add(TetId tet) {
    for (const NodeId node : nodesOf(mesh_, tet)) {
      std::uint32_t& known = newId_[node.index()];
      if (known == kNoIndex) {
        known = countNodes(ordered_);
        const Vec3 p = pointOf(mesh_, node);
        ordered_.points.insert(ordered_.points.end(), {p.x, p.y, p.z});
      }
      ordered_.tetrahedra.push_back(known);
    }
    ordered_.regions.push_back(mesh_.regions[tet.index()]);
  }

  [[nodiscard]] VolumeMesh take() { return std::move(ordered_); }

 private:
  const VolumeMesh& mesh_;
  std::vector<std::uint32_t> newId_;
  VolumeMesh ordered_;
};

}  // namespace

Task<VolumeMesh> alongMortonCurve(Work& work, const VolumeMesh& mesh, std::size_t boundaryNodes) {
  const std::size_t count = countTetrahedra(mesh);
  work.beginPart(0.2);
  std::vector<Vec3> centroids(count);
  co_await work.forEachId<TetId>(
      count, [&](TetId tet) { centroids[tet.index()] = centroidOf(mesh, tet); }, kVisitedPerUnit);
  work.beginPart(0.7);
  MortonSort sort(centroids);
  co_await work.finish(sort, kVisitedPerUnit);
  const std::vector<std::uint32_t> order = sort.take();
  work.beginPart(1.0);
  OrderedCopy copy(mesh, boundaryNodes);
  co_await work.forEachBlock(
      count,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) copy.add(TetId(order[i]));
      },
      kVisitedPerUnit);
  co_return copy.take();
}

}  // namespace tetrafront
