#include "surface/expected_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "surface/column_samples.h"
#include "surface/model_sampling.h"
#include "surface/surface_access.h"

namespace tetrafront {
namespace {

constexpr int kSamplesPerAxis = 12;
/// Area of the equilateral triangle of edge 1.
constexpr double kUnitTriangle = 0.4330127018922193;
/// No element has more of the boundary's triangles.
constexpr double kTrianglesPerTetrahedron = 4.0;
/// Without nodes inside there are at least about half as many elements as triangles.
constexpr double kTetrahedraPerTriangle = 0.5;

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

}  // namespace

double enclosedVolume(const SurfaceMesh& surface) {
  // Not the first node, which may belong to no triangle and lie far away.
  const Vec3 origin = pointOf(surface, surface.triangles.front());
  double sixVolumes = 0.0;
  for (std::uint32_t t = 0; 3 * std::size_t{t} + 2 < surface.triangles.size(); ++t) {
    if (surface.isWall(t)) continue;
    const std::array<Vec3, 3> corners = cornersOf(surface, t);
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
  return meanDensity(low, high, field);
}

double tetrahedraAtTriangles(const ModelPreview& preview, const SizeField& field) {
  double triangles = 0.0;
  FieldHint hint;
  for (std::size_t t = 0; t < preview.patchTriangles.size() / 3; ++t) {
    std::array<Vec3, 3> corners;
    Vec3 centre(0.0);
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = sampleAt(preview.patchPoints, preview.patchTriangles[3 * t + k]);
      centre += corners[k] * (1.0 / 3.0);
      size = std::max(size, field.sizeAt(corners[k], hint));
    }
    size = std::max(size, field.sizeAt(centre, hint));
    const double twiceArea =
        glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    triangles += 0.5 * twiceArea / (kUnitTriangle * size * size);
  }
  return triangles / kTrianglesPerTetrahedron;
}

}  // namespace tetrafront
