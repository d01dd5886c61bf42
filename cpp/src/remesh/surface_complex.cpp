#include "remesh/surface_complex.h"

#include <algorithm>
#include <utility>

#include "topology/mesh_access.h"

namespace tetrafront {

SurfaceComplex::SurfaceComplex(const ReferenceSurface& reference) {
  const SurfaceMesh& mesh = reference.mesh();
  for (const NodeId node : IdRange<NodeId>(countNodes(mesh))) {
    addNode(tetrafront::pointOf(mesh, node),
            reference.isCorner(node) ? NodeKind::kCorner : NodeKind::kSmooth);
  }
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    addTriangle(tetrafront::nodesOf(mesh, t), reference.patchOf(t));
  }
  for (std::size_t l = 0; l < reference.lines().size(); ++l) {
    const FeatureLine& line = reference.lines()[l];
    for (std::size_t i = 0; i + 1 < line.nodes().size(); ++i) {
      const NodeId from = line.nodes()[i];
      const NodeId to = line.nodes()[i + 1];
      setStretchBetween(from, to,
                        addStretch({FeatureLineId(l), line.arcs()[i], line.arcs()[i + 1], from}));
      for (const NodeId node : {from, to}) {
        if (kindOf(node) == NodeKind::kSmooth) kinds_[node.index()] = NodeKind::kLine;
      }
    }
  }
}

NodeId SurfaceComplex::addNode(const Vec3& point, NodeKind kind) {
  points_.push_back(point);
  kinds_.push_back(kind);
  firstCorner_.emplace_back();
  cornerCount_.push_back(0);
  return NodeId(points_.size() - 1);
}

void SurfaceComplex::removeLastNode() {
  points_.pop_back();
  kinds_.pop_back();
  firstCorner_.pop_back();
  cornerCount_.pop_back();
}

TriangleId SurfaceComplex::addTriangle(const NodeTriple& nodes, SmoothPatchId patch) {
  TriangleId t(patches_.size());
  if (free_.empty()) {
    triangles_.push_back(nodes);
    patches_.push_back(patch);
    nextCorner_.resize(nextCorner_.size() + 3);
    stretchOf_.resize(stretchOf_.size() + 3);
  } else {
    t = free_.back();
    free_.pop_back();
    triangles_[t.index()] = nodes;
    patches_[t.index()] = patch;
  }
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfEdgeId corner = halfEdgeOf(t, k);
    HalfEdgeId& first = firstCorner_[nodes[k].index()];
    nextCorner_[corner.index()] = first;
    first = corner;
    ++cornerCount_[nodes[k].index()];
    stretchOf_[corner.index()] = StretchId{};
  }
  return t;
}

void SurfaceComplex::removeTriangle(TriangleId triangle) {
  const NodeTriple& nodes = nodesOf(triangle);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfEdgeId corner = halfEdgeOf(triangle, k);
    HalfEdgeId* link = &firstCorner_[nodes[k].index()];
    while (*link != corner) link = &nextCorner_[link->index()];
    *link = nextCorner_[corner.index()];
    --cornerCount_[nodes[k].index()];
  }
  patches_[triangle.index()] = SmoothPatchId{};
  free_.push_back(triangle);
}

void SurfaceComplex::collectStar(NodeId node, std::vector<TriangleId>& star) const {
  star.clear();
  visitStar(node, [&](TriangleId t, std::uint32_t /*k*/) { star.push_back(t); });
}

void SurfaceComplex::collectRing(NodeId node, std::vector<NodeId>& ring) const {
  ring.clear();
  const auto add = [&](NodeId other) {
    if (std::ranges::find(ring, other) == ring.end()) ring.push_back(other);
  };
  visitStar(node, [&](TriangleId t, std::uint32_t k) {
    add(nodesOf(t)[(k + 1) % 3]);
    add(nodesOf(t)[(k + 2) % 3]);
  });
}

void SurfaceComplex::preferFewCorners(NodeId& a, NodeId& b) const {
  if (cornerCount_[b.index()] < cornerCount_[a.index()]) std::swap(a, b);
}

void SurfaceComplex::collectEdge(NodeId a, NodeId b, std::vector<HalfEdgeId>& edges) const {
  edges.clear();
  preferFewCorners(a, b);
  visitStar(a, [&](TriangleId t, std::uint32_t k) {
    const NodeTriple& nodes = nodesOf(t);
    if (nodes[(k + 1) % 3] == b) edges.push_back(halfEdgeOf(t, k));
    if (nodes[(k + 2) % 3] == b) edges.push_back(halfEdgeOf(t, (k + 2) % 3));
  });
}

HalfEdgeId SurfaceComplex::halfEdgeBetween(NodeId a, NodeId b) const {
  preferFewCorners(a, b);
  for (HalfEdgeId at = firstCorner_[a.index()]; !at.isNone(); at = nextCorner_[at.index()]) {
    const TriangleId t = triangleOf(at);
    const std::uint32_t k = at.value % 3;
    if (nodesOf(t)[(k + 1) % 3] == b) return at;
    if (nodesOf(t)[(k + 2) % 3] == b) return halfEdgeOf(t, (k + 2) % 3);
  }
  return {};
}

StretchId SurfaceComplex::stretchBetween(NodeId a, NodeId b) const {
  if (kindOf(a) == NodeKind::kSmooth || kindOf(b) == NodeKind::kSmooth) return {};
  const HalfEdgeId halfEdge = halfEdgeBetween(a, b);
  return halfEdge.isNone() ? StretchId{} : stretchOf(halfEdge);
}

StretchId SurfaceComplex::addStretch(const Stretch& stretch) {
  if (freeStretches_.empty()) {
    stretches_.push_back(stretch);
    return StretchId(stretches_.size() - 1);
  }
  const StretchId id = freeStretches_.back();
  freeStretches_.pop_back();
  stretches_[id.index()] = stretch;
  return id;
}

void SurfaceComplex::setStretchBetween(NodeId a, NodeId b, StretchId id) {
  preferFewCorners(a, b);
  visitStar(a, [&](TriangleId t, std::uint32_t k) {
    const NodeTriple& nodes = nodesOf(t);
    if (nodes[(k + 1) % 3] == b) setStretch(halfEdgeOf(t, k), id);
    if (nodes[(k + 2) % 3] == b) setStretch(halfEdgeOf(t, (k + 2) % 3), id);
  });
}

SurfaceComplex::LineNeighbours SurfaceComplex::lineNeighbours(NodeId node) const {
  LineNeighbours found;
  const auto consider = [&](HalfEdgeId halfEdge, NodeId other) {
    const StretchId id = stretchOf(halfEdge);
    if (id.isNone()) return;
    if (stretch(id).from == node) {
      found.after = other;
      found.second = id;
    } else {
      found.before = other;
      found.first = id;
    }
  };
  visitStar(node, [&](TriangleId t, std::uint32_t k) {
    const NodeTriple& nodes = nodesOf(t);
    consider(halfEdgeOf(t, k), nodes[(k + 1) % 3]);
    consider(halfEdgeOf(t, (k + 2) % 3), nodes[(k + 2) % 3]);
  });
  return found;
}

bool collapseKeepsTopology(std::span<const HalfEdgeId> edge, std::span<const NodeId> ringA,
                           std::span<const NodeId> ringB) {
  const auto isCommon = [&](NodeId node) { return std::ranges::find(ringB, node) != ringB.end(); };
  return std::ranges::count_if(ringA, isCommon) == std::ssize(edge);
}

}  // namespace tetrafront
