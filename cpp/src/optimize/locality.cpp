#include "optimize/locality.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "search/morton.h"
#include "topology/tet_mesh.h"

namespace tetrafront {
namespace {

/// Elements per unit of budget: copying one in the order of a list costs far less than a step of the front.
constexpr std::size_t kVisitedPerUnit = 32;

Vec3 centroidOf(const TetMesh& mesh, TetId tet) {
  Vec3 sum(0.0);
  for (const NodeId node : mesh.tetrahedra[tet.index()]) sum += mesh.points[node.index()];
  return sum * 0.25;
}

/// Returns the elements in the order of a Morton curve.
Task<std::vector<std::uint32_t>> mortonOrderOf(Work& work, const TetMesh& mesh) {
  work.beginPart(0.25);
  std::vector<Vec3> centroids(mesh.tetrahedra.size());
  co_await work.forEachId<TetId>(
      centroids.size(), [&](TetId tet) { centroids[tet.index()] = centroidOf(mesh, tet); },
      kVisitedPerUnit);
  work.beginPart(1.0);
  std::vector<std::uint32_t> order = co_await mortonOrder(work, centroids, kVisitedPerUnit);
  co_return order;
}

/// Copies the fixed nodes, then elements, and those of their nodes that no earlier element has.
class OrderedCopy {
 public:
  explicit OrderedCopy(const TetMesh& mesh) : mesh_(mesh), newId_(mesh.points.size()) {
    ordered_.points.reserve(mesh.points.size());
    for (const NodeId node : IdRange<NodeId>(mesh.points.size())) {
      if (mesh.isFixed[node.index()] != 0) addNode(node);
    }
    ordered_.tetrahedra.reserve(mesh.tetrahedra.size());
    ordered_.regions.reserve(mesh.regions.size());
  }

  void add(TetId tet) {
    NodeQuad nodes = mesh_.tetrahedra[tet.index()];
    for (NodeId& node : nodes) {
      if (newId_[node.index()].isNone()) addNode(node);
      node = newId_[node.index()];
    }
    ordered_.tetrahedra.push_back(nodes);
    ordered_.regions.push_back(mesh_.regions[tet.index()]);
  }

  [[nodiscard]] TetMesh take() { return std::move(ordered_); }

 private:
  void addNode(NodeId node) {
    newId_[node.index()] = NodeId(ordered_.points.size());
    ordered_.points.push_back(mesh_.points[node.index()]);
    ordered_.isFixed.push_back(mesh_.isFixed[node.index()]);
  }

  const TetMesh& mesh_;
  std::vector<NodeId> newId_;
  TetMesh ordered_;
};

}  // namespace

Task<> orderAlongMortonCurve(Work& work, TetMesh& mesh) {
  work.beginPart(0.7);
  const std::vector<std::uint32_t> order = co_await mortonOrderOf(work, mesh);
  work.beginPart(1.0);
  OrderedCopy copy(mesh);
  co_await work.forEachBlock(
      order.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) copy.add(TetId(order[i]));
      },
      kVisitedPerUnit);
  mesh = copy.take();
}

}  // namespace tetrafront
