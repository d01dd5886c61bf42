// The changes of a patch's triangulation, against links built anew.

#include "base/ids.h"
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

/// The unit square as a grid of cells, each cut in two; boundary nodes first, as everywhere.
PlanarMesh gridMesh() {
  PlanarMesh mesh;
  constexpr std::uint32_t kRow = kCells + 1;
  std::vector<std::uint32_t> numbers(std::size_t{kRow} * kRow);
  for (const bool boundary : {true, false}) {
    for (std::uint32_t j = 0; j < kRow; ++j) {
      for (std::uint32_t i = 0; i < kRow; ++i) {
        const bool outside = i == 0 || j == 0 || i == kCells || j == kCells;
        if (outside != boundary) continue;
        const Vec2 at(i, j);
        numbers[j * kRow + i] = mesh.addNode(at, Vec3(at.x, at.y, 0.0), 1.0);
      }
    }
    if (boundary) mesh.boundaryCount = static_cast<std::uint32_t>(mesh.plane.size());
  }
  for (std::uint32_t j = 0; j < kCells; ++j) {
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t a = numbers[j * kRow + i];
      const std::uint32_t b = numbers[j * kRow + i + 1];
      const std::uint32_t c = numbers[(j + 1) * kRow + i + 1];
      const std::uint32_t d = numbers[(j + 1) * kRow + i];
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    }
  }
  return mesh;
}

double areaOf(const PlanarMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    if (mesh.triangles[t] == kNoIndex) continue;
    const Vec2 u = mesh.plane[mesh.triangles[t + 1]] - mesh.plane[mesh.triangles[t]];
    const Vec2 v = mesh.plane[mesh.triangles[t + 2]] - mesh.plane[mesh.triangles[t]];
    const double turn = u.x * v.y - u.y * v.x;
    EXPECT_GT(turn, 0.0);
    area += 0.5 * turn;
  }
  return area;
}

/// Across every side lies the one triangle that has it the other way round, or nothing.
void expectConsistent(const PlanarLinks& links, const PlanarMesh& mesh) {
  using Side = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Side, std::uint32_t> owners;
  for (std::uint32_t t = 0; t < links.triangleCount(); ++t) {
    if (!links.isAlive(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Side side(links.node(t, (k + 1) % 3), links.node(t, (k + 2) % 3));
      EXPECT_TRUE(owners.emplace(side, t).second);
    }
  }
  for (const auto& [side, t] : owners) {
    const auto twin = owners.find({side.second, side.first});
    std::uint32_t k = 0;
    while (links.node(t, k) == side.first || links.node(t, k) == side.second) ++k;
    EXPECT_EQ(links.neighbour(t, k), twin == owners.end() ? kNoIndex : twin->second);
    const std::uint32_t owner = links.triangleOf(side.first);
    ASSERT_NE(owner, kNoIndex);
    EXPECT_EQ(links.node(owner, links.corner(owner, side.first)), side.first);
  }
  EXPECT_NEAR(areaOf(mesh), kCells * kCells, 1e-9);
}

class RandomChanges {
 public:
  RandomChanges(PlanarMesh& mesh, PlanarLinks& links, std::uint64_t seed)
      : mesh_(&mesh), links_(&links), random_(seed) {}

  /// One change at a random place, if it keeps all triangles turning the right way.
  bool change() {
    const auto t = static_cast<std::uint32_t>(
        random_.integer(0, static_cast<int>(links_->triangleCount()) - 1));
    const auto k = static_cast<std::uint32_t>(random_.integer(0, 2));
    if (!links_->isAlive(t)) return false;
    const int kind = random_.integer(0, 3);
    if (kind == 0) return collapse(links_->node(t, k));
    if (kind == 3) return insert(t);
    if (links_->neighbour(t, k) == kNoIndex) return false;
    return kind == 1 ? flip(t, k) : split(t, k);
  }

 private:
  bool flip(std::uint32_t t, std::uint32_t k) {
    const auto [other, a, b, c, d] = links_->diamond(t, k);
    if (mesh_->turn(c, a, d) <= 0 || mesh_->turn(c, d, b) <= 0) return false;
    links_->flip(t, k);
    return true;
  }

  bool split(std::uint32_t t, std::uint32_t k) {
    const PlanarLinks::Diamond sides = links_->diamond(t, k);
    const Vec2 middle = 0.5 * (mesh_->plane[sides.a] + mesh_->plane[sides.b]);
    links_->split(t, k, mesh_->addNode(middle, Vec3(middle.x, middle.y, 0.0), 1.0));
    return true;
  }

  /// Halves of halves are exact, so that every place inside a triangle is.
  bool insert(std::uint32_t t) {
    const Vec2 middle = 0.5 * (mesh_->plane[links_->node(t, 1)] + mesh_->plane[links_->node(t, 2)]);
    const Vec2 inside = 0.5 * (mesh_->plane[links_->node(t, 0)] + middle);
    links_->insert(t, mesh_->addNode(inside, Vec3(inside.x, inside.y, 0.0), 1.0));
    return true;
  }

  bool collapse(std::uint32_t node) {
    PlanarLinks::Star star;
    if (!links_->collectStar(node, star)) return false;
    const std::size_t count = star.ring.size();
    const auto into = static_cast<std::size_t>(random_.integer(0, static_cast<int>(count) - 1));
    for (std::size_t i = 1; i + 1 < count; ++i)
      if (mesh_->turn(star.ring[into], star.ring[(into + i) % count],
                      star.ring[(into + i + 1) % count]) <= 0)
        return false;
    links_->collapse(node, star, into);
    return true;
  }

  PlanarMesh* mesh_;
  PlanarLinks* links_;
  Random random_;
};

TEST(SurfacePlanarLinks, StayRightThroughRandomChanges) {
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

TEST(SurfacePlanarLinks, CompactionLeavesOutWhatIsGone) {
  PlanarMesh mesh = gridMesh();
  PlanarLinks links(mesh);
  links.build();
  RandomChanges changes(mesh, links, 5);
  for (int i = 0; i < 300; ++i) changes.change();
  std::set<std::pair<double, double>> before;
  for (std::uint32_t t = 0; t < links.triangleCount(); ++t)
    if (links.isAlive(t))
      for (std::uint32_t k = 0; k < 3; ++k)
        before.emplace(mesh.plane[links.node(t, k)].x, mesh.plane[links.node(t, k)].y);
  const std::uint32_t boundaryCount = mesh.boundaryCount;
  links.compact();
  EXPECT_EQ(mesh.plane.size(), before.size());
  EXPECT_EQ(mesh.places.size(), mesh.plane.size());
  EXPECT_EQ(mesh.boundaryCount, boundaryCount);
  for (const std::uint32_t node : mesh.triangles) ASSERT_LT(node, mesh.plane.size());
  for (const Vec2& at : mesh.plane) EXPECT_TRUE(before.contains({at.x, at.y}));
  PlanarLinks again(mesh);
  again.build();
  expectConsistent(again, mesh);
}

}  // namespace
}  // namespace tetrafront::testing
