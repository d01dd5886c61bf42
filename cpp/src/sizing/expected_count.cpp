#include "sizing/expected_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sizing/column_samples.h"
#include "boundary/surface_access.h"

namespace tetrafront {
namespace {

constexpr int kSamplesPerAxis = 12;
/// Lower bound for a mesh without interior nodes: elements / triangles.
constexpr double kTetrahedraPerTriangle = 0.5;

}  // namespace

double enclosedVolume(const SurfaceMesh& surface) {
  // The first node may be unused and far away: take a node of a triangle.
  const Vec3 origin = pointOf(surface, NodeId(surface.triangles.front()));
  double sixVolumes = 0.0;
  for (std::uint32_t t = 0; 3 * std::size_t{t} + 2 < surface.triangles.size(); ++t) {
    if (surface.isInterface(t)) continue;
    const std::array<Vec3, 3> corners = cornersOf(surface, TriangleId(t));
    sixVolumes +=
        glm::dot(corners[0] - origin, glm::cross(corners[1] - origin, corners[2] - origin));
  }
  return sixVolumes / 6.0;
}

double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field) {
  const auto corners = static_cast<double>(surface.triangles.size());
  const double atTriangles = kTetrahedraPerTriangle * corners / 3.0;
  const double within = tetrahedraWithin(enclosedVolume(surface), surface, field);
  return within > atTriangles || std::isnan(within) ? within : atTriangles;
}

double tetrahedraWithin(double volume, const SurfaceMesh& surface, const SizeField& field) {
  return kTetrahedraPerUnitVolume * volume * ColumnSamples(surface, field).meanDensity();
}

double tetrahedraPerVolume(const Vec3& low, const Vec3& high, const SizeField& field) {
  double density = 0.0;
  FieldHint hint;
  for (int i = 0; i < kSamplesPerAxis; ++i) {
    for (int j = 0; j < kSamplesPerAxis; ++j) {
      for (int k = 0; k < kSamplesPerAxis; ++k) {
        const Vec3 part = (Vec3(i, j, k) + 0.5) * (1.0 / kSamplesPerAxis);
        density += 1.0 / field.tensorAt(low + part * (high - low), hint).determinant();
      }
    }
  }
  const double samples = kSamplesPerAxis * kSamplesPerAxis * kSamplesPerAxis;
  return kTetrahedraPerUnitVolume * density / samples;
}

}  // namespace tetrafront
