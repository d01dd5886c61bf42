#include "support/given_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/slow_dihedral.h"
#include "tetrafront/mesher.h"

namespace tetrafront::testing {
namespace {

using Tetrahedron = std::array<Vec3, 4>;

double areaOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

/// 3 x inradius / circumradius; 0 for an element whose volume is hardly more than rounding. The circumradius is that of Crelle: 24 V R is the root of a product of sums of the
/// products of opposite edges.
double slowRadiusRatio(const Tetrahedron& at) {
  const double volume =
      std::fabs(glm::dot(glm::cross(at[1] - at[0], at[2] - at[0]), at[3] - at[0])) / 6.0;
  const double areas = areaOf(at[0], at[1], at[2]) + areaOf(at[0], at[1], at[3]) +
                       areaOf(at[0], at[2], at[3]) + areaOf(at[1], at[2], at[3]);
  const auto edge = [&](std::size_t i, std::size_t j) { return glm::length(at[j] - at[i]); };
  const double p = edge(0, 1) * edge(2, 3);
  const double q = edge(0, 2) * edge(1, 3);
  const double r = edge(0, 3) * edge(1, 2);
  const double product = (p + q + r) * (p + q - r) * (p + r - q) * (q + r - p);
  constexpr double kFlat = 1e-10;
  if (volume < kFlat * areas * std::sqrt(areas)) return 0.0;
  const double inradius = 3.0 * volume / areas;
  const double circumradius = std::sqrt(std::max(product, 0.0)) / (24.0 * volume);
  return 3.0 * inradius / circumradius;
}

/// Widens the range by the six dihedral angles of the element.
void widenBy(const Tetrahedron& at, double& least, double& greatest) {
  constexpr std::array<std::array<std::size_t, 4>, 6> kEdges{
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  for (const auto& [i, j, k, l] : kEdges) {
    const double angle = slowDihedral(at[i], at[j], at[k], at[l]);
    least = std::min(least, angle);
    greatest = std::max(greatest, angle);
  }
}

}  // namespace

VolumeMesh meshed(const SurfaceMesh& surface, const MeshOptions& options) {
  MeshRun run(surface.points, surface.triangles, options);
  while (run.advance(1U << 16U) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  return run.volume();
}

VolumeMesh meshOfFront(const SurfaceMesh& surface) {
  return meshed(surface,
                {.innerShells = InnerShells::kRegions, .optimization = Optimization::kNone});
}

VolumeMesh poorMesh(const SurfaceMesh& surface) {
  return meshed(surface, {.optimization = Optimization::kNone, .exactFillOnly = true});
}

MeshImprovement improved(const VolumeMesh& mesh, const std::vector<std::uint32_t>& kept,
                         const ImproveOptions& options) {
  MeshImprover improver(mesh.points, mesh.tetrahedra, mesh.regions, kept, options);
  while (!improver.advance(1U << 16U)) {
  }
  return improver.result();
}

Position positionOf(const std::vector<double>& points, std::uint32_t node) {
  const std::size_t i = 3 * std::size_t{node};
  return {points[i], points[i + 1], points[i + 2]};
}

SlowShapes slowShapesOf(const std::vector<double>& points,
                        const std::vector<std::uint32_t>& tetrahedra) {
  SlowShapes shapes;
  const std::size_t count = tetrahedra.size() / 4;
  for (std::size_t t = 0; t < count; ++t) {
    Tetrahedron at;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [x, y, z] = positionOf(points, tetrahedra[4 * t + k]);
      at[k] = Vec3(x, y, z);
    }
    double least = 180.0;
    double greatest = 0.0;
    widenBy(at, least, greatest);
    shapes.leastAngle = std::min(shapes.leastAngle, least);
    shapes.greatestAngle = std::max(shapes.greatestAngle, greatest);
    const double ratio = slowRadiusRatio(at);
    shapes.leastRatio = std::min(shapes.leastRatio, ratio);
    shapes.meanRatio += ratio / static_cast<double>(count);
    if (least < 30.0 || greatest > 135.0) shapes.shareOutside += 1.0 / static_cast<double>(count);
  }
  return shapes;
}

}  // namespace tetrafront::testing
