#include "surface/expected_count.h"

#include <array>
#include <cstdint>

#include "surface/surface_access.h"

namespace tetrafront {
namespace {

constexpr int kSamplesPerAxis = 12;

/// Mean over a lattice of samples in the box of how many unit tetrahedra's volume fits into H's.
double meanDensity(const Vec3& low, const Vec3& high, const SizeField& field) {
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

double enclosedVolume(const SurfaceMesh& surface) {
  const Vec3 origin = pointOf(surface, 0);
  double sixVolumes = 0.0;
  for (std::uint32_t t = 0; 3 * std::size_t{t} + 2 < surface.triangles.size(); ++t) {
    const std::array<Vec3, 3> corners = cornersOf(surface, t);
    sixVolumes +=
        glm::dot(corners[0] - origin, glm::cross(corners[1] - origin, corners[2] - origin));
  }
  return sixVolumes / 6.0;
}

}  // namespace

double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field) {
  Vec3 low = pointOf(surface, 0);
  Vec3 high = low;
  for (std::uint32_t node = 1; 3 * std::size_t{node} < surface.points.size(); ++node) {
    low = glm::min(low, pointOf(surface, node));
    high = glm::max(high, pointOf(surface, node));
  }
  return enclosedVolume(surface) * meanDensity(low, high, field);
}

double tetrahedraInBoxOf(const Model& model, const SizeField& field) {
  Vec3 low = model.points.front();
  Vec3 high = low;
  for (const Vec3& point : model.points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const Vec3 extent = high - low;
  return extent.x * extent.y * extent.z * meanDensity(low, high, field);
}

}  // namespace tetrafront
