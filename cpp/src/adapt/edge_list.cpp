#include "adapt/edge_list.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "base/sort.h"

namespace tetrafront {
namespace {

/// Elements that are only read, per unit.
constexpr std::size_t kElementsPerUnit = 4;

struct EdgeItem {
  NodeId high;
  TetId element;
};

/// Calls visit(low, high) for the edges of an element.
template <class Visit>
void forEachEdge(const AdaptElement& element, Visit visit) {
  if (!element.isAlive()) return;
  for (const TetEdge& e : kTetEdges) {
    const NodeId a = element.nodes[e.from];
    const NodeId b = element.nodes[e.to];
    visit(std::min(a, b), std::max(a, b));
  }
}

}  // namespace

Task<std::vector<AdaptEdge>> listEdges(Work& work, const AdaptMesh& mesh) {
  std::vector<std::uint32_t> begins(mesh.nodes.size() + 1, 0);
  work.beginPart(0.2);
  co_await work.forEachId<TetId>(
      mesh.elements.size(),
      [&](TetId id) {
        forEachEdge(mesh.element(id),
                    [&](NodeId low, NodeId /*high*/) { ++begins[low.index() + 1]; });
      },
      kElementsPerUnit);
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  std::vector<EdgeItem> items(begins.back());
  std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
  work.beginPart(0.5);
  co_await work.forEachId<TetId>(
      mesh.elements.size(),
      [&](TetId id) {
        forEachEdge(mesh.element(id),
                    [&](NodeId low, NodeId high) { items[next[low.index()]++] = {high, id}; });
      },
      kElementsPerUnit);
  std::vector<AdaptEdge> edges;
  edges.reserve(items.size() / 4);
  work.beginPart(1.0);
  co_await work.forEachId<NodeId>(mesh.nodes.size(), [&](NodeId low) {
    const std::span<EdgeItem> own(items.data() + begins[low.index()],
                                  items.data() + begins[low.index() + 1]);
    sortFew(own, [](const EdgeItem& a, const EdgeItem& b) { return a.high < b.high; });
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (i > 0 && own[i].high == own[i - 1].high) continue;
      edges.push_back({mesh.lengthOf(low, own[i].high), low, own[i].high, own[i].element});
    }
  });
  co_return edges;
}

}  // namespace tetrafront
