#include "optimize/locality.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "search/morton.h"
#include "tetrafront/vec3.h"

namespace tetrafront {
namespace {

std::vector<Vec3> centroidsOf(const VolumeMesh& mesh) {
  std::vector<Vec3> centroids(mesh.tetrahedra.size() / 4);
  for (std::size_t t = 0; t < centroids.size(); ++t) {
    Vec3 sum(0.0);
    for (std::size_t k = 0; k < 4; ++k) {
      const double* at = &mesh.points[3 * std::size_t{mesh.tetrahedra[4 * t + k]}];
      sum += Vec3(at[0], at[1], at[2]);
    }
    centroids[t] = sum * 0.25;
  }
  return centroids;
}

}  // namespace

VolumeMesh alongMortonCurve(const VolumeMesh& mesh, std::size_t boundaryNodes) {
  constexpr std::uint32_t kNone = 0xffffffffU;
  const std::vector<std::uint32_t> order = mortonOrder(centroidsOf(mesh));
  std::vector<std::uint32_t> newId(mesh.points.size() / 3, kNone);
  std::iota(newId.begin(), newId.begin() + static_cast<std::ptrdiff_t>(boundaryNodes), 0U);
  VolumeMesh ordered;
  ordered.front = mesh.front;
  ordered.points.reserve(mesh.points.size());
  ordered.points.assign(mesh.points.begin(),
                        mesh.points.begin() + static_cast<std::ptrdiff_t>(3 * boundaryNodes));
  ordered.tetrahedra.reserve(mesh.tetrahedra.size());
  ordered.regions.reserve(mesh.regions.size());
  for (const std::uint32_t t : order) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t node = mesh.tetrahedra[4 * std::size_t{t} + k];
      if (newId[node] == kNone) {
        newId[node] = static_cast<std::uint32_t>(ordered.points.size() / 3);
        const double* at = &mesh.points[3 * node];
        ordered.points.insert(ordered.points.end(), at, at + 3);
      }
      ordered.tetrahedra.push_back(newId[node]);
    }
    ordered.regions.push_back(mesh.regions[t]);
  }
  return ordered;
}

}  // namespace tetrafront
