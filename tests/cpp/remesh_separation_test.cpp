/// Quick proofs that triangles do not intersect, against exact tests.

#include "remesh/separation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "geom/intersect.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

constexpr std::uint32_t kCentre = 100;

/// Returns a fan around the origin, through points at these angles, in degrees, of a circle.
std::vector<NumberedTriangle> fan(const std::vector<double>& angles, bool isClosed,
                                  double roughness, Random& random) {
  std::vector<Vec3> points;
  for (const double degrees : angles) {
    const double angle = degrees * std::numbers::pi / 180.0;
    points.push_back(Vec3(std::cos(angle), std::sin(angle), 0.0) + random.inBox(roughness));
  }
  std::vector<NumberedTriangle> triangles;
  const std::size_t count = angles.size();
  for (std::size_t i = 0; i + (isClosed ? 0 : 1) < count; ++i) {
    const std::size_t next = (i + 1) % count;
    triangles.push_back({{kCentre, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(next)},
                         {Vec3(0.0), points[i], points[next]}});
  }
  return triangles;
}

bool anyIntersect(const std::vector<NumberedTriangle>& triangles) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (intersectImproperly(triangles[i], triangles[j])) return true;
    }
  }
  return false;
}

TEST(Separation, ProvesFansThatGoAroundOnceAtMost) {
  Random random(5);
  SeparationProof proof;
  const std::vector<std::vector<double>> closed{{0, 120, 240}, {0, 50, 130, 200, 290}};
  for (const std::vector<double>& angles : closed) {
    const auto triangles = fan(angles, true, 0.1, random);
    proof.begin(triangles);
    EXPECT_TRUE(proof.areApart());
  }
  const auto open = fan({10, 80, 170, 250, 340}, false, 0.1, random);
  proof.begin(open);
  EXPECT_TRUE(proof.areApart());
}

TEST(Separation, ProvesNothingForFansThatOverlap) {
  Random random(6);
  SeparationProof proof;
  // Twice around; more than once around; a slit that is closed; an edge that turns back.
  const auto twice = fan({0, 120, 240, 370, 490, 610}, true, 0.0, random);
  const auto more = fan({0, 120, 240, 350, 370}, false, 0.0, random);
  auto slit = fan({0, 120, 240, 360}, false, 0.0, random);
  slit.back().corners[2] = slit.front().corners[1];
  const auto back = fan({0, 120, 90, 240}, true, 0.0, random);
  for (const auto& triangles : {twice, more, slit, back}) {
    ASSERT_TRUE(anyIntersect(triangles));
    proof.begin(triangles);
    EXPECT_FALSE(proof.areApart());
  }
}

TEST(Separation, NeverContradictsTheExactTests) {
  Random random(7);
  SeparationProof proof;
  std::size_t proven = 0;
  std::size_t provenApart = 0;
  std::size_t intersecting = 0;
  for (int i = 0; i < 20'000; ++i) {
    // Flat fans, rough ones, and fans that are nearly flat up to rounding in an oblique plane.
    constexpr std::array<double, 4> kRoughness{0.0, 1e-16, 0.3, 1.5};
    const auto triangles = fan({0, 70, 140, 220, 290}, i % 3 != 0,
                               kRoughness[static_cast<std::size_t>(i % 4)], random);
    proof.begin(triangles);
    if (proof.areApart()) {
      ++proven;
      ASSERT_FALSE(anyIntersect(triangles));
    }
    // A triangle that shares none, one or two nodes with the fan.
    const std::size_t shared = static_cast<std::size_t>(i) % 3;
    const NumberedTriangle& first = triangles[1];
    NumberedTriangle other{{200, 201, 202},
                           {random.inBox(2.0), random.inBox(2.0), random.inBox(2.0)}};
    if (i % 2 == 0) {
      for (Vec3& corner : other.corners) corner.z *= i % 4 == 0 ? 0.0 : 1e-15;
    }
    for (std::size_t k = 1; k <= shared; ++k) {
      other.nodes[k] = first.nodes[k];
      other.corners[k] = first.corners[k];
    }
    bool intersects = false;
    for (const NumberedTriangle& triangle : triangles)
      intersects = intersects || intersectImproperly(triangle, other);
    if (intersects) ++intersecting;
    if (!proof.isApart(other)) continue;
    ++provenApart;
    ASSERT_FALSE(intersects) << i;
  }
  EXPECT_GT(proven, 5'000U);
  EXPECT_GT(provenApart, 1'000U);
  EXPECT_GT(intersecting, 3'000U);
}

}  // namespace
}  // namespace tetrafront::testing
