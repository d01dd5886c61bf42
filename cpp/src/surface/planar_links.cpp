#include "surface/planar_links.h"

#include <algorithm>

namespace tetrafront {

void PlanarLinks::build() {
  const auto count = static_cast<std::uint32_t>(mesh_->triangles.size() / 3);
  neighbours_.assign(count, {kNoIndex, kNoIndex, kNoIndex});
  triangleOf_.assign(mesh_->plane.size(), kNoIndex);
  // Each node's triangles, by counting; then each side looks for its twin around one end.
  std::vector<std::uint32_t> starts(mesh_->plane.size() + 1, 0);
  for (const std::uint32_t corner : mesh_->triangles) ++starts[corner + 1];
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  std::vector<std::uint32_t> fill(starts.begin(), starts.end() - 1);
  std::vector<std::uint32_t> around(mesh_->triangles.size());
  for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i)
    around[fill[mesh_->triangles[i]]++] = i / 3;

  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = node(t, (k + 1) % 3);
      const std::uint32_t to = node(t, (k + 2) % 3);
      triangleOf_[from] = t;
      for (std::uint32_t i = starts[from]; i < starts[from + 1]; ++i) {
        const std::uint32_t other = around[i];
        if (node(other, (corner(other, from) + 2) % 3) == to) neighbours_[t][k] = other;
      }
    }
  }
}

std::uint32_t PlanarLinks::corner(std::uint32_t triangle, std::uint32_t wanted) const {
  for (std::uint32_t k = 0; k < 2; ++k)
    if (node(triangle, k) == wanted) return k;
  return 2;
}

bool PlanarLinks::collectStar(std::uint32_t centre, Star& star) const {
  star.ring.clear();
  star.triangles.clear();
  const std::uint32_t first = triangleOf_[centre];
  if (first == kNoIndex) return false;
  std::uint32_t t = first;
  do {
    const std::uint32_t at = corner(t, centre);
    star.ring.push_back(node(t, (at + 1) % 3));
    star.triangles.push_back(t);
    // The next triangle counter-clockwise lies across the side from the centre to the last node.
    t = neighbours_[t][(at + 1) % 3];
    if (t == kNoIndex) return false;
  } while (t != first);
  return true;
}

PlanarLinks::Diamond PlanarLinks::diamond(std::uint32_t t, std::uint32_t k) const {
  Diamond found{};
  found.other = neighbours_[t][k];
  found.c = node(t, k);
  found.a = node(t, (k + 1) % 3);
  found.b = node(t, (k + 2) % 3);
  found.d = node(found.other, (corner(found.other, found.a) + 1) % 3);
  return found;
}

void PlanarLinks::put(std::uint32_t triangle, const std::array<std::uint32_t, 3>& nodes,
                      const Neighbours& around) {
  for (std::size_t k = 0; k < 3; ++k) {
    mesh_->triangles[3 * std::size_t{triangle} + k] = nodes[k];
    triangleOf_[nodes[k]] = triangle;
  }
  neighbours_[triangle] = around;
}

void PlanarLinks::replaceNeighbour(std::uint32_t triangle, std::uint32_t old, std::uint32_t now) {
  if (triangle == kNoIndex) return;
  for (std::uint32_t& neighbour : neighbours_[triangle]) {
    if (neighbour != old) continue;
    neighbour = now;
    return;
  }
}

std::uint32_t PlanarLinks::addTriangle() {
  mesh_->triangles.insert(mesh_->triangles.end(), 3, kNoIndex);
  neighbours_.push_back({kNoIndex, kNoIndex, kNoIndex});
  return triangleCount() - 1;
}

/// The side a b between t and the other is replaced by c d:
///
///        c                c
///       /t\              /|\         t     = (c a d)
///      a---b     ->     a | b        other = (c d b)
///       \ /              \|/
///        d                d
void PlanarLinks::flip(std::uint32_t t, std::uint32_t k) {
  const auto [other, a, b, c, d] = diamond(t, k);
  const std::uint32_t overBC = neighbours_[t][(k + 1) % 3];
  const std::uint32_t overCA = neighbours_[t][(k + 2) % 3];
  const std::uint32_t overDB = neighbours_[other][corner(other, a)];
  const std::uint32_t overAD = neighbours_[other][corner(other, b)];
  put(t, {c, a, d}, {overAD, other, overCA});
  put(other, {c, d, b}, {overDB, overBC, t});
  replaceNeighbour(overAD, other, t);
  replaceNeighbour(overBC, t, other);
}

void PlanarLinks::collapse(std::uint32_t centre, const Star& star, std::size_t into) {
  const std::size_t count = star.ring.size();
  const std::uint32_t target = star.ring[into];
  // The two triangles at the side from the centre to the target go, those beside them take over
  // their outer neighbours.
  const std::uint32_t after = star.triangles[into];
  const std::uint32_t before = star.triangles[(into + count - 1) % count];
  const std::uint32_t nextAfter = star.triangles[(into + 1) % count];
  const std::uint32_t nextBefore = star.triangles[(into + count - 2) % count];
  const std::uint32_t overAfter = neighbours_[after][corner(after, centre)];
  const std::uint32_t overBefore = neighbours_[before][corner(before, centre)];
  replaceNeighbour(nextAfter, after, overAfter);
  replaceNeighbour(overAfter, after, nextAfter);
  replaceNeighbour(nextBefore, before, overBefore);
  replaceNeighbour(overBefore, before, nextBefore);
  for (const std::uint32_t t : star.triangles) {
    if (t == after || t == before) continue;
    mesh_->triangles[3 * std::size_t{t} + corner(t, centre)] = target;
    for (std::uint32_t k = 0; k < 3; ++k) triangleOf_[node(t, k)] = t;
  }
  for (const std::uint32_t t : {after, before}) {
    for (std::size_t k = 0; k < 3; ++k) mesh_->triangles[3 * std::size_t{t} + k] = kNoIndex;
    neighbours_[t] = {kNoIndex, kNoIndex, kNoIndex};
  }
  triangleOf_[centre] = kNoIndex;
}

void PlanarLinks::split(std::uint32_t t, std::uint32_t k, std::uint32_t middle) {
  const auto [other, a, b, c, d] = diamond(t, k);
  const std::uint32_t overBC = neighbours_[t][(k + 1) % 3];
  const std::uint32_t overCA = neighbours_[t][(k + 2) % 3];
  const std::uint32_t overDB = neighbours_[other][corner(other, a)];
  const std::uint32_t overAD = neighbours_[other][corner(other, b)];
  triangleOf_.resize(mesh_->plane.size(), kNoIndex);
  const std::uint32_t second = addTriangle();
  const std::uint32_t otherSecond = addTriangle();
  put(t, {c, a, middle}, {other, second, overCA});
  put(second, {c, middle, b}, {otherSecond, overBC, t});
  put(other, {d, middle, a}, {t, overAD, otherSecond});
  put(otherSecond, {d, b, middle}, {second, other, overDB});
  replaceNeighbour(overBC, t, second);
  replaceNeighbour(overDB, other, otherSecond);
}

void PlanarLinks::insert(std::uint32_t t, std::uint32_t centre) {
  const std::array<std::uint32_t, 3> nodes{node(t, 0), node(t, 1), node(t, 2)};
  const Neighbours over = neighbours_[t];
  triangleOf_.resize(mesh_->plane.size(), kNoIndex);
  const std::uint32_t second = addTriangle();
  const std::uint32_t third = addTriangle();
  put(t, {nodes[0], nodes[1], centre}, {second, third, over[2]});
  put(second, {nodes[1], nodes[2], centre}, {third, t, over[0]});
  put(third, {nodes[2], nodes[0], centre}, {t, second, over[1]});
  replaceNeighbour(over[0], t, second);
  replaceNeighbour(over[1], t, third);
}

void PlanarLinks::compact() {
  PlanarMesh& mesh = *mesh_;
  std::vector<std::uint32_t> numbers(mesh.plane.size(), kNoIndex);
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < mesh.plane.size(); ++i) {
    if (i >= mesh.boundaryCount && triangleOf_[i] == kNoIndex) continue;
    mesh.plane[kept] = mesh.plane[i];
    mesh.places[kept] = mesh.places[i];
    mesh.sizes[kept] = mesh.sizes[i];
    mesh.straights[kept] = mesh.straights[i];
    mesh.aliases[kept] = mesh.aliases[i];
    numbers[i] = kept++;
  }
  while (mesh.plane.size() > kept) mesh.dropLastNode();
  std::size_t end = 0;
  for (const std::uint32_t node : mesh.triangles)
    if (node != kNoIndex) mesh.triangles[end++] = numbers[node];
  mesh.triangles.resize(end);
}

}  // namespace tetrafront
