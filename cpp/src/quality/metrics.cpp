#include "quality/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/ids.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// A radius ratio is at most 1, and rounding adds a few 1e-16 to that of a well-shaped element. A value above this is
/// nothing but rounding.
constexpr double kMaxRoundedRatio = 1.0 + 1e-9;

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

}  // namespace

double triangleRadiusRatio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<double, 3> edges{length(c - b), length(a - c), length(b - a)};
  const double product = edges[0] * edges[1] * edges[2];
  if (!(product > 0.0)) return 0.0;
  // r = 2 A / perimeter and R = product / (4 A).
  const Vec3 normal = glm::cross(b - a, c - a);
  return 4.0 * glm::dot(normal, normal) / (product * (edges[0] + edges[1] + edges[2]));
}

double degreesOf(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * (180.0 / std::numbers::pi);
}

TetrahedronMeasures measureTetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  // Outward normals of the faces opposite to b, c, d and a; their lengths are twice the areas.
  const Vec3 vw = glm::cross(v, w);
  const Vec3 wu = glm::cross(w, u);
  const Vec3 uv = glm::cross(u, v);
  const std::array<Vec3, 4> normals{-vw, -wu, -uv, vw + wu + uv};
  std::array<double, 4> lengths;
  for (std::size_t i = 0; i < 4; ++i) lengths[i] = length(normals[i]);

  TetrahedronMeasures measures;
  const double det = glm::dot(u, vw);
  measures.volume = det / 6.0;
  measures.largestCosine = -1.0;
  measures.smallestCosine = 1.0;
  std::size_t pair = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double product = lengths[i] * lengths[j];
      // The angle between two faces is the angle between one normal and the other one reversed.
      const double cosine = product > 0.0 ? -glm::dot(normals[i], normals[j]) / product : 1.0;
      measures.cosines[pair++] = cosine;
      measures.largestCosine = std::max(measures.largestCosine, cosine);
      measures.smallestCosine = std::min(measures.smallestCosine, cosine);
    }
  }
  // Inradius = det / sum of lengths; circumradius = |k| / (2 det).
  const Vec3 k = glm::dot(u, u) * vw + glm::dot(v, v) * wu + glm::dot(w, w) * uv;
  const double denominator = (lengths[0] + lengths[1] + lengths[2] + lengths[3]) * length(k);
  if (det > 0.0 && denominator > 0.0) measures.radiusRatio = 6.0 * det * det / denominator;
  // If an element is nearly flat, its volume, or the vector to its circumcentre, may be nothing but rounding.
  if (measures.radiusRatio > kMaxRoundedRatio) measures.radiusRatio = 0.0;
  return measures;
}

void QualityMeter::add(const VolumeMesh& mesh, std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    const auto [a, b, c, d] = cornersOf(mesh, TetId(t));
    add(measureTetrahedron(a, b, c, d));
  }
}

void QualityMeter::add(const TetrahedronMeasures& measures) {
  ++count_;
  volume_ += measures.volume;
  sumOfRatios_ += measures.radiusRatio;
  minRatio_ = std::min(minRatio_, measures.radiusRatio);
  largestCosine_ = std::max(largestCosine_, measures.largestCosine);
  smallestCosine_ = std::min(smallestCosine_, measures.smallestCosine);
}

QualitySummary QualityMeter::summary() const {
  if (count_ == 0) return {};
  QualitySummary summary;
  summary.minDihedral = degreesOf(largestCosine_);
  summary.maxDihedral = degreesOf(smallestCosine_);
  summary.minRadiusRatio = minRatio_;
  summary.meanRadiusRatio = sumOfRatios_ / static_cast<double>(count_);
  summary.volume = volume_;
  return summary;
}

QualitySummary measureQuality(const VolumeMesh& mesh) {
  QualityMeter meter;
  meter.add(mesh, 0, countTetrahedra(mesh));
  return meter.summary();
}

}  // namespace tetrafront
