#pragma once

/// @file A mesh as those see it who read it: arrays, and elements that are made when they are asked for.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/element_source.h"
#include "topology/mesh_access.h"

namespace tetrafront {

/// Where the elements of a source are in a mesh.
struct MeshPart {
  std::shared_ptr<const ElementSource> source;
  std::uint32_t firstShared = 0;  ///< node of the mesh that is the first shared one
  std::uint32_t firstNode = 0;    ///< node of the mesh that is the first of the source's own ones
  std::uint32_t firstElement = 0;
  std::uint32_t region = 0;

  /// Returns the node of the mesh that is this one of the source.
  [[nodiscard]] NodeId nodeOf(NodeId node) const {
    const std::uint32_t shared = source->sharedCount();
    return NodeId(node.value < shared ? firstShared + node.value
                                      : firstNode + (node.value - shared));
  }
};

/// A mesh that owns its parts. `kept` has all other nodes and elements, in their order, with the node ids of the whole mesh.
struct PartedMesh {
  VolumeMesh kept;
  std::vector<MeshPart> parts;  ///< by their first node, and by their first element
};

class MeshView {
 public:
  /// A mesh without parts. It must outlive the view.
  MeshView(const VolumeMesh& mesh) : kept_(&mesh) {}  // NOLINT(google-explicit-constructor)
  /// It must outlive the view.
  MeshView(const PartedMesh& mesh)  // NOLINT(google-explicit-constructor)
      : kept_(&mesh.kept), parts_(mesh.parts) {}

  [[nodiscard]] std::uint32_t nodeCount() const;
  [[nodiscard]] std::uint32_t elementCount() const;
  [[nodiscard]] const std::vector<std::uint32_t>& front() const { return kept_->front; }
  [[nodiscard]] bool hasRegions() const { return kept_->regions.size() >= countTetrahedra(*kept_); }
  [[nodiscard]] Vec3 pointOf(NodeId node) const;
  /// Elements of a part cost far less in forEachElement().
  [[nodiscard]] NodeQuad nodesOf(TetId element) const;
  [[nodiscard]] std::array<Vec3, 4> cornersOf(TetId element) const;
  [[nodiscard]] std::uint32_t regionOf(TetId element) const;
  /// Calls use(region, count) for consecutive elements of one region.
  template <class Use>
  void forEachRegion(Use use) const;

  /// Calls use(TetId, const ElementSource::Element&) for the elements [first, last).
  template <class Use>
  void forEachElement(std::size_t first, std::size_t last, Use use) const {
    forEach<true>(first, last, use);
  }
  /// The same without positions: use(TetId, const NodeQuad&). Indices of nodes may be out of range.
  template <class Use>
  void forEachNodes(std::size_t first, std::size_t last, Use use) const {
    forEach<false>(first, last, [&](TetId tet, const ElementSource::Element& element) {
      use(tet, element.nodes);
    });
  }

 private:
  /// Elements [first, end) of a part, or of the arrays, by their indices there.
  struct Run {
    const MeshPart* part;
    std::size_t first;
    std::size_t count;
  };
  template <bool kWithCorners, class Use>
  void forEach(std::size_t first, std::size_t last, Use use) const;
  [[nodiscard]] Run runFrom(std::size_t element) const;
  [[nodiscard]] ElementSource::Element elementAt(TetId element) const;
  [[nodiscard]] NodeQuad keptNodes(std::size_t element) const {
    return tetrafront::nodesOf(*kept_, TetId(element));
  }

  const VolumeMesh* kept_;
  std::span<const MeshPart> parts_;
};

template <bool kWithCorners, class Use>
void MeshView::forEach(std::size_t first, std::size_t last, Use use) const {
  constexpr std::size_t kBlock = 128;
  while (first < last) {
    const auto [part, index, count] = runFrom(first);
    const std::size_t end = first + std::min(count, last - first);
    if (part == nullptr) {
      for (std::size_t i = index; first < end; ++i, ++first) {
        ElementSource::Element element{keptNodes(i), {}};
        for (std::size_t k = 0; kWithCorners && k < 4; ++k) {
          element.corners[k] = pointOf(element.nodes[k]);
        }
        use(TetId(first), element);
      }
      continue;
    }
    std::array<ElementSource::Element, kBlock> block;
    for (std::size_t from = index; first < end;) {
      const std::span<ElementSource::Element> elements(block.data(), std::min(kBlock, end - first));
      part->source->copyElements(static_cast<std::uint32_t>(from), elements);
      from += elements.size();
      for (ElementSource::Element& element : elements) {
        for (NodeId& node : element.nodes) node = part->nodeOf(node);
        use(TetId(first++), element);
      }
    }
  }
}

template <class Use>
void MeshView::forEachRegion(Use use) const {
  for (std::size_t first = 0; first < elementCount();) {
    const auto [part, index, count] = runFrom(first);
    if (part != nullptr) {
      use(part->region, static_cast<std::uint32_t>(count));
    } else {
      for (std::size_t i = 0; i < count; ++i) use(kept_->regions[index + i], 1U);
    }
    first += count;
  }
}

inline std::uint32_t countNodes(const MeshView& mesh) { return mesh.nodeCount(); }
inline std::uint32_t countTetrahedra(const MeshView& mesh) { return mesh.elementCount(); }
inline Vec3 pointOf(const MeshView& mesh, NodeId node) { return mesh.pointOf(node); }
inline NodeQuad nodesOf(const MeshView& mesh, TetId tet) { return mesh.nodesOf(tet); }
inline std::array<Vec3, 4> cornersOf(const MeshView& mesh, TetId tet) {
  return mesh.cornersOf(tet);
}

/// Returns the positions of the nodes [first, last), x y z each. There may be fewer nodes.
[[nodiscard]] std::vector<double> pointsOf(const MeshView& mesh, std::size_t first,
                                           std::size_t last);
/// Returns the nodes of the elements [first, last), four each. There may be fewer elements.
[[nodiscard]] std::vector<std::uint32_t> elementsOf(const MeshView& mesh, std::size_t first,
                                                    std::size_t last);
/// Returns the regions of all elements in order, in runs: twice a region and its number of elements.
[[nodiscard]] std::vector<std::uint32_t> regionRunsOf(const MeshView& mesh);
/// Returns the mesh as arrays. O(n).
[[nodiscard]] VolumeMesh toVolumeMesh(const MeshView& mesh);
/// The same, without a copy if it has no parts.
[[nodiscard]] VolumeMesh toVolumeMesh(PartedMesh mesh);

}  // namespace tetrafront
