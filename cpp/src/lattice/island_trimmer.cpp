#include "lattice/island_trimmer.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "base/free_memory.h"
#include "base/sort.h"
#include "topology/disjoint_sets.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

/// Nodes per unit of budget.
constexpr std::size_t kNodesPerUnit = 8;
/// Faces of one tetrahedron on the hull that make it stick out.
constexpr int kSpike = 2;

/// An edge of a face of the hull.
struct HullEdge {
  NodeId low;
  NodeId high;
  std::uint32_t face;
  std::uint8_t corner;  ///< where it begins in the face
};

/// Calls visit(offset) for a centre and the 26 around it.
template <class Visit>
void forEachAround(Visit visit) {
  for (std::int8_t z = -2; z <= 2; z += 2) {
    for (std::int8_t y = -2; y <= 2; y += 2) {
      for (std::int8_t x = -2; x <= 2; x += 2) visit(LatticeOffset{x, y, z});
    }
  }
}

LatticeOffset sum(const LatticeOffset& a, const LatticeOffset& b) {
  LatticeOffset result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result[axis] = static_cast<std::int8_t>(a[axis] + b[axis]);
  }
  return result;
}

}  // namespace

IslandTrimmer::IslandTrimmer(const LatticeNodes& nodes)
    : nodes_(nodes), bits_(nodes.count(), ElementBits{0}) {}

/// Finds per tetrahedron and face the other tetrahedron with its three nodes.
IslandTrimmer::Neighbours IslandTrimmer::findNeighbours() {
  Neighbours neighbours{};
  const auto find = [](std::size_t element, std::size_t corner) {
    Neighbour found;
    forEachAround([&](const LatticeOffset& offset) {
      for (std::uint8_t other = 0; other < kElementsPerCentre; ++other) {
        if (offset == LatticeOffset{} && other == element) continue;
        const auto has = [&](const LatticeOffset& node) {
          return std::ranges::any_of(kElementNodes[other], [&](const LatticeOffset& own) {
            return sum(offset, own) == node;
          });
        };
        const auto& nodes = kElementNodes[element];
        if (std::ranges::all_of(kFaceCorners[corner], [&](auto k) { return has(nodes[k]); })) {
          found = {offset, other};
        }
      }
    });
    return found;
  };
  for (std::size_t element = 0; element < kElementsPerCentre; ++element) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      neighbours[element][corner] = find(element, corner);
    }
  }
  return neighbours;
}

Task<> IslandTrimmer::run(Work& work) {
  work.beginPart(0.4);
  co_await work.forEachBlock(
      nodes_.count(),
      [this](std::size_t first, std::size_t last) {
        forEachCentre(nodes_, first, last, [this](const CentreNodes& around) {
          bits_[around.centre.index()] = around.complete();
        });
      },
      kNodesPerUnit);
  work.beginPart(0.8);
  co_await work.forEachBlock(
      nodes_.count(), [this](std::size_t first, std::size_t last) { markNearHull(first, last); },
      kNodesPerUnit);
  work.beginPart(0.9);
  co_await work.forEachBlock(
      nodes_.count(),
      [this](std::size_t first, std::size_t last) {
        forEachNearHull(first, last, [this](const Element& element) {
          if (isSpike(element)) spikes_.push_back(element);
        });
      },
      kNodesPerUnit);
  do {
    removeSpikes();
    co_await work.yield();
  } while (removeContacts());
  work.beginPart(1.0);
  co_await removeSmallIslands(work);
}

/// Marks those of the nodes [first, last) that are centres near the hull.
void IslandTrimmer::markNearHull(std::size_t first, std::size_t last) {
  while (first < last) {
    const LatticePlace start = nodes_.placeOf(NodeId(first));
    const std::size_t end = std::min(last, nodes_.firstFrom({0, start.y + 1, start.z}));
    if (start.y % 2 == 0) {
      first = end;
      continue;
    }
    // Without a row below, all its centres are at the hull.
    const bool isLowest = start.y < 2 || start.z < 2;
    std::vector<LatticeNodes::Row> rows;
    for (int i = 0; i < 9 && !isLowest; ++i) {
      const auto by = [](int k) { return static_cast<std::uint32_t>(2 * k); };
      rows.push_back(nodes_.rowAt(start.y - 2 + by(i % 3), start.z - 2 + by(i / 3)));
    }
    for (; first < end; ++first) {
      const std::uint32_t x = nodes_.placeOf(NodeId(first)).x;
      const auto isFull = [&](NodeId centre) {
        return !centre.isNone() && (bits_[centre.index()] & kAllElements) == kAllElements;
      };
      // Rows see every centre, so that their queries ascend.
      bool isDeep = !isLowest && x >= 2;
      for (LatticeNodes::Row& row : rows) {
        for (const std::uint32_t from : {x - 2, x, x + 2}) {
          isDeep = isDeep && isFull(row.at(from));
        }
      }
      if (!isDeep) bits_[first] |= kNearHull;
    }
  }
}

NodeId IslandTrimmer::nodeAt(NodeId centre, const LatticeOffset& offset) const {
  return nodes_.find(placeAt(nodes_.placeOf(centre), offset));
}

/// Returns the tetrahedron behind the face opposite a corner; it may not be live, and its centre may be none.
IslandTrimmer::Element IslandTrimmer::neighbourOf(const Element& element,
                                                  std::size_t corner) const {
  const Neighbour& other = neighbours_[element.number][corner];
  if (other.offset == LatticeOffset{}) return {element.centre, other.number};
  return {nodeAt(element.centre, other.offset), other.number};
}

bool IslandTrimmer::isSpike(const Element& element) const {
  int exposed = 0;
  for (std::size_t k = 0; k < 4; ++k) exposed += isLive(neighbourOf(element, k)) ? 0 : 1;
  return exposed >= kSpike;
}

void IslandTrimmer::remove(const Element& element) {
  if (!isLive(element)) return;
  bits_[element.centre.index()] &= static_cast<ElementBits>(~(1U << element.number));
  forEachAround([&](const LatticeOffset& offset) {
    const NodeId centre = nodeAt(element.centre, offset);
    if (!centre.isNone()) bits_[centre.index()] |= kNearHull;
  });
  for (std::size_t k = 0; k < 4; ++k) {
    const Element other = neighbourOf(element, k);
    if (isLive(other)) spikes_.push_back(other);
  }
}

void IslandTrimmer::removeSpikes() {
  while (!spikes_.empty()) {
    const Element element = spikes_.back();
    spikes_.pop_back();
    if (isLive(element) && isSpike(element)) remove(element);
  }
}

template <class Visit>
void IslandTrimmer::forEachNearHull(std::size_t first, std::size_t last, Visit visit) const {
  for (std::size_t node = first; node < last; ++node) {
    const NodeId centre(node);
    if (!isNearHull(centre)) continue;
    for (std::uint8_t number = 0; number < kElementsPerCentre; ++number) {
      if (const Element element{centre, number}; isLive(element)) visit(element);
    }
  }
}

std::vector<IslandTrimmer::HullFace> IslandTrimmer::hullFaces() const {
  std::vector<HullFace> faces;
  forEachNearHull(0, bits_.size(), [&](const Element& element) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (isLive(neighbourOf(element, k))) continue;
      HullFace face{element, {}};
      for (std::size_t i = 0; i < 3; ++i) {
        face.nodes[i] = nodeAt(element.centre, kElementNodes[element.number][kFaceCorners[k][i]]);
      }
      faces.push_back(face);
    }
  });
  return faces;
}

/// Removes the tetrahedra at edges of the hull with more than two of its faces, and at nodes where the hull has more than one fan of
/// faces. Returns whether there were any.
bool IslandTrimmer::removeContacts() {
  const std::vector<HullFace> faces = hullFaces();
  std::vector<HullEdge> edges;
  edges.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const NodeTriple& nodes = faces[f].nodes;
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
    const bool isFirst = faces[edge.face].nodes[edge.corner] == node;
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

  std::vector<std::uint32_t> fanOf(nodes_.count(), kNoIndex);
  std::vector<std::uint8_t> isContact(nodes_.count(), 0);
  for (std::uint32_t corner = 0; corner < 3 * faces.size(); ++corner) {
    const NodeId node = faces[corner / 3].nodes[corner % 3];
    const std::uint32_t fan = fans.find(corner);
    std::uint32_t& known = fanOf[node.index()];
    if (known == kNoIndex) known = fan;
    if (known != fan) isContact[node.index()] = 1;
  }
  bool isAny = false;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const bool touches = std::ranges::any_of(
        faces[f].nodes, [&](NodeId node) { return isContact[node.index()] != 0; });
    if (isBad[f] == 0 && !touches) continue;
    remove(faces[f].element);
    isAny = true;
  }
  return isAny;
}

/// Small islands have no tetrahedron deep inside.
Task<> IslandTrimmer::removeSmallIslands(Work& work) {
  isInLarge_.assign(bits_.size(), ElementBits{0});
  std::vector<Element> small;
  co_await work.forEachBlock(
      bits_.size(),
      [&](std::size_t first, std::size_t last) {
        forEachNearHull(first, last, [&](const Element& element) {
          const std::vector<Element> island = smallIslandOf(element);
          small.insert(small.end(), island.begin(), island.end());
        });
      },
      kNodesPerUnit);
  for (const Element& element : small) {
    bits_[element.centre.index()] &= static_cast<ElementBits>(~(1U << element.number));
  }
  freeMemory(isInLarge_);
}

/// Returns the whole island of a tetrahedron if it is small, else nothing. Visits the tetrahedra around this one until there are
/// enough, or one deep inside: around its centre are more than enough. All visited ones are then known to be in a large island.
std::vector<IslandTrimmer::Element> IslandTrimmer::smallIslandOf(const Element& element) {
  std::vector<Element> island;
  const auto isLarge = [&](const Element& other) {
    return !isNearHull(other.centre) || isIn(isInLarge_, other) ||
           island.size() + 1 >= kMinTetrahedra;
  };
  if (isLarge(element)) return {};
  island.push_back(element);
  for (std::size_t next = 0; next < island.size(); ++next) {
    const Element from = island[next];
    for (std::size_t k = 0; k < 4; ++k) {
      const Element other = neighbourOf(from, k);
      if (!isLive(other) || std::ranges::find(island, other) != island.end()) continue;
      if (isLarge(other)) {
        for (const Element& known : island) {
          isInLarge_[known.centre.index()] |= static_cast<ElementBits>(1U << known.number);
        }
        return {};
      }
      island.push_back(other);
    }
  }
  return island;
}

std::vector<NodeTriple> IslandTrimmer::hull() const {
  std::vector<NodeTriple> hull;
  for (const HullFace& face : hullFaces()) {
    const auto [a, b, c] = face.nodes;
    hull.push_back({a, c, b});
  }
  return hull;
}

std::vector<ElementBits> IslandTrimmer::take() {
  for (ElementBits& bits : bits_) bits &= kAllElements;
  return std::move(bits_);
}

}  // namespace tetrafront
