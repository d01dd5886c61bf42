/// Meshes in tiles: taken apart, joined, and optimized on threads and by other engines.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/task.h"
#include "optimize/rules.h"
#include "optimize/tiles.h"
#include "support/mesh_validator.h"
#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"
#include "tetrafront/threads.h"
#include "tetrafront/tile_host.h"
#include "topology/tet_mesh.h"

namespace tetrafront {
namespace {

/// A block of n × n × n cubes of six tetrahedra each. Nodes on its outside are fixed.
TetMesh block(std::uint32_t n) {
  TetMesh mesh;
  const auto nodeAt = [n](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return NodeId((z * (n + 1) + y) * (n + 1) + x);
  };
  for (std::uint32_t z = 0; z <= n; ++z) {
    for (std::uint32_t y = 0; y <= n; ++y) {
      for (std::uint32_t x = 0; x <= n; ++x) {
        mesh.points.emplace_back(x, y, z);
        const bool isInside = std::min({x, y, z}) > 0 && std::max({x, y, z}) < n;
        mesh.isFixed.push_back(isInside ? 0 : 1);
      }
    }
  }
  // Each of the six ways from the lowest corner of a cube to its highest one is a tetrahedron.
  std::array<int, 3> axes{0, 1, 2};
  const auto addCube = [&](std::array<std::uint32_t, 3> corner, bool isEven) {
    NodeQuad nodes{nodeAt(corner[0], corner[1], corner[2])};
    for (std::size_t step = 0; step < 3; ++step) {
      ++corner.at(static_cast<std::size_t>(axes.at(step)));
      nodes.at(step + 1) = nodeAt(corner[0], corner[1], corner[2]);
    }
    if (!isEven) std::swap(nodes[2], nodes[3]);
    mesh.tetrahedra.push_back(nodes);
  };
  do {
    const bool isEven = axes[1] == (axes[0] + 1) % 3;
    for (std::uint32_t z = 0; z < n; ++z) {
      for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) addCube({x, y, z}, isEven);
      }
    }
  } while (std::ranges::next_permutation(axes).found);
  mesh.regions.assign(mesh.tetrahedra.size(), 7);
  return mesh;
}

using Place = std::array<double, 3>;
using Corners = std::array<Place, 4>;

/// Returns the tetrahedra by the positions of their corners, in order.
std::multiset<Corners> tetrahedraOf(const TetMesh& mesh) {
  std::multiset<Corners> all;
  for (const NodeQuad& nodes : mesh.tetrahedra) {
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3& p = mesh.points[nodes.at(k).index()];
      corners.at(k) = {p.x, p.y, p.z};
    }
    all.insert(corners);
  }
  return all;
}

TiledMesh cutOf(const TetMesh& mesh) {
  return Job([&](Work& work) { return TiledMesh::cut(work, mesh); }).finish();
}

TiledMesh seamsOf(const TiledMesh& tiled) {
  return Job([&](Work& work) { return TiledMesh::cutSeams(work, tiled); }).finish();
}

TEST(TiledMesh, IsTheGivenMeshAgainWhenItIsJoined) {
  const TetMesh mesh = block(22);
  ASSERT_GT(mesh.tetrahedra.size(), 2 * kTileElements);
  TiledMesh tiled = cutOf(mesh);
  EXPECT_GE(tiled.tiles().size(), 3U);
  for (const TiledMesh& part : {tiled, seamsOf(tiled)}) {
    const TetMesh joined = part.joined();
    EXPECT_EQ(tetrahedraOf(joined), tetrahedraOf(mesh));
    EXPECT_EQ(joined.points.size(), mesh.points.size());
    EXPECT_EQ(joined.regions, mesh.regions);
    EXPECT_EQ(part.nodeCount(), mesh.points.size());
    EXPECT_EQ(part.tetrahedronCount(), mesh.tetrahedra.size());
  }
}

TEST(TiledMesh, FixesWhatTilesShare) {
  const TetMesh mesh = block(22);
  TiledMesh tiled = cutOf(mesh);
  std::multiset<Place> free;
  for (const Tile& tile : tiled.tiles()) {
    EXPECT_LE(tile.mesh.tetrahedra.size(), kTileElements);
    EXPECT_EQ(tile.nodeOf.size(), std::ranges::count(tile.mesh.isFixed, std::uint8_t{1}));
    for (std::size_t node = 0; node < tile.mesh.points.size(); ++node) {
      const Vec3& p = tile.mesh.points[node];
      if (tile.mesh.isFixed[node] == 0) free.insert({p.x, p.y, p.z});
    }
  }
  // No free node is in two tiles, and none on the outside is free; those of seams are few.
  EXPECT_EQ(std::set<Place>(free.begin(), free.end()).size(), free.size());
  EXPECT_TRUE(std::ranges::all_of(free, [](const Place& place) {
    return std::ranges::all_of(place, [](double x) { return x > 0.0 && x < 22.0; });
  }));
  EXPECT_GT(free.size(), 7000U);
}

TEST(TiledMesh, FreesTheSeamsInTheSecondCut) {
  const TetMesh mesh = block(22);
  TiledMesh tiled = cutOf(mesh);
  const auto sharedOf = [&](const TiledMesh& cut) {
    std::set<Place> places;
    for (const Tile& tile : cut.tiles()) {
      for (std::size_t node = 0; node < tile.mesh.points.size(); ++node) {
        const Vec3& p = tile.mesh.points[node];
        const bool isInside =
            glm::min(glm::min(p.x, p.y), p.z) > 0.0 && glm::max(glm::max(p.x, p.y), p.z) < 22.0;
        if (isInside && tile.mesh.isFixed[node] != 0) places.insert({p.x, p.y, p.z});
      }
    }
    return places;
  };
  const std::set<Place> first = sharedOf(tiled);
  const std::set<Place> second = sharedOf(seamsOf(tiled));
  ASSERT_FALSE(first.empty());
  const auto stillShared =
      std::ranges::count_if(first, [&](const Place& place) { return second.contains(place); });
  EXPECT_LT(static_cast<double>(stillShared), 0.2 * static_cast<double>(first.size()));
}

MeshRun sphereRun(unsigned threads) {
  const SurfaceMesh sphere = testing::geodesicSphere(16);
  MeshOptions options;
  options.interior = Interior::kFront;
  options.optimization = Optimization::kFast;
  MeshRun run(sphere.points, sphere.triangles, options);
  useThreads(run, threads);
  return run;
}

/// Engines that borrow tiles of a run and give them back late, in another order, damaged or never.
class Borrowers {
 public:
  explicit Borrowers(MeshRun& run) : host_(run) {}

  /// Does what engines may have done between two slices of the run.
  void act() {
    if (host_.waitingCount() > 0 && random_.integer(0, 2) > 0) {
      if (!optimizer_) optimizer_.emplace(host_.steps());
      lent_.push_back(host_.lend());
      ++borrowed_;
    }
    if (lent_.empty() || (!host_.isWaiting() && random_.integer(0, 40) > 0)) return;
    std::swap(lent_.back(), lent_[lent_.size() / 2]);
    const LentTile tile = std::move(lent_.back());
    lent_.pop_back();
    ++ended_;
    if (ended_ == 1) {
      host_.withdraw(tile.id);
    } else if (ended_ == 2) {
      TileMesh damaged = tile.mesh;
      damaged.isFixed.pop_back();
      EXPECT_FALSE(host_.giveBack(tile.id, damaged));
    } else {
      EXPECT_TRUE(host_.giveBack(tile.id, optimized(tile.mesh)));
      ++returned_;
    }
    host_.withdraw(tile.id);  // too late
  }

  [[nodiscard]] std::size_t borrowed() const { return borrowed_; }
  [[nodiscard]] std::size_t returned() const { return returned_; }

 private:
  TileMesh optimized(const TileMesh& tile) {
    optimizer_->begin(tile);
    while (!optimizer_->advance(5000)) {
    }
    return optimizer_->result();
  }

  TileHost host_;
  testing::Random random_{17};
  std::optional<TileOptimizer> optimizer_;
  std::vector<LentTile> lent_;
  std::size_t borrowed_ = 0;
  std::size_t returned_ = 0;
  std::size_t ended_ = 0;  ///< loans that have ended, with a result or without
};

TEST(Tiles, GiveTheSameMeshOnAnyNumberOfThreadsAndBorrowed) {
  std::set<std::uint64_t> fingerprints;
  for (const unsigned threads : {1U, 5U}) {
    MeshRun run = sphereRun(threads);
    while (run.advance(threads == 1 ? 777 : 100'000) == MeshStatus::kRunning) {
    }
    ASSERT_EQ(run.status(), MeshStatus::kDone);
    EXPECT_GT(run.volume().tetrahedra.size() / 4, kMinTiled);
    EXPECT_GT(run.quality().minDihedral, 28.0);
    fingerprints.insert(run.fingerprint());
    if (threads == 1) {
      EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
    }
  }
  MeshRun run = sphereRun(1);
  Borrowers borrowers(run);
  while (run.advance(2000) == MeshStatus::kRunning) borrowers.act();
  EXPECT_GE(borrowers.returned(), 2U);
  EXPECT_GT(borrowers.borrowed(), borrowers.returned());
  fingerprints.insert(run.fingerprint());
  EXPECT_EQ(fingerprints.size(), 1U);
}

TEST(Tiles, ThatAreLentEndWithTheRun) {
  MeshRun run = sphereRun(1);
  TileHost host(run);
  EXPECT_TRUE(host.steps().empty());
  EXPECT_EQ(host.lend().id, 0U);
  while (host.waitingCount() == 0) ASSERT_EQ(run.advance(20'000), MeshStatus::kRunning);
  const LentTile first = host.lend();
  const LentTile second = host.lend();
  ASSERT_GT(first.id, 0U);
  EXPECT_NE(first.id, second.id);
  EXPECT_TRUE(host.giveBack(second.id, second.mesh));
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  run.cancel();
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  EXPECT_TRUE(host.giveBack(first.id, first.mesh));
  EXPECT_EQ(host.waitingCount(), 0U);
  EXPECT_FALSE(host.isWaiting());
}

TEST(Tiles, AreCancelledWhileThreadsWork) {
  MeshRun run = sphereRun(2);
  while (run.progress().phase != Phase::kOptimize) {
    ASSERT_EQ(run.advance(20'000), MeshStatus::kRunning);
  }
  for (int slice = 0; slice < 5; ++slice) run.advance(1);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  run.cancel();
  EXPECT_EQ(run.status(), MeshStatus::kCancelled);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
}

}  // namespace
}  // namespace tetrafront
