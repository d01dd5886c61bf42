#include "repair/crack_welding.h"

#include <array>
#include <utility>

#include "boundary/weld.h"
#include "topology/edge_table.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Distances / diagonal of the surface: from the rounding of single precision and of CAD programs up to cracks that are
/// visible, but smaller than most details.
constexpr std::array<double, 6> kCrackWidths{1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4};

/// Returns the nodes of the edges with one triangle, ascending, with their number.
struct OpenEdges {
  std::vector<NodeId> nodes;
  std::size_t count = 0;
};

OpenEdges openEdgesOf(std::span<const std::uint32_t> triangles, std::uint32_t nodeCount) {
  std::vector<std::uint8_t> isIgnored(triangles.size() / 3, 0);
  for (std::size_t t = 0; t < isIgnored.size(); ++t) {
    const std::array nodes{triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]};
    isIgnored[t] = hasRepeatedNode(nodes) ? 1 : 0;
  }
  const EdgeTable edges(triangles, nodeCount, isIgnored);
  std::vector<std::uint8_t> isOpen(nodeCount, 0);
  OpenEdges open;
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    if (halfEdges.size() != 1) continue;
    const HalfEdgeNodes nodes = nodesOf(triangles, halfEdges[0]);
    isOpen[nodes.from.index()] = isOpen[nodes.to.index()] = 1;
    ++open.count;
  }
  for (std::uint32_t i = 0; i < nodeCount; ++i) {
    if (isOpen[i] != 0) open.nodes.emplace_back(i);
  }
  return open;
}

}  // namespace

Task<std::vector<NodeId>> weldCracks(Work& work, const SurfaceMesh& mesh) {
  const OpenEdges open = openEdgesOf(mesh.triangles, countNodes(mesh));
  std::vector<NodeId> best;
  if (open.count == 0) co_return best;
  std::size_t fewest = open.count;
  std::vector<double> points;
  for (const NodeId node : open.nodes) {
    const Vec3 p = pointOf(mesh, node);
    points.insert(points.end(), {p.x, p.y, p.z});
  }
  const Bounds bounds = boundsOf(mesh);
  const double diagonal = glm::length(bounds.high - bounds.low);
  for (const double width : kCrackWidths) {
    const std::vector<NodeId> found = co_await findWeldTargets(work, points, width * diagonal);
    std::vector<NodeId> target(countNodes(mesh));
    for (std::uint32_t i = 0; i < target.size(); ++i) target[i] = NodeId(i);
    for (std::size_t i = 0; i < found.size(); ++i) {
      target[open.nodes[i].index()] = open.nodes[found[i].index()];
    }
    std::vector<std::uint32_t> triangles = mesh.triangles;
    for (std::uint32_t& node : triangles) node = target[node].value;
    const std::size_t left = openEdgesOf(triangles, countNodes(mesh)).count;
    co_await work.yield();
    if (left >= fewest) continue;
    fewest = left;
    best = std::move(target);
    if (left == 0) break;
  }
  co_return best;
}

}  // namespace tetrafront
