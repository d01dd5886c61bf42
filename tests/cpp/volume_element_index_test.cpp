#include "volume/element_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>

#include "support/random.h"

namespace tetrafront {
namespace {

constexpr int kNodes = 60;

void addRandomElements(Elements& elements, testing::Random& random, int count) {
  for (int i = 0; i < count; ++i) {
    std::set<int> nodes;
    while (nodes.size() < 4) nodes.insert(random.integer(0, kNodes - 1));
    NodeQuad quad;
    std::transform(nodes.begin(), nodes.end(), quad.begin(),
                   [](int n) { return NodeId(static_cast<std::uint32_t>(n)); });
    elements.add(quad, 0);
  }
}

/// Visits all elements.
std::vector<TetId> aroundSlowly(const Elements& elements, std::set<NodeId> nodes,
                                std::uint32_t rings) {
  std::set<TetId> found;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    std::set<NodeId> reached = nodes;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const NodeQuad& quad = elements.nodes[e];
      const bool touches =
          std::any_of(quad.begin(), quad.end(), [&](NodeId node) { return nodes.contains(node); });
      if (!touches || elements.removed[e] != 0) continue;
      found.insert(TetId(e));
      reached.insert(quad.begin(), quad.end());
    }
    nodes = reached;
  }
  return {found.begin(), found.end()};
}

TEST(ElementIndex, FindsRingsWhileElementsAreAddedAndRemoved) {
  testing::Random random(5);
  Elements elements;
  addRandomElements(elements, random, 12);
  ElementIndex index(elements);
  const auto expectRings = [&](const char* when) {
    for (std::uint32_t rings = 1; rings <= 3; ++rings) {
      const NodeId node(static_cast<std::uint32_t>(random.integer(0, kNodes - 1)));
      EXPECT_EQ(index.around({node}, rings, elements.size()), aroundSlowly(elements, {node}, rings))
          << when << ", " << rings << " rings around node " << node.value;
    }
  };
  expectRings("never built");
  index.begin(kNodes);
  while (!index.isBuilt()) index.build(1);
  expectRings("built");
  addRandomElements(elements, random, 10);
  expectRings("with later elements");
  const std::size_t before = elements.size();
  addRandomElements(elements, random, 10);
  elements.dropFrom(before);
  addRandomElements(elements, random, 8);
  expectRings("with others in position of elements dropped before a query");
  elements.remove(TetId(3U));
  elements.remove(TetId(before + 1));
  expectRings("with elements removed");
}

}  // namespace
}  // namespace tetrafront
