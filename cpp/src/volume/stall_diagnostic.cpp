#include "volume/stall_diagnostic.h"

#include <algorithm>
#include <vector>

#include "base/diagnostics.h"
#include "base/sort.h"

namespace tetrafront {
namespace {

std::vector<Entity> remainingTriangles(const Front& front, const std::vector<FaceId>& faces,
                                       const SurfaceMesh& boundary) {
  std::vector<NodeTriple> active;
  active.reserve(faces.size());
  for (const FaceId face : faces) active.push_back(smallestFirst(front.face(face).nodes));
  stableSort(active);
  std::vector<Entity> triangles;
  for (std::size_t t = 0; t < boundary.triangles.size() / 3; ++t) {
    if (triangles.size() == kMaxStalledEntities) break;
    if (!std::ranges::binary_search(active, smallestFirst(frontFaceOf(boundary, t)))) continue;
    triangles.push_back({EntityKind::kTriangle, static_cast<std::uint32_t>(t)});
  }
  return triangles;
}

std::vector<Entity> remainingBoundaryNodes(const Front& front, const std::vector<FaceId>& faces,
                                           const SurfaceMesh& boundary) {
  std::vector<NodeId> nodes;
  for (const FaceId face : faces) {
    for (const NodeId node : front.face(face).nodes) {
      if (node.index() < boundary.points.size() / 3) nodes.push_back(node);
    }
  }
  sortUnique(nodes);
  nodes.resize(std::min(nodes.size(), kMaxStalledEntities));
  std::vector<Entity> entities;
  for (const NodeId node : nodes) entities.push_back(entityOf(node));
  return entities;
}

}  // namespace

Diagnostic describeStall(const Front& front, const SurfaceMesh& boundary) {
  Diagnostic stall = diagnose<DiagnosticCode::kStalled>(front.activeCount());
  const std::vector<FaceId> faces = front.activeFaces();
  if (faces.empty()) return stall;
  const NodeTriple& n = front.face(faces.front()).nodes;
  std::vector<Entity> entities = remainingTriangles(front, faces, boundary);
  if (entities.empty()) entities = remainingBoundaryNodes(front, faces, boundary);
  return std::move(stall)
      .about(std::move(entities))
      .at((front.node(n[0]) + front.node(n[1]) + front.node(n[2])) * (1.0 / 3.0));
}

}  // namespace tetrafront
