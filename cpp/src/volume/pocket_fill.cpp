#include "volume/pocket_fill.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"

namespace tetrafront {

PocketFill::PocketFill(const Front& front, Pocket pocket, unsigned order, std::uint64_t limit)
    : pocket_(std::move(pocket)), fill_(taskFor(front, pocket_, nodes_), order, limit) {}

FillTask PocketFill::taskFor(const Front& front, const Pocket& pocket, std::vector<NodeId>& nodes) {
  for (const FaceId face : pocket.faces) {
    const NodeTriple& n = front.face(face).nodes;
    nodes.insert(nodes.end(), n.begin(), n.end());
  }
  sortUnique(nodes);
  const auto numberOf = [&](NodeId node) {
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), node);
    return NodeId(static_cast<std::size_t>(at - nodes.begin()));
  };
  FillTask task;
  for (const NodeId node : nodes) task.positions.push_back(front.node(node));
  for (const FaceId face : pocket.faces) {
    const NodeTriple& n = front.face(face).nodes;
    task.triangles.push_back({numberOf(n[0]), numberOf(n[1]), numberOf(n[2])});
  }
  return task;
}

std::vector<FaceId> PocketFill::apply(Front& front, Elements& elements) const {
  const FillResult& result = fill_.result();
  std::uint16_t layer = 0;
  for (const NodeId node : nodes_) layer = std::max(layer, front.layer(node));
  const FieldHint hint = front.face(pocket_.faces.front()).hint;
  const auto regionAt = [&](FacetId facet) {
    return front.face(pocket_.faces[facet.index()]).region;
  };
  std::vector<NodeId> nodes = nodes_;
  for (const Vec3& position : result.newPositions)
    nodes.push_back(front.addNode(position, layer, hint));
  for (std::size_t i = 0; i < result.tetrahedra.size(); ++i) {
    const auto& n = result.tetrahedra[i];
    elements.add(
        {nodes[n[0].index()], nodes[n[1].index()], nodes[n[2].index()], nodes[n[3].index()]},
        regionAt(result.facetOfTetrahedron[i]));
  }
  std::vector<FaceId> open;
  for (const FacetId triangle : result.openTriangles) {
    open.push_back(pocket_.faces[triangle.index()]);
  }
  stableSort(open);
  std::vector<std::uint32_t> regions;
  for (const FacetId facet : result.facetOfOpenFace) {
    regions.push_back(regionAt(facet));
  }
  for (const FaceId face : pocket_.faces) {
    if (!std::binary_search(open.begin(), open.end(), face)) front.removeFace(face);
  }
  for (std::size_t i = 0; i < result.openFaces.size(); ++i) {
    const auto& n = result.openFaces[i];
    open.push_back(front.addFace({nodes[n[0].index()], nodes[n[1].index()], nodes[n[2].index()]},
                                 regions[i], hint, false));
  }
  return open;
}

}  // namespace tetrafront
