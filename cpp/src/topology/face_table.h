#pragma once

/// @file Matches faces: those of elements, or triangles, with the same nodes in any order form a group.
///
/// The verifier (quality/verify_mesh.h) does not use this: it must not share a mistake with what it verifies.

#include <array>
#include <cstddef>
#include <span>
#include <tuple>

#include "base/ids.h"
#include "base/sort.h"
#include "base/task.h"
#include "topology/node_lists.h"

namespace tetrafront {

/// `Owner`: identifies a face, and orders the faces of a group; `Node`: type of the nodes' ids.
template <class Owner, class Node = NodeId>
class FaceTable {
 public:
  using Nodes = std::array<Node, 3>;
  /// A face in the list of its lowest node.
  struct Face {
    Node middle;
    Node highest;
    Owner owner;
  };

  explicit FaceTable(std::size_t nodeCount) : lists_(nodeCount) {}

  /// First pass: once per face.
  void count(const Nodes& nodes) { lists_.count(sorted(nodes)[0]); }
  void endCounting() { lists_.endCounting(); }
  /// Second pass: the same faces again.
  void add(const Nodes& nodes, const Owner& owner) {
    const auto [lowest, middle, highest] = sorted(nodes);
    lists_.add(lowest, {middle, highest, owner});
  }

  /// Calls visit(faces) for each group of faces with the lowest node `node`, in the order of their nodes. The faces of a group
  /// ascend by their owners. O(k log k) for k faces.
  template <class Visit>
  void forEachGroup(Node node, Visit visit) {
    const std::span<Face> faces = lists_.at(node);
    sortFew(faces, [](const Face& a, const Face& b) {
      return std::tie(a.middle, a.highest, a.owner) < std::tie(b.middle, b.highest, b.owner);
    });
    for (std::size_t first = 0; first < faces.size();) {
      const Face& face = faces[first];
      std::size_t last = first + 1;
      while (last < faces.size() && faces[last].middle == face.middle &&
             faces[last].highest == face.highest) {
        ++last;
      }
      visit(std::span<const Face>(faces.subspan(first, last - first)));
      first = last;
    }
  }

 private:
  NodeLists<Face, Node> lists_;
};

/// Lists the faces of `itemCount` items. `forEachFace(item, use)` calls use(nodes, owner) for each face of the item with this number.
/// `itemsPerUnit`: items visited per unit of budget. O(n).
template <class Owner, class Node = NodeId, class ForEachFace>
Task<FaceTable<Owner, Node>> listFaces(Work& work, std::size_t nodeCount, std::size_t itemCount,
                                       ForEachFace forEachFace, std::size_t itemsPerUnit = 1) {
  using Nodes = typename FaceTable<Owner, Node>::Nodes;
  FaceTable<Owner, Node> table(nodeCount);
  work.beginPart(0.4);
  co_await work.forEachBlock(
      itemCount,
      [&](std::size_t first, std::size_t last) {
        const auto count = [&](const Nodes& nodes, const Owner& /*owner*/) { table.count(nodes); };
        for (std::size_t i = first; i < last; ++i) forEachFace(i, count);
      },
      itemsPerUnit);
  table.endCounting();
  work.beginPart(1.0);
  co_await work.forEachBlock(
      itemCount,
      [&](std::size_t first, std::size_t last) {
        const auto add = [&](const Nodes& nodes, const Owner& owner) { table.add(nodes, owner); };
        for (std::size_t i = first; i < last; ++i) forEachFace(i, add);
      },
      itemsPerUnit);
  co_return table;
}

}  // namespace tetrafront
