#include "sizing/expected_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geom/measure.h"
#include "sizing/column_samples.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

constexpr int kSamplesPerAxis = 12;
/// Elements / triangles of the boundary in a mesh without interior nodes: at least, and in a layer one element thick.
constexpr double kTetrahedraPerTriangle = 0.5;
constexpr double kTetrahedraPerLayerTriangle = 1.48;
/// Square root of the number of triangles up to which a body is no layer.
constexpr double kLayerSides = 2.0;

/// Returns about how many elements a boundary of this many triangles has at least.
double leastTetrahedra(double triangles) {
  const double inLayer = 1.0 - kLayerSides / std::sqrt(std::max(1.0, triangles));
  return triangles * std::max(kTetrahedraPerTriangle, kTetrahedraPerLayerTriangle * inLayer);
}

/// Calls visit(triangle, six times the volume of its cone from a point of the surface) for each triangle.
template <class Visit>
void forEachCone(const SurfaceMesh& surface, Visit visit) {
  // The first node may be unused and far away: take a node of a triangle.
  const Vec3 origin = pointOf(surface, NodeId(surface.triangles.front()));
  for (std::uint32_t t = 0; 3 * std::size_t{t} + 2 < surface.triangles.size(); ++t) {
    const auto [a, b, c] = cornersOf(surface, TriangleId(t));
    visit(t, sixVolumesBelow(origin, a, b, c));
  }
}

}  // namespace

double enclosedVolume(const SurfaceMesh& surface) {
  double sixVolumes = 0.0;
  forEachCone(surface, [&](std::uint32_t t, double sixVolume) {
    if (!surface.isInterface(t)) sixVolumes += sixVolume;
  });
  return sixVolumes / 6.0;
}

double minTetrahedra(const SurfaceMesh& surface, double maxVolume,
                     std::span<const double> ofRegions) {
  // The regions without a limit of their own share the last entry.
  std::vector<double> sixVolumes(ofRegions.size() + 1, 0.0);
  const auto entryOf = [&](std::uint32_t region) -> double& {
    return sixVolumes[std::min<std::size_t>(region, ofRegions.size())];
  };
  forEachCone(surface, [&](std::uint32_t t, double sixVolume) {
    if (surface.triangleRegions.empty()) {
      sixVolumes.back() += sixVolume;
      return;
    }
    const std::uint32_t back = surface.triangleRegions[2 * std::size_t{t}];
    const std::uint32_t front = surface.triangleRegions[2 * std::size_t{t} + 1];
    if (back != SurfaceMesh::kNoRegion) entryOf(back) += sixVolume;
    if (front != SurfaceMesh::kNoRegion) entryOf(front) -= sixVolume;
  });
  double count = 0.0;
  for (std::size_t r = 0; r < sixVolumes.size(); ++r) {
    double limit = r < ofRegions.size() ? ofRegions[r] : 0.0;
    if (!(limit > 0.0) || (maxVolume > 0.0 && maxVolume < limit)) limit = maxVolume;
    if (limit > 0.0) count += std::max(0.0, sixVolumes[r]) / 6.0 / limit;
  }
  return count;
}

double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field) {
  return expectedTetrahedra(surface, field, static_cast<double>(surface.triangles.size()) / 3.0);
}

double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field, double triangles) {
  const double least = leastTetrahedra(triangles);
  const double within = tetrahedraWithin(enclosedVolume(surface), surface, field);
  return within > least || std::isnan(within) ? within : least;
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
