// Random patches of all types: every front closes, and the triangles have the target shapes and lengths
// unless the boundary determines them.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/models.h"
#include "support/patch_family.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "surface/surface_mesher.h"

namespace tetrafront::testing {
namespace {

constexpr std::uint64_t kMembersPerType = 24;

class SurfacePatchFamily : public ::testing::TestWithParam<PatchType> {};

TEST_P(SurfacePatchFamily, ClosesWithGoodTrianglesOfTheTargetSize) {
  for (std::uint64_t seed = 0; seed < kMembersPerType; ++seed) {
    SCOPED_TRACE(seed);
    const FamilyMember member = patchOfFamily(GetParam(), seed);
    ASSERT_GT(member.size, 0.0);
    const SizeField field = SizeField::uniform(member.size);
    SurfaceMesher mesher(member.model, field);
    MeshStatus status = MeshStatus::kRunning;
    while (status == MeshStatus::kRunning) status = mesher.advance(1000);
    ASSERT_EQ(status, MeshStatus::kDone);
    const SurfaceMesh mesh = mesher.takeMesh();
    const PatchQuality quality = measureQuality(mesh, member.size);
    EXPECT_TRUE(quality.closed);
    EXPECT_EQ(measure(mesh, field).eulerCharacteristic(),
              2 - static_cast<long>(member.model.patches.front().loops.size()));
    EXPECT_GE(quality.minAngle, 20.0);
    EXPECT_GE(quality.meanRadiusRatio, 0.93);
    EXPECT_NEAR(quality.meanEdge, 1.0, 0.1);
    // Few triangles may be determined by the boundary, or the other statistics would mean little.
    EXPECT_LE(quality.forced, 4 + triangleCount(mesh) / 20);
  }
}

std::string nameOf(const ::testing::TestParamInfo<PatchType>& type) {
  switch (type.param) {
    case PatchType::kPlanar:
      return "Planar";
    case PatchType::kIsoparametricTriangle:
      return "IsoparametricTriangle";
    case PatchType::kSerendipity:
      return "Serendipity";
    case PatchType::kBarnhillGregoryNielson:
      return "BarnhillGregoryNielson";
    case PatchType::kTube:
      return "Tube";
    case PatchType::kGregory:
    case PatchType::kNielson:
    case PatchType::kLoft:
    case PatchType::kCoons:
      break;
  }
  return "Coons";
}

INSTANTIATE_TEST_SUITE_P(EveryType, SurfacePatchFamily,
                         ::testing::Values(PatchType::kPlanar, PatchType::kIsoparametricTriangle,
                                           PatchType::kSerendipity,
                                           PatchType::kBarnhillGregoryNielson, PatchType::kCoons),
                         nameOf);

/// A patch between two parabolas that leave one point in the same direction.
Model tangentCusp() {
  ModelBuilder builder;
  const Vec3 a(0, 0, 0);
  const Vec3 b(2, -0.4, 0);
  const Vec3 c(2.2, 0, 0);
  const Vec3 d(2, 0.4, 0);
  const std::uint32_t low = builder.line(LineType::kParabolic, {a, {1, -0.1, 0}, b});
  const std::uint32_t high = builder.line(LineType::kParabolic, {a, {1, 0.1, 0}, d});
  builder.patch(PatchType::kCoons,
                {{{low, false}, builder.straight(b, c), builder.straight(c, d), {high, true}}});
  return std::move(builder.model);
}

TEST(SurfacePatchQuality, CuspAffectsOnlyTheTrianglesAtItsTip) {
  const Model model = tangentCusp();
  for (const double size : {0.2, 0.06, 0.02}) {
    const SizeField field = SizeField::uniform(size);
    SurfaceMesher mesher(model, field);
    MeshStatus status = MeshStatus::kRunning;
    while (status == MeshStatus::kRunning) status = mesher.advance(1000);
    ASSERT_EQ(status, MeshStatus::kDone);
    const PatchQuality quality = measureQuality(mesher.takeMesh(), size);
    EXPECT_TRUE(quality.closed) << size;
    EXPECT_GE(quality.minAngle, 20.0) << size;
  }
}

}  // namespace
}  // namespace tetrafront::testing
