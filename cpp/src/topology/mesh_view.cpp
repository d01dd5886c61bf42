#include "topology/mesh_view.h"

#include <utility>

namespace tetrafront {

std::uint32_t MeshView::nodeCount() const {
  std::uint32_t count = countNodes(*kept_);
  for (const MeshPart& part : parts_) count += part.source->nodeCount();
  return count;
}

std::uint32_t MeshView::elementCount() const {
  std::uint32_t count = countTetrahedra(*kept_);
  for (const MeshPart& part : parts_) count += part.source->elementCount();
  return count;
}

Vec3 MeshView::pointOf(NodeId node) const {
  std::uint32_t index = node.value;
  for (const MeshPart& part : parts_) {
    if (node.value < part.firstNode) break;
    const std::uint32_t own = part.source->nodeCount();
    if (node.value - part.firstNode < own) {
      return part.source->positionOf(node.value - part.firstNode);
    }
    index -= own;
  }
  return tetrafront::pointOf(*kept_, NodeId(index));
}

/// Returns the elements from this one on that are in the same part, or in the arrays between two parts.
MeshView::Run MeshView::runFrom(std::size_t element) const {
  std::size_t inParts = 0;  // elements of earlier parts
  for (const MeshPart& part : parts_) {
    if (element < part.firstElement) {
      return {nullptr, element - inParts, part.firstElement - element};
    }
    const std::size_t own = part.source->elementCount();
    const std::size_t index = element - part.firstElement;
    if (index < own) return {&part, index, own - index};
    inParts += own;
  }
  const std::size_t index = element - inParts;
  return {nullptr, index, countTetrahedra(*kept_) - index};
}

ElementSource::Element MeshView::elementAt(TetId element) const {
  ElementSource::Element found;
  forEachElement(element.index(), element.index() + 1,
                 [&](TetId /*same*/, const ElementSource::Element& one) { found = one; });
  return found;
}

NodeQuad MeshView::nodesOf(TetId element) const {
  return parts_.empty() ? keptNodes(element.index()) : elementAt(element).nodes;
}

std::array<Vec3, 4> MeshView::cornersOf(TetId element) const { return elementAt(element).corners; }

std::uint32_t MeshView::regionOf(TetId element) const {
  const auto [part, index, count] = runFrom(element.index());
  return part != nullptr ? part->region : kept_->regions[index];
}

std::vector<double> pointsOf(const MeshView& mesh, std::size_t first, std::size_t last) {
  last = std::min<std::size_t>(last, mesh.nodeCount());
  std::vector<double> points;
  points.reserve(3 * (last - std::min(first, last)));
  for (std::size_t node = first; node < last; ++node) {
    const Vec3 p = mesh.pointOf(NodeId(node));
    points.insert(points.end(), {p.x, p.y, p.z});
  }
  return points;
}

std::vector<std::uint32_t> elementsOf(const MeshView& mesh, std::size_t first, std::size_t last) {
  last = std::min<std::size_t>(last, mesh.elementCount());
  std::vector<std::uint32_t> tetrahedra;
  tetrahedra.reserve(4 * (last - std::min(first, last)));
  mesh.forEachElement(first, last, [&](TetId /*tet*/, const ElementSource::Element& element) {
    for (const NodeId node : element.nodes) tetrahedra.push_back(node.value);
  });
  return tetrahedra;
}

std::vector<std::uint32_t> regionRunsOf(const MeshView& mesh) {
  std::vector<std::uint32_t> runs;
  mesh.forEachRegion([&](std::uint32_t region, std::uint32_t count) {
    if (runs.empty() || runs[runs.size() - 2] != region) runs.insert(runs.end(), {region, 0U});
    runs.back() += count;
  });
  return runs;
}

VolumeMesh toVolumeMesh(const MeshView& mesh) {
  const std::size_t elements = mesh.elementCount();
  VolumeMesh whole{.points = pointsOf(mesh, 0, mesh.nodeCount()),
                   .tetrahedra = elementsOf(mesh, 0, elements),
                   .regions = {},
                   .front = mesh.front()};
  whole.regions.reserve(elements);
  mesh.forEachRegion([&](std::uint32_t region, std::uint32_t count) {
    whole.regions.insert(whole.regions.end(), count, region);
  });
  return whole;
}

VolumeMesh toVolumeMesh(PartedMesh mesh) {
  return mesh.parts.empty() ? std::move(mesh.kept) : toVolumeMesh(MeshView(mesh));
}

}  // namespace tetrafront
