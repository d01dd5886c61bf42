// Random changes of a patch's triangulation, compared with links built from scratch.

#include "surface/planar_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "support/random.h"

namespace tetrafront::testing {
namespace {

constexpr std::uint32_t kCells = 6;

PlanarNodeId addFlatNode(PlanarMesh& mesh, const Vec2& at) {
  return mesh.addNode(at, Vec3(at.x, at.y, 0.0), 1.0);
}

/// A square of kCells x kCells cells of two triangles each; boundary nodes come first, as in every PlanarMesh.
PlanarMesh gridMesh() {
  PlanarMesh mesh;
  constexpr std::uint32_t kRow = kCells + 1;
  std::vector<PlanarNodeId> nodes(std::size_t{kRow} * kRow);
  for (const bool addsBoundary : {true, false}) {
    for (std::uint32_t j = 0; j < kRow; ++j) {
      for (std::uint32_t i = 0; i < kRow; ++i) {
        const bool isBoundary = i == 0 || j == 0 || i == kCells || j == kCells;
        if (isBoundary == addsBoundary) nodes[j * kRow + i] = addFlatNode(mesh, Vec2(i, j));
      }
    }
    if (addsBoundary) mesh.boundaryCount = static_cast<std::uint32_t>(mesh.plane.size());
  }
  for (std::uint32_t j = 0; j < kCells; ++j) {
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const PlanarNodeId a = nodes[j * kRow + i];
      const PlanarNodeId b = nodes[j * kRow + i + 1];
      const PlanarNodeId c = nodes[(j + 1) * kRow + i + 1];
      const PlanarNodeId d = nodes[(j + 1) * kRow + i];
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

double areaOf(const PlanarMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a.isNone()) continue;
    const Vec2 u = mesh.planeOf(b) - mesh.planeOf(a);
    const Vec2 v = mesh.planeOf(c) - mesh.planeOf(a);
    const double twiceArea = u.x * v.y - u.y * v.x;
    EXPECT_GT(twiceArea, 0.0);
    area += 0.5 * twiceArea;
  }
  return area;
}

std::vector<PlanarTriangleId> aliveTriangles(const PlanarLinks& links) {
  std::vector<PlanarTriangleId> alive;
  for (std::uint32_t t = 0; t < links.triangleCount(); ++t)
    if (links.isAlive(PlanarTriangleId(t))) alive.emplace_back(t);
  return alive;
}

/// The neighbour across an edge is the triangle that has the edge in the opposite direction, or none.
void expectConsistent(const PlanarLinks& links, const PlanarMesh& mesh) {
  using Edge = std::pair<PlanarNodeId, PlanarNodeId>;
  std::map<Edge, PlanarTriangleId> owners;
  for (const PlanarTriangleId t : aliveTriangles(links))
    for (std::uint32_t k = 0; k < 3; ++k)
      EXPECT_TRUE(
          owners.emplace(Edge(links.node(t, (k + 1) % 3), links.node(t, (k + 2) % 3)), t).second);
  for (const auto& [edge, t] : owners) {
    const auto opposite = owners.find({edge.second, edge.first});
    std::uint32_t k = 0;
    while (links.node(t, k) == edge.first || links.node(t, k) == edge.second) ++k;
    EXPECT_EQ(links.neighbour(t, k),
              opposite == owners.end() ? PlanarTriangleId{} : opposite->second);
    const PlanarTriangleId owner = links.triangleOf(edge.first);
    ASSERT_FALSE(owner.isNone());
    EXPECT_EQ(links.node(owner, links.cornerOf(owner, edge.first)), edge.first);
  }
  EXPECT_NEAR(areaOf(mesh), kCells * kCells, 1e-9);
}

class RandomChanges {
 public:
  RandomChanges(PlanarMesh& mesh, PlanarLinks& links, std::uint64_t seed)
      : mesh_(&mesh), links_(&links), random_(seed) {}

  /// Makes a random change if it keeps all triangles counter-clockwise; returns whether it did.
  bool change() {
    const PlanarTriangleId t(static_cast<std::uint32_t>(
        random_.integer(0, static_cast<int>(links_->triangleCount()) - 1)));
    const auto k = static_cast<std::uint32_t>(random_.integer(0, 2));
    if (!links_->isAlive(t)) return false;
    const int kind = random_.integer(0, 3);
    if (kind == 0) return collapse(links_->node(t, k));
    if (kind == 3) return insert(t);
    if (links_->neighbour(t, k).isNone()) return false;
    return kind == 1 ? flip(t, k) : split(t, k);
  }

 private:
  bool flip(PlanarTriangleId t, std::uint32_t k) {
    const auto [other, a, b, c, d] = links_->diamond(t, k);
    if (mesh_->orientation(c, a, d) <= 0 || mesh_->orientation(c, d, b) <= 0) return false;
    links_->flip(t, k);
    return true;
  }

  bool split(PlanarTriangleId t, std::uint32_t k) {
    const PlanarLinks::Diamond diamond = links_->diamond(t, k);
    const Vec2 middle = 0.5 * (mesh_->planeOf(diamond.a) + mesh_->planeOf(diamond.b));
    links_->split(t, k, addFlatNode(*mesh_, middle));
    return true;
  }

  /// Halves of halves are exact, so the new node lies inside the triangle.
  bool insert(PlanarTriangleId t) {
    const auto corner = [&](std::uint32_t k) { return mesh_->planeOf(links_->node(t, k)); };
    const Vec2 middle = 0.5 * (corner(1) + corner(2));
    links_->insert(t, addFlatNode(*mesh_, 0.5 * (corner(0) + middle)));
    return true;
  }

  bool collapse(PlanarNodeId node) {
    PlanarLinks::Star star;
    if (!links_->collectStar(node, star)) return false;
    const std::size_t count = star.ring.size();
    const auto target = static_cast<std::size_t>(random_.integer(0, static_cast<int>(count) - 1));
    for (std::size_t i = 1; i + 1 < count; ++i)
      if (mesh_->orientation(star.ring[target], star.ring[(target + i) % count],
                             star.ring[(target + i + 1) % count]) <= 0)
        return false;
    links_->collapse(node, star, target);
    return true;
  }

  PlanarMesh* mesh_;
  PlanarLinks* links_;
  Random random_;
};

TEST(SurfacePlanarLinks, StayConsistentThroughRandomChanges) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    PlanarMesh mesh = gridMesh();
    PlanarLinks links(mesh);
    links.build();
    expectConsistent(links, mesh);
    RandomChanges changes(mesh, links, seed);
    int made = 0;
    for (int i = 0; i < 600; ++i) made += changes.change() ? 1 : 0;
    EXPECT_GT(made, 100);
    expectConsistent(links, mesh);
  }
}

TEST(SurfacePlanarLinks, CompactRemovesDeadNodesAndTriangles) {
  PlanarMesh mesh = gridMesh();
  PlanarLinks links(mesh);
  links.build();
  RandomChanges changes(mesh, links, 5);
  for (int i = 0; i < 300; ++i) changes.change();
  std::set<std::pair<double, double>> before;
  for (const PlanarTriangleId t : aliveTriangles(links)) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec2& at = mesh.planeOf(links.node(t, k));
      before.emplace(at.x, at.y);
    }
  }
  const std::uint32_t boundaryCount = mesh.boundaryCount;
  links.compact();
  EXPECT_EQ(mesh.plane.size(), before.size());
  EXPECT_EQ(mesh.positions.size(), mesh.plane.size());
  EXPECT_EQ(mesh.boundaryCount, boundaryCount);
  for (const PlanarMesh::Triangle& triangle : mesh.triangles)
    for (const PlanarNodeId node : triangle) ASSERT_LT(node.index(), mesh.plane.size());
  for (const Vec2& at : mesh.plane) EXPECT_TRUE(before.contains({at.x, at.y}));
  PlanarLinks again(mesh);
  again.build();
  expectConsistent(again, mesh);
}

}  // namespace
}  // namespace tetrafront::testing
