#include "boundary/shell_nesting.h"

#include <array>
#include <cmath>

#include "base/compensated_sum.h"
#include "base/sort.h"
#include "boundary/ray_crossing.h"
#include "geom/predicates.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// A volume is degenerate up to this share of the sum of the magnitudes of its terms. Summation errors stay below.
constexpr double kVolumeRounding = 1e-14;

Vec3 magnitudes(const Vec3& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// glm::cross with all products added.
Vec3 crossMagnitudes(const Vec3& a, const Vec3& b) {
  return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
}

Vec2 alongX(const Vec3& v) { return {v.y, v.z}; }

/// Returns for each node the component that it belongs to; none if it is unused or belongs to several.
std::vector<ComponentId> findNodeComponents(const SurfaceMesh& mesh,
                                            std::span<const ComponentId> componentOf) {
  std::vector<ComponentId> found(countNodes(mesh));
  std::vector<std::uint8_t> isShared(found.size(), 0);
  for (std::size_t h = 0; h < mesh.triangles.size(); ++h) {
    const std::uint32_t node = mesh.triangles[h];
    const ComponentId component = componentOf[h / 3];
    if (!found[node].isNone() && found[node] != component) isShared[node] = 1;
    found[node] = component;
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (isShared[i] != 0) found[i] = {};
  }
  return found;
}

}  // namespace

std::vector<Shell> measureShells(const SurfaceMesh& mesh, std::span<const ShellId> shellOf) {
  struct Sums {
    CompensatedSum volume;
    double magnitude = 0.0;
  };
  std::vector<Shell> shells;
  std::vector<Sums> sums;
  for (std::uint32_t h = 0; h < shellOf.size(); ++h) {
    const HalfFaceId halfFace(h);
    const std::size_t s = shellOf[h].index();
    if (s == shells.size()) {
      shells.push_back({.firstHalfFace = halfFace});
      sums.emplace_back();
    }
    const TriangleId triangle = triangleOf(halfFace);
    const Vec3 origin = cornersOf(mesh, triangleOf(shells[s].firstHalfFace))[0];
    const std::array<Vec3, 3> p = cornersOf(mesh, triangle);
    // Multiply edges instead of corners: small triangles far from the origin then lose little to rounding.
    const Vec3 a = p[0] - origin;
    const Vec3 b = p[1] - p[0];
    const Vec3 c = p[2] - p[0];
    const double sixVolumes = glm::dot(a, glm::cross(b, c));
    sums[s].volume.add(halfFace == backOf(triangle) ? sixVolumes : -sixVolumes);
    sums[s].magnitude += glm::dot(magnitudes(a), crossMagnitudes(magnitudes(b), magnitudes(c)));
  }
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const double sixVolumes = sums[s].volume.value();
    shells[s].volume = sixVolumes / 6.0;
    shells[s].isDegenerate = std::fabs(sixVolumes) <= kVolumeRounding * sums[s].magnitude;
  }
  return shells;
}

ShellNesting::ShellNesting(const SurfaceMesh& mesh, std::span<const ComponentId> componentOf,
                           std::size_t componentCount, std::span<const ShellId> shellOf,
                           const BoxTree& tree)
    : mesh_(mesh),
      componentOf_(componentOf),
      shellOf_(shellOf),
      tree_(tree),
      starts_(componentCount) {
  const std::vector<ComponentId> componentOfNode = findNodeComponents(mesh, componentOf);
  std::vector<std::uint8_t> isExact(componentCount, 0);
  for (std::uint32_t t = 0; t < componentOf.size(); ++t) {
    const std::size_t component = componentOf[t].index();
    if (isExact[component] != 0) continue;
    starts_[component] = centroidOf(cornersOf(mesh, TriangleId(t)));
    for (const NodeId node : nodesOf(mesh, TriangleId(t))) {
      if (componentOfNode[node.index()] != componentOf[t]) continue;
      starts_[component] = pointOf(mesh, node);
      isExact[component] = 1;
    }
  }
}

/// Calls visit(triangle) for the triangles of other components that the ray of the component crosses.
template <class Visit>
void ShellNesting::visitCrossed(ComponentId component, Visit visit) const {
  const Vec3& start = starts_[component.index()];
  tree_.visitOverlaps(boxOfRay(start), [&](std::uint32_t item) {
    const TriangleId triangle(item);
    if (componentOf_[item] != component && isAheadOf(mesh_, start, triangle)) visit(triangle);
  });
}

int ShellNesting::windingAround(ComponentId component) const {
  int winding = 0;
  visitCrossed(component, [&](TriangleId triangle) {
    const std::array<Vec3, 3> p = cornersOf(mesh_, triangle);
    winding += orient2d(alongX(p[0]), alongX(p[1]), alongX(p[2]));
  });
  return winding;
}

std::vector<ShellId> ShellNesting::shellsAround(ComponentId component) const {
  std::vector<ShellId> crossed;
  visitCrossed(component, [&](TriangleId triangle) {
    crossed.push_back(shellOf_[backOf(triangle).index()]);
    crossed.push_back(shellOf_[frontOf(triangle).index()]);
  });
  stableSort(crossed);
  std::vector<ShellId> result;
  for (std::size_t i = 0, j = 0; i < crossed.size(); i = j) {
    while (j < crossed.size() && crossed[j] == crossed[i]) ++j;
    if ((j - i) % 2 == 1) result.push_back(crossed[i]);
  }
  return result;
}

}  // namespace tetrafront
