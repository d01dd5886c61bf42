/// The order in which faces become base faces. The faces here bound nothing, because the order does
/// not depend on it.

#include "volume/front.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace tetrafront {
namespace {

constexpr double kSizesPerTile = 8.0;

/// Adds a right-angled triangle of this root mean square edge length with its first corner at
/// `position`.
FaceId addTriangle(Front& front, const Vec3& position, double size, std::uint16_t layer) {
  const double leg = size * std::sqrt(0.75);
  const NodeId a = front.addNode(position, layer);
  const NodeId b = front.addNode(position + Vec3(leg, 0.0, 0.0), layer);
  const NodeId c = front.addNode(position + Vec3(0.0, leg, 0.0), layer);
  return front.addFace({a, b, c}, 0, {}, true);
}

/// Adds triangles of one size at random in a cube of 48 sizes.
std::vector<FaceId> scatter(Front& front, double size, std::uint16_t layer) {
  std::mt19937 random(7);
  const auto coordinate = [&] { return 48.0 * size * (static_cast<double>(random()) / 0x1p32); };
  std::vector<FaceId> faces;
  for (int i = 0; i < 2000; ++i) {
    const double x = coordinate();
    const double y = coordinate();
    const double z = coordinate();
    faces.push_back(addTriangle(front, {x, y, z}, size, layer));
  }
  return faces;
}

std::array<int, 3> tileOf(const Front& front, FaceId face, double size) {
  const Vec3 inTiles = front.node(front.face(face).nodes[0]) / (kSizesPerTile * size);
  return {static_cast<int>(inTiles.x), static_cast<int>(inTiles.y), static_cast<int>(inTiles.z)};
}

class FrontOrderTest : public ::testing::TestWithParam<double> {};

/// Tiles scale with the size bucket, so this also holds for faces far from the typical size.
TEST_P(FrontOrderTest, TakesFacesOfOneSizeAndLayerTileByTile) {
  const double size = GetParam();
  Front front(1.0, Vec3(0.0), FrontOrder::kLayered);
  const std::size_t count = scatter(front, size, 0).size();
  std::set<std::array<int, 3>> tiles;
  std::array<int, 3> last{-1, -1, -1};
  int changes = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<int, 3> tile = tileOf(front, front.popBase(), size);
    changes += tile != last ? 1 : 0;
    last = tile;
    tiles.insert(tile);
  }
  EXPECT_TRUE(front.isQueueEmpty());
  EXPECT_EQ(tiles.size(), 216U);
  EXPECT_EQ(changes, 216) << "the front leaves a tile only when it is empty";
}

INSTANTIATE_TEST_SUITE_P(Volume, FrontOrderTest, ::testing::Values(1.0 / 64.0, 1.0, 4096.0));

TEST(FrontOrder, LayersComeBeforeTilesAndBucketsBeforeLayers) {
  Front front(1.0, Vec3(0.0), FrontOrder::kLayered);
  const std::size_t outer = scatter(front, 1.0, 3).size();
  const std::size_t inner = scatter(front, 1.0, 4).size();
  const FaceId small = addTriangle(front, Vec3(40.0), 0.25, 9);
  EXPECT_EQ(front.popBase(), small);
  for (std::size_t i = 0; i < outer + inner; ++i) {
    const NodeTriple nodes = front.face(front.popBase()).nodes;
    ASSERT_EQ(front.layer(nodes[0]), i < outer ? 3 : 4);
  }
}

TEST(FrontOrder, ThePapersOrderIsBySizeAlone) {
  Front front(1.0, Vec3(0.0), FrontOrder::kSmallestFirst);
  std::mt19937 random(11);
  constexpr int kFaces = 500;
  for (int i = 0; i < kFaces; ++i) {
    const auto layer = static_cast<std::uint16_t>(random() % 5);
    const double size = 0.01 + static_cast<double>(random() % 100000) / 1000.0;
    addTriangle(front, Vec3(static_cast<double>(random() % 50)), size, layer);
  }
  float last = 0.0F;
  for (int i = 0; i < kFaces; ++i) {
    const float size = front.face(front.popBase()).size;
    ASSERT_GE(size, last);
    last = size;
  }
}

}  // namespace
}  // namespace tetrafront
