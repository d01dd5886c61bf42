/// Size fields as bytes, and back.

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/bytes.h"
#include "field/grid_locator.h"
#include "field/size_field.h"
#include "field/size_octree.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/tet_grids.h"

namespace tetrafront::testing {
namespace {

SizeOctree octreeOf(const SurfaceMesh& mesh, double growth) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < nodeCount(mesh); ++i) points.push_back(pointOf(mesh, i));
  return {points, mesh.triangles, growth, 0.0};
}

std::vector<SizeSource> someSources() {
  Random random(71);
  std::vector<SizeSource> sources(20);
  for (SizeSource& source : sources) {
    source.points.fill(random.inBox(1.0));
    source.size = random.between(0.01, 0.1);
    source.distance = 0.1;
  }
  return sources;
}

/// With everything that a field can consist of.
SizeField octreeField() {
  SizeField field = SizeField::fromOctree(octreeOf(geodesicSphere(6), 0.3));
  field.addSources(someSources());
  field.capTo(octreeOf(geodesicSphere(9), 0.5));
  field.raiseTo(octreeOf(geodesicSphere(12), 0.1));
  field.capSizes(0.4, {0.0, 0.05});
  return field;
}

SizeField stretchedField(double second = 1.0) {
  BackgroundGrid grid = gridOf(cubeOfTetrahedra(4, 0.15, 7));
  for (BackgroundNode& node : grid.nodes) {
    node.size = 0.1 + 0.05 * node.position.x;
    node.stretching = 3.0;
    node.direction = node.position + Vec3(0.1);
    const Vec3 across = glm::cross(node.direction, Vec3(1.0, 2.0, -1.0));
    grid.secondStretchings.push_back({second, across});
  }
  return SizeField::fromGrid(GridLocator(grid));
}

std::vector<std::uint8_t> bytesOf(const SizeField& field) {
  ByteWriter writer;
  writer(field);
  return writer.take();
}

SizeField fieldOf(std::span<const std::uint8_t> bytes) {
  SizeField field = SizeField::uniform(7.0);
  ByteReader reader(bytes);
  reader(field);
  return field;
}

void expectSame(const SymmetricTensor& a, const SymmetricTensor& b) {
  EXPECT_EQ(a.xx, b.xx);
  EXPECT_EQ(a.yy, b.yy);
  EXPECT_EQ(a.zz, b.zz);
  EXPECT_EQ(a.xy, b.xy);
  EXPECT_EQ(a.xz, b.xz);
  EXPECT_EQ(a.yz, b.yz);
}

TEST(SizeFieldBytes, GiveTheSameSizesEverywhere) {
  Random random(72);
  for (const SizeField& field :
       {SizeField::uniform(0.3), octreeField(), stretchedField(), stretchedField(2.0)}) {
    const SizeField read = fieldOf(bytesOf(field));
    EXPECT_EQ(read.isStretched(), field.isStretched());
    EXPECT_EQ(read.isRaised(), field.isRaised());
    for (int i = 0; i < 1000; ++i) {
      const Vec3 position = random.inBox(1.3);
      const auto region = static_cast<std::uint32_t>(random.integer(0, 2));
      FieldHint hint{.region = region};
      FieldHint other{.region = region};
      EXPECT_EQ(read.sizeAt(position, hint), field.sizeAt(position, other));
      expectSame(read.tensorAt(position, hint), field.tensorAt(position, other));
      EXPECT_EQ(read.covers(position, hint), field.covers(position, other));
    }
  }
}

TEST(SizeFieldBytes, ThatAreCutAreRefused) {
  const std::vector<std::uint8_t> bytes = bytesOf(octreeField());
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{3}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_THROW(fieldOf(std::span(bytes).first(count)), std::out_of_range);
  }
}

}  // namespace
}  // namespace tetrafront::testing
