#pragma once

/// @file Element quality: volume, dihedral angles, radius ratio. For reports only; decides nothing.

#include <array>
#include <cstddef>
#include <cstdint>

#include "tetrafront/mesh.h"
#include "tetrafront/status.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Tangents that the dihedral measures compare with: 30 degrees, the smallest target angle, and 45
/// = 180 - 135, for the largest target angle 135.
inline constexpr double kSquaredTangentOfHalf30 = 0.07179676972449082;
inline constexpr double kSquaredTangentOfHalf45 = 0.17157287525380988;

struct TetrahedronMeasures {
  double volume = 0.0;         ///< positive if (b-a) x (c-a) . (d-a) > 0
  double radiusRatio = 0.0;    ///< 3 x inradius / circumradius, 1 if regular; 0 if flat or inverted
  double largestCosine = 0.0;  ///< cosine of the smallest dihedral angle
  double smallestCosine = 0.0;  ///< cosine of the largest dihedral angle
  /// Cosines of all six angles, between the faces opposite kCosineFaces[i] and kCosineFaces[j] for
  /// i < j, in lexical order.
  std::array<double, 6> cosines{};
};
inline constexpr std::array<std::size_t, 4> kCosineFaces{1, 2, 3, 0};

[[nodiscard]] TetrahedronMeasures measureTetrahedron(const Vec3& a, const Vec3& b, const Vec3& c,
                                                     const Vec3& d);
[[nodiscard]] inline TetrahedronMeasures measureTetrahedron(const std::array<Vec3, 4>& corners) {
  return measureTetrahedron(corners[0], corners[1], corners[2], corners[3]);
}

/// Returns 2 x inradius / circumradius: 1 if equilateral, 0 if two corners coincide.
[[nodiscard]] double triangleRadiusRatio(const Vec3& a, const Vec3& b, const Vec3& c);

/// Returns the angle in degrees, even if rounding moved its cosine beyond 1. For reports only: the
/// arc cosine differs between libraries.
[[nodiscard]] double degreesOf(double cosine);

/// Computes the QualitySummary of a mesh in slices.
class QualityMeter {
 public:
  /// Adds tetrahedra [first, last) of the mesh. About 0.1 µs each.
  void add(const VolumeMesh& mesh, std::size_t first, std::size_t last);

  void add(const TetrahedronMeasures& measures);

  /// Returns the summary; all zero if nothing was added.
  [[nodiscard]] QualitySummary summary() const;

 private:
  std::size_t count_ = 0;
  double volume_ = 0.0;
  double sumOfRatios_ = 0.0;
  double minRatio_ = 1.0;
  double largestCosine_ = -1.0;
  double smallestCosine_ = 1.0;
};

[[nodiscard]] QualitySummary measureQuality(const VolumeMesh& mesh);

}  // namespace tetrafront
