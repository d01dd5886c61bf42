#include "repair/surface_closing.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "boundary/self_intersection.h"
#include "boundary/shell_nesting.h"
#include "geom/measure.h"
#include "repair/open_rims.h"
#include "repair/rim_triangulation.h"
#include "search/box_tree.h"
#include "topology/disjoint_sets.h"
#include "topology/edge_table.h"
#include "topology/half_faces.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Largest area of the new triangles / area of the component.
constexpr double kMaxShareOfHoles = 0.8;
/// A longer rim is joined to its centroid.
constexpr std::size_t kMaxRimWithoutNode = 400;

/// Triangles over a hole.
struct HoleCover {
  std::vector<std::uint32_t> triangles;
  double area = 0.0;
  std::uint32_t component = 0;
};

/// The edges at which the triangles of one orientation outnumber the others, in their direction, joined to closed chains.
class OpenChains {
 public:
  OpenChains(const SurfaceMesh& mesh, const EdgeTable& edges) : isOnStack_(countNodes(mesh), 0) {
    for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
      const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
      int excess = 0;
      for (const HalfEdgeId h : halfEdges) {
        const HalfEdgeNodes nodes = nodesOf(mesh.triangles, h);
        excess += nodes.from < nodes.to ? 1 : -1;
      }
      const HalfEdgeNodes nodes = nodesOf(mesh.triangles, halfEdges[0]);
      NodeId from = std::min(nodes.from, nodes.to);
      NodeId to = std::max(nodes.from, nodes.to);
      if (excess < 0) std::swap(from, to);
      const bool isOpen = halfEdges.size() == 1;
      for (int i = 0; i < std::abs(excess); ++i)
        links_.push_back({from, to, isOpen, triangleOf(halfEdges[0])});
    }
    std::ranges::stable_sort(links_, {}, &Link::from);
    isUsed_.assign(links_.size(), 0);
  }

  struct Chain {
    Rim rim;
    std::vector<TriangleId> beside;  ///< a triangle at each edge
  };
  /// Returns the chains that contain an edge with one triangle only. Each visits a node once.
  [[nodiscard]] std::vector<Chain> chains() {
    std::vector<Chain> found;
    std::vector<std::size_t> walk;
    for (std::size_t start = 0; start < links_.size(); ++start) {
      for (std::size_t link = start; isUsed_[link] == 0;) {
        isUsed_[link] = 1;
        isOnStack_[links_[link].from.index()] = 1;
        walk.push_back(link);
        const NodeId to = links_[link].to;
        if (isOnStack_[to.index()] != 0) cutOff(walk, to, found);
        const auto next = std::ranges::equal_range(links_, to, {}, &Link::from);
        for (auto it = next.begin(); it != next.end(); ++it) {
          link = static_cast<std::size_t>(it - links_.begin());
          if (isUsed_[link] == 0) break;
        }
      }
      for (const std::size_t link : walk) isOnStack_[links_[link].from.index()] = 0;
      walk.clear();
    }
    return found;
  }

 private:
  struct Link {
    NodeId from;
    NodeId to;
    bool isOpen;
    TriangleId beside;
  };

  /// Moves the closed end of a walk to the chains.
  void cutOff(std::vector<std::size_t>& walk, NodeId at, std::vector<Chain>& found) {
    Chain chain;
    bool isOpen = false;
    NodeId from;
    while (from != at) {
      const Link& link = links_[walk.back()];
      from = link.from;
      isOnStack_[from.index()] = 0;
      isOpen = isOpen || link.isOpen;
      chain.beside.push_back(link.beside);
      chain.rim.push_back(from);
      walk.pop_back();
    }
    std::ranges::reverse(chain.rim);
    if (isOpen && chain.rim.size() > 2) found.push_back(std::move(chain));
  }

  std::vector<Link> links_;
  std::vector<std::uint8_t> isUsed_;
  std::vector<std::uint8_t> isOnStack_;
};

/// Keeps the edges of the mesh up to date.
void orientPatches(SurfaceMesh& mesh, EdgeTable& edges) {
  const std::uint32_t count = countTriangles(mesh);
  OpposedSets sets(count);
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    if (halfEdges.size() != 2) continue;
    const bool areOpposite =
        nodesOf(mesh.triangles, halfEdges[0]).from == nodesOf(mesh.triangles, halfEdges[1]).from;
    // A one-sided patch keeps an edge at which its triangles disagree.
    static_cast<void>(
        sets.join(triangleOf(halfEdges[0]).value, triangleOf(halfEdges[1]).value, areOpposite));
  }
  std::vector<double> excess(count, 0.0);  ///< per root: area like it - area opposite to it
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto [root, isOpposite] = sets.find(t);
    const double area = areaOf(cornersOf(mesh, TriangleId(t)));
    excess[root] += isOpposite != 0 ? -area : area;
  }
  std::vector<std::uint8_t> isFlipped(count, 0);
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto [root, isOpposite] = sets.find(t);
    if ((isOpposite != 0) == (excess[root] < 0.0)) continue;
    isFlipped[t] = 1;
    flipTriangle(mesh, TriangleId(t));
  }
  edges.followFlips(isFlipped);
}

HoleCover coverOf(SurfaceMesh& mesh, const Rim& rim) {
  HoleCover cover;
  const auto add = [&](NodeId a, NodeId b, NodeId c) {
    cover.triangles.insert(cover.triangles.end(), {a.value, b.value, c.value});
    cover.area += areaOf({pointOf(mesh, a), pointOf(mesh, b), pointOf(mesh, c)});
  };
  if (rim.size() > kMaxRimWithoutNode) {
    Vec3 centre(0.0);
    for (const NodeId node : rim) centre += pointOf(mesh, node) / static_cast<double>(rim.size());
    const NodeId apex(countNodes(mesh));
    mesh.points.insert(mesh.points.end(), {centre.x, centre.y, centre.z});
    for (std::size_t i = 0; i < rim.size(); ++i) add(rim[(i + 1) % rim.size()], rim[i], apex);
    return cover;
  }
  RimTriangulation triangulation(mesh, rim);
  const auto edgeExists = [](NodeId, NodeId) { return false; };
  for (const RimTriangulation::Corners& corners : triangulation.solve(edgeExists)) {
    add(rim[corners.last], rim[corners.apex], rim[corners.first]);
  }
  if (!cover.triangles.empty()) return cover;
  // Too many corners are on one line. Degenerate triangles enclose nothing.
  for (std::size_t i = 1; i + 1 < rim.size(); ++i) add(rim[i + 1], rim[i], rim[0]);
  return cover;
}

std::vector<FilledHole> coverHoles(SurfaceMesh& mesh, const EdgeTable& edges) {
  const std::vector<ComponentId> componentOf = connectedComponents(mesh, edges);
  std::vector<double> area(componentOf.size(), 0.0);
  for (std::uint32_t t = 0; t < componentOf.size(); ++t) {
    area[componentOf[t].index()] += areaOf(cornersOf(mesh, TriangleId(t)));
  }
  // Components that share a hole are one.
  DisjointSets joined(area.size());
  std::vector<HoleCover> covers;
  for (const OpenChains::Chain& chain : OpenChains(mesh, edges).chains()) {
    covers.push_back(coverOf(mesh, chain.rim));
    covers.back().component = componentOf[chain.beside[0].index()].value;
    for (const TriangleId triangle : chain.beside) {
      joined.join(covers.back().component, componentOf[triangle.index()].value);
    }
  }
  std::vector<double> shared(area.size(), 0.0);
  std::vector<double> covered(area.size(), 0.0);
  for (std::uint32_t c = 0; c < area.size(); ++c) shared[joined.find(c)] += area[c];
  for (HoleCover& cover : covers) {
    cover.component = joined.find(cover.component);
    covered[cover.component] += cover.area;
  }
  std::vector<FilledHole> holes;
  for (const HoleCover& cover : covers) {
    if (covered[cover.component] > kMaxShareOfHoles * shared[cover.component]) continue;
    holes.push_back(
        {TriangleId(countTriangles(mesh)), static_cast<std::uint32_t>(cover.triangles.size() / 3)});
    mesh.triangles.insert(mesh.triangles.end(), cover.triangles.begin(), cover.triangles.end());
  }
  return holes;
}

/// Flips components of negative volume, unless they are inside another one and its box.
void orientComponents(SurfaceMesh& mesh, const EdgeTable& edges) {
  const std::vector<ComponentId> componentOf = connectedComponents(mesh, edges);
  const std::size_t count = std::ranges::max_element(componentOf)->index() + 1;
  std::vector<double> volume(count, 0.0);
  std::vector<Bounds> bounds(count);
  std::vector<Vec3> origin(count);
  std::vector<std::uint8_t> hasOrigin(count, 0);
  for (std::uint32_t t = 0; t < componentOf.size(); ++t) {
    const std::size_t c = componentOf[t].index();
    const std::array<Vec3, 3> p = cornersOf(mesh, TriangleId(t));
    if (hasOrigin[c] == 0) {
      origin[c] = p[0];
      bounds[c] = {p[0], p[0]};
      hasOrigin[c] = 1;
    }
    volume[c] += sixVolumesByEdges(origin[c], p[0], p[1], p[2]);
    for (const Vec3& corner : p) {
      bounds[c].low = glm::min(bounds[c].low, corner);
      bounds[c].high = glm::max(bounds[c].high, corner);
    }
  }
  if (std::ranges::none_of(volume, [](double v) { return v < 0.0; })) return;
  const auto isInBox = [&](std::size_t c) {
    for (std::size_t other = 0; other < count; ++other) {
      if (volume[other] > 0.0 && bounds[other].low == glm::min(bounds[other].low, bounds[c].low) &&
          bounds[other].high == glm::max(bounds[other].high, bounds[c].high)) {
        return true;
      }
    }
    return false;
  };
  const BoxTree tree(triangleBoxes(mesh));
  const ShellNesting nesting(mesh, componentOf, count, {}, tree);
  std::vector<std::uint8_t> isFlipped(count, 0);
  for (std::size_t c = 0; c < count; ++c) {
    if (volume[c] >= 0.0) continue;
    const bool isCavity = isInBox(c) && nesting.windingAround(ComponentId(c)) > 0;
    isFlipped[c] = isCavity ? 0 : 1;
  }
  for (std::uint32_t t = 0; t < componentOf.size(); ++t) {
    if (isFlipped[componentOf[t].index()] != 0) flipTriangle(mesh, TriangleId(t));
  }
}

}  // namespace

std::vector<FilledHole> closeSurface(SurfaceMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  EdgeTable edges(mesh.triangles, countNodes(mesh), {});
  orientPatches(mesh, edges);
  std::vector<FilledHole> holes = coverHoles(mesh, edges);
  if (!holes.empty()) edges = EdgeTable(mesh.triangles, countNodes(mesh), {});
  orientComponents(mesh, edges);
  return holes;
}

}  // namespace tetrafront
