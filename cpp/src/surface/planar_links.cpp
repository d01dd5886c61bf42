#include "surface/planar_links.h"

#include <algorithm>

namespace tetrafront {

void PlanarLinks::build() {
  const std::size_t count = mesh_->triangles.size();
  neighbours_.assign(count, {});
  triangleOf_.assign(mesh_->plane.size(), {});
  // Collect the triangles of each node by counting, then find each edge's other triangle at one of its ends.
  std::vector<std::uint32_t> starts(mesh_->plane.size() + 1, 0);
  for (const PlanarMesh::Triangle& triangle : mesh_->triangles)
    for (const PlanarNodeId corner : triangle) ++starts[corner.index() + 1];
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  std::vector<PlanarTriangleId> around(3 * count);
  for (std::size_t t = 0; t < count; ++t)
    for (const PlanarNodeId corner : mesh_->triangles[t])
      around[next[corner.index()]++] = PlanarTriangleId(t);

  for (std::size_t i = 0; i < count; ++i) {
    const PlanarTriangleId t(i);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const PlanarNodeId from = node(t, (k + 1) % 3);
      const PlanarNodeId to = node(t, (k + 2) % 3);
      triangleOf_[from.index()] = t;
      for (std::uint32_t entry = starts[from.index()]; entry < starts[from.index() + 1]; ++entry) {
        const PlanarTriangleId other = around[entry];
        if (node(other, (cornerOf(other, from) + 2) % 3) == to) neighbours_[i][k] = other;
      }
    }
  }
}

std::uint32_t PlanarLinks::cornerOf(PlanarTriangleId triangle, PlanarNodeId node) const {
  const PlanarMesh::Triangle& nodes = mesh_->triangles[triangle.index()];
  return nodes[0] == node ? 0U : (nodes[1] == node ? 1U : 2U);
}

bool PlanarLinks::collectStar(PlanarNodeId centre, Star& star) const {
  star.ring.clear();
  star.triangles.clear();
  const PlanarTriangleId first = triangleOf(centre);
  if (first.isNone()) return false;
  PlanarTriangleId t = first;
  do {
    const std::uint32_t corner = cornerOf(t, centre);
    star.ring.push_back(node(t, (corner + 1) % 3));
    star.triangles.push_back(t);
    // The next triangle counter-clockwise lies across the edge from the centre to the last node.
    t = neighbour(t, (corner + 1) % 3);
    if (t.isNone()) return false;
  } while (t != first);
  return true;
}

PlanarLinks::Diamond PlanarLinks::diamond(PlanarTriangleId t, std::uint32_t k) const {
  Diamond found{};
  found.other = neighbour(t, k);
  found.c = node(t, k);
  found.a = node(t, (k + 1) % 3);
  found.b = node(t, (k + 2) % 3);
  found.d = node(found.other, (cornerOf(found.other, found.a) + 1) % 3);
  return found;
}

void PlanarLinks::put(PlanarTriangleId triangle, const PlanarMesh::Triangle& nodes,
                      const Neighbours& around) {
  mesh_->triangles[triangle.index()] = nodes;
  for (const PlanarNodeId node : nodes) triangleOf_[node.index()] = triangle;
  neighbours_[triangle.index()] = around;
}

void PlanarLinks::replaceNeighbour(PlanarTriangleId triangle, PlanarTriangleId old,
                                   PlanarTriangleId now) {
  if (triangle.isNone()) return;
  for (PlanarTriangleId& neighbour : neighbours_[triangle.index()]) {
    if (neighbour != old) continue;
    neighbour = now;
    return;
  }
}

PlanarTriangleId PlanarLinks::addTriangle() {
  mesh_->triangles.emplace_back();
  neighbours_.emplace_back();
  return PlanarTriangleId(neighbours_.size() - 1);
}

/// Replaces the edge a b between t and the other triangle by c d:
///
///        c                c
///       /t\              /|\         t     = (c a d)
///      a---b     ->     a | b        other = (c d b)
///       \ /              \|/
///        d                d
void PlanarLinks::flip(PlanarTriangleId t, std::uint32_t k) {
  const auto [other, a, b, c, d] = diamond(t, k);
  const PlanarTriangleId overBC = neighbour(t, (k + 1) % 3);
  const PlanarTriangleId overCA = neighbour(t, (k + 2) % 3);
  const PlanarTriangleId overDB = neighbour(other, cornerOf(other, a));
  const PlanarTriangleId overAD = neighbour(other, cornerOf(other, b));
  put(t, {c, a, d}, {overAD, other, overCA});
  put(other, {c, d, b}, {overDB, overBC, t});
  replaceNeighbour(overAD, other, t);
  replaceNeighbour(overBC, t, other);
}

void PlanarLinks::collapse(PlanarNodeId centre, const Star& star, std::size_t target) {
  const std::size_t count = star.ring.size();
  // Remove the two triangles at the edge from the centre to the target. Their neighbours in the star take
  // over their outer neighbours.
  const PlanarTriangleId after = star.triangles[target];
  const PlanarTriangleId before = star.triangles[(target + count - 1) % count];
  const PlanarTriangleId nextAfter = star.triangles[(target + 1) % count];
  const PlanarTriangleId nextBefore = star.triangles[(target + count - 2) % count];
  const PlanarTriangleId overAfter = neighbour(after, cornerOf(after, centre));
  const PlanarTriangleId overBefore = neighbour(before, cornerOf(before, centre));
  replaceNeighbour(nextAfter, after, overAfter);
  replaceNeighbour(overAfter, after, nextAfter);
  replaceNeighbour(nextBefore, before, overBefore);
  replaceNeighbour(overBefore, before, nextBefore);
  for (const PlanarTriangleId t : star.triangles) {
    if (t == after || t == before) continue;
    mesh_->triangles[t.index()][cornerOf(t, centre)] = star.ring[target];
    for (const PlanarNodeId node : mesh_->triangles[t.index()]) triangleOf_[node.index()] = t;
  }
  for (const PlanarTriangleId t : {after, before}) {
    mesh_->triangles[t.index()] = {};
    neighbours_[t.index()] = {};
  }
  triangleOf_[centre.index()] = {};
}

void PlanarLinks::split(PlanarTriangleId t, std::uint32_t k, PlanarNodeId middle) {
  const auto [other, a, b, c, d] = diamond(t, k);
  const PlanarTriangleId overBC = neighbour(t, (k + 1) % 3);
  const PlanarTriangleId overCA = neighbour(t, (k + 2) % 3);
  const PlanarTriangleId overDB = neighbour(other, cornerOf(other, a));
  const PlanarTriangleId overAD = neighbour(other, cornerOf(other, b));
  triangleOf_.resize(mesh_->plane.size());
  const PlanarTriangleId second = addTriangle();
  const PlanarTriangleId otherSecond = addTriangle();
  put(t, {c, a, middle}, {other, second, overCA});
  put(second, {c, middle, b}, {otherSecond, overBC, t});
  put(other, {d, middle, a}, {t, overAD, otherSecond});
  put(otherSecond, {d, b, middle}, {second, other, overDB});
  replaceNeighbour(overBC, t, second);
  replaceNeighbour(overDB, other, otherSecond);
}

void PlanarLinks::insert(PlanarTriangleId t, PlanarNodeId centre) {
  const auto [a, b, c] = mesh_->triangles[t.index()];
  const auto [overBC, overCA, overAB] = neighbours_[t.index()];
  triangleOf_.resize(mesh_->plane.size());
  const PlanarTriangleId second = addTriangle();
  const PlanarTriangleId third = addTriangle();
  put(t, {a, b, centre}, {second, third, overAB});
  put(second, {b, c, centre}, {third, t, overBC});
  put(third, {c, a, centre}, {t, second, overCA});
  replaceNeighbour(overBC, t, second);
  replaceNeighbour(overCA, t, third);
}

void PlanarLinks::compact() {
  PlanarMesh& mesh = *mesh_;
  std::vector<PlanarNodeId> newIds(mesh.plane.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.plane.size(); ++i) {
    if (i >= mesh.boundaryCount && triangleOf_[i].isNone()) continue;
    mesh.plane[kept] = mesh.plane[i];
    mesh.positions[kept] = mesh.positions[i];
    mesh.sizes[kept] = mesh.sizes[i];
    mesh.carriers[kept] = mesh.carriers[i];
    mesh.surfaceNodes[kept] = mesh.surfaceNodes[i];
    newIds[i] = PlanarNodeId(kept++);
  }
  while (mesh.plane.size() > kept) mesh.removeLastNode();
  std::erase_if(mesh.triangles, [](const auto& triangle) { return triangle[0].isNone(); });
  for (PlanarMesh::Triangle& triangle : mesh.triangles)
    for (PlanarNodeId& node : triangle) node = newIds[node.index()];
}

}  // namespace tetrafront
