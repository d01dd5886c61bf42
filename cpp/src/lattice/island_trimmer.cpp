#include "lattice/island_trimmer.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

#include "base/sort.h"
#include "topology/disjoint_sets.h"
#include "topology/face_table.h"

namespace tetrafront {
namespace {

/// Elements per unit of budget.
constexpr std::size_t kTetrahedraPerUnit = 16;
/// Faces of one tetrahedron on the hull that make it stick out.
constexpr std::uint8_t kSpike = 2;

/// An edge of a face of the hull.
struct HullEdge {
  NodeId low;
  NodeId high;
  std::uint32_t face;
  std::uint8_t corner;  ///< where it begins in the face
};

}  // namespace

IslandTrimmer::IslandTrimmer(std::size_t nodeCount, std::vector<NodeQuad> tetrahedra)
    : nodeCount_(nodeCount),
      tetrahedra_(std::move(tetrahedra)),
      neighbours_(4 * tetrahedra_.size()),
      exposed_(tetrahedra_.size(), 4),
      isRemoved_(tetrahedra_.size(), 0) {}

Task<> IslandTrimmer::run(Work& work) {
  co_await findNeighbours(work);
  for (const TetId tet : IdRange<TetId>(tetrahedra_.size())) {
    if (exposed_[tet.index()] >= kSpike) spikes_.push_back(tet);
  }
  do {
    removeSpikes();
    co_await work.yield();
  } while (removeContacts());
  co_await removeSmallIslands(work);
}

Task<> IslandTrimmer::findNeighbours(Work& work) {
  work.beginPart(0.7);
  FaceTable<ElementFace> table = co_await listFaces<ElementFace>(
      work, nodeCount_, tetrahedra_.size(),
      [this](std::size_t tet, const auto& use) {
        for (std::size_t k = 0; k < 4; ++k) {
          const ElementFace face(TetId(tet), k);
          use(nodesOf(face), face);
        }
      },
      kTetrahedraPerUnit);
  work.beginPart(1.0);
  co_await work.forEachId<NodeId>(
      nodeCount_,
      [&](NodeId node) {
        table.forEachGroup(node, [&](std::span<const FaceTable<ElementFace>::Face> faces) {
          if (faces.size() != 2) return;
          for (std::size_t i = 0; i < 2; ++i) {
            const ElementFace face = faces[i].owner;
            neighbours_[face.index()] = faces[1 - i].owner;
            --exposed_[face.tet().index()];
          }
        });
      },
      kTetrahedraPerUnit);
}

NodeTriple IslandTrimmer::nodesOf(ElementFace face) const {
  const NodeQuad& nodes = tetrahedra_[face.tet().index()];
  const auto& corners = kFaceCorners[face.corner()];
  return {nodes[corners[0]], nodes[corners[1]], nodes[corners[2]]};
}

void IslandTrimmer::remove(TetId tet) {
  if (!isLive(tet)) return;
  isRemoved_[tet.index()] = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    ElementFace& other = neighbours_[ElementFace(tet, k).index()];
    if (other.isNone()) continue;
    neighbours_[other.index()] = {};
    if (++exposed_[other.tet().index()] >= kSpike) spikes_.push_back(other.tet());
    other = {};
  }
}

void IslandTrimmer::removeSpikes() {
  while (!spikes_.empty()) {
    const TetId tet = spikes_.back();
    spikes_.pop_back();
    remove(tet);
  }
}

std::vector<ElementFace> IslandTrimmer::hullFaces() const {
  std::vector<ElementFace> faces;
  for (const TetId tet : IdRange<TetId>(tetrahedra_.size())) {
    if (!isLive(tet) || exposed_[tet.index()] == 0) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const ElementFace face(tet, k);
      if (neighbours_[face.index()].isNone()) faces.push_back(face);
    }
  }
  return faces;
}

/// Removes the tetrahedra at edges of the hull with more than two of its faces, and at nodes where the hull has more than one fan of
/// faces. Returns whether there were any.
bool IslandTrimmer::removeContacts() {
  const std::vector<ElementFace> faces = hullFaces();
  std::vector<HullEdge> edges;
  edges.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const NodeTriple nodes = nodesOf(faces[f]);
    for (std::uint8_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(nodes[k], nodes[(k + 1) % 3]);
      edges.push_back({low, high, f, k});
    }
  }
  stableSort(edges, [](const HullEdge& a, const HullEdge& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });

  std::vector<std::uint8_t> isBad(faces.size(), 0);
  DisjointSets fans(3 * faces.size());  // of corners: three per face
  const auto cornerAt = [&](const HullEdge& edge, NodeId node) {
    const bool isFirst = nodesOf(faces[edge.face])[edge.corner] == node;
    return 3 * edge.face + (isFirst ? edge.corner : (edge.corner + 1U) % 3U);
  };
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].low == edges[first].low &&
           edges[last].high == edges[first].high) {
      ++last;
    }
    if (last - first == 2) {
      for (const NodeId node : {edges[first].low, edges[first].high}) {
        fans.join(cornerAt(edges[first], node), cornerAt(edges[first + 1], node));
      }
    } else {
      for (std::size_t i = first; i < last; ++i) isBad[edges[i].face] = 1;
    }
    first = last;
  }

  constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> fanOf(nodeCount_, kNone);
  std::vector<std::uint8_t> isContact(nodeCount_, 0);
  for (std::uint32_t corner = 0; corner < 3 * faces.size(); ++corner) {
    const NodeId node = nodesOf(faces[corner / 3])[corner % 3];
    const std::uint32_t fan = fans.find(corner);
    std::uint32_t& known = fanOf[node.index()];
    if (known == kNone) known = fan;
    if (known != fan) isContact[node.index()] = 1;
  }
  bool isAny = false;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const NodeTriple nodes = nodesOf(faces[f]);
    const bool touches =
        std::ranges::any_of(nodes, [&](NodeId node) { return isContact[node.index()] != 0; });
    if (isBad[f] == 0 && !touches) continue;
    remove(faces[f].tet());
    isAny = true;
  }
  return isAny;
}

Task<> IslandTrimmer::removeSmallIslands(Work& work) {
  const std::size_t count = tetrahedra_.size();
  DisjointSets islands(count);
  co_await work.forEachId<TetId>(
      count,
      [&](TetId tet) {
        for (std::size_t k = 0; k < 4; ++k) {
          const ElementFace other = neighbours_[ElementFace(tet, k).index()];
          if (!other.isNone()) islands.join(tet.value, other.tet().value);
        }
      },
      kTetrahedraPerUnit);
  std::vector<std::uint32_t> sizes(count, 0);
  co_await work.forEachId<TetId>(
      count,
      [&](TetId tet) {
        if (isLive(tet)) ++sizes[islands.find(tet.value)];
      },
      kTetrahedraPerUnit);
  co_await work.forEachId<TetId>(
      count,
      [&](TetId tet) {
        if (sizes[islands.find(tet.value)] < kMinTetrahedra) isRemoved_[tet.index()] = 1;
      },
      kTetrahedraPerUnit);
}

std::vector<NodeTriple> IslandTrimmer::hull() const {
  std::vector<NodeTriple> hull;
  for (const ElementFace face : hullFaces()) {
    const auto [a, b, c] = nodesOf(face);
    hull.push_back({a, c, b});
  }
  return hull;
}

std::vector<NodeQuad> IslandTrimmer::take() {
  std::size_t kept = 0;
  for (const TetId tet : IdRange<TetId>(tetrahedra_.size())) {
    if (isLive(tet)) tetrahedra_[kept++] = tetrahedra_[tet.index()];
  }
  tetrahedra_.resize(kept);
  return std::move(tetrahedra_);
}

}  // namespace tetrafront
