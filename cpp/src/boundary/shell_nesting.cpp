#include "boundary/shell_nesting.h"

#include <array>
#include <cmath>
#include <limits>

#include "base/sort.h"
#include "geom/predicates.h"
#include "boundary/surface_access.h"
#include "boundary/half_faces.h"

namespace tetrafront {
namespace {

constexpr std::uint32_t kNoComponent = 0xffffffffU;
constexpr std::uint32_t kSeveralComponents = 0xfffffffeU;

/// A volume below this share of the sum of its terms' magnitudes is rounding.
constexpr double kVolumeRounding = 1e-14;

/// A sum that carries its rounding errors along (Neumaier 1974).
class CarefulSum {
 public:
  void add(double value) {
    const double sum = sum_ + value;
    error_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
    sum_ = sum;
  }
  [[nodiscard]] double value() const { return sum_ + error_; }

 private:
  double sum_ = 0.0;
  double error_ = 0.0;
};

Vec3 magnitudes(const Vec3& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// As glm::cross, but all products added up.
Vec3 crossMagnitudes(const Vec3& a, const Vec3& b) {
  return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
}

Vec2 alongX(const Vec3& v) { return {v.y, v.z}; }

}  // namespace

std::vector<Shell> measureShells(const SurfaceMesh& mesh, std::span<const std::uint32_t> shellOf) {
  std::vector<Shell> shells;
  std::vector<CarefulSum> volumes;
  std::vector<double> magnitude;
  for (std::uint32_t side = 0; side < shellOf.size(); ++side) {
    const std::uint32_t s = shellOf[side];
    if (s == shells.size()) {
      shells.push_back({side, 0.0, false});
      volumes.emplace_back();
      magnitude.push_back(0.0);
    }
    const std::uint32_t t = triangleOf(side);
    const Vec3 origin = cornersOf(mesh, triangleOf(shells[s].firstHalfFace))[0];
    const std::array<Vec3, 3> p = cornersOf(mesh, t);
    // With edges in place of the corners, so that small triangles far from the origin round little.
    const Vec3 a = p[0] - origin;
    const Vec3 b = p[1] - p[0];
    const Vec3 c = p[2] - p[0];
    const double sixVolumes = glm::dot(a, glm::cross(b, c));
    volumes[s].add(side == backOf(t) ? sixVolumes : -sixVolumes);
    magnitude[s] += glm::dot(magnitudes(a), crossMagnitudes(magnitudes(b), magnitudes(c)));
  }
  for (std::size_t s = 0; s < shells.size(); ++s) {
    shells[s].volume = volumes[s].value() / 6.0;
    shells[s].isFlat = std::fabs(volumes[s].value()) <= kVolumeRounding * magnitude[s];
  }
  return shells;
}

ShellNesting::ShellNesting(const SurfaceMesh& mesh, std::span<const std::uint32_t> componentOf,
                           std::size_t componentCount, std::span<const std::uint32_t> shellOf,
                           const BoxTree& tree)
    : mesh_(mesh),
      componentOf_(componentOf),
      shellOf_(shellOf),
      tree_(tree),
      start_(componentCount) {
  std::vector<std::uint32_t> componentOfNode(mesh.points.size() / 3, kNoComponent);
  for (std::size_t h = 0; h < mesh.triangles.size(); ++h) {
    std::uint32_t& part = componentOfNode[mesh.triangles[h]];
    part = part == kNoComponent || part == componentOf[h / 3] ? componentOf[h / 3]
                                                              : kSeveralComponents;
  }
  std::vector<std::uint8_t> hasStart(componentCount, 0);
  for (std::uint32_t t = 0; t < componentOf.size(); ++t) {
    if (hasStart[componentOf[t]] != 0) continue;
    const std::array<Vec3, 3> p = cornersOf(mesh, t);
    start_[componentOf[t]] = (p[0] + p[1] + p[2]) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (componentOfNode[mesh.triangles[3 * std::size_t{t} + k]] != componentOf[t]) continue;
      start_[componentOf[t]] = p[k];
      hasStart[componentOf[t]] = 1;
    }
  }
}

std::vector<std::uint32_t> ShellNesting::around(std::uint32_t part) const {
  const Vec3& place = start_[part];
  Box ray = Box::of(place, place, place);
  ray.high[0] = std::numeric_limits<float>::max();
  std::vector<std::uint32_t> crossed;
  tree_.visitOverlaps(ray, [&](std::uint32_t t) {
    if (componentOf_[t] == part || !isAheadOf(place, t)) return;
    crossed.push_back(shellOf_[backOf(t)]);
    crossed.push_back(shellOf_[frontOf(t)]);
  });
  stableSort(crossed);
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0, j = 0; i < crossed.size(); i = j) {
    while (j < crossed.size() && crossed[j] == crossed[i]) ++j;
    if ((j - i) % 2 == 1) result.push_back(crossed[i]);
  }
  return result;
}

/// Does the ray from `place` along x pass through the triangle? Where it would meet an edge or a
/// node, it is moved by less than anything, the same way for all triangles: the z of `place`
/// counts as higher than any equal one, and its y as lower.
bool ShellNesting::isAheadOf(const Vec3& place, std::uint32_t triangle) const {
  const std::array<Vec3, 3> p = cornersOf(mesh_, triangle);
  bool isInside = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3* low = &p[k];
    const Vec3* high = &p[(k + 1) % 3];
    if (low->z > high->z) std::swap(low, high);
    if (low->z > place.z || high->z <= place.z) continue;
    if (orient2d(alongX(*low), alongX(*high), alongX(place)) > 0) isInside = !isInside;
  }
  if (!isInside) return false;
  const int facing = orient2d(alongX(p[0]), alongX(p[1]), alongX(p[2]));
  return orient3d(p[0], p[1], p[2], place) * facing < 0;
}

}  // namespace tetrafront
