#pragma once

/// @file How good the elements are: volume, dihedral angles, radius ratio. For reports; nothing
/// here decides anything.

#include <array>
#include <cstddef>
#include <cstdint>

#include "tetrafront/mesh.h"
#include "tetrafront/status.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// What measures by tangents compare dihedral angles with: 30 degrees, the least angle wanted, and
/// 45 = 180 - 135, 135 being the greatest.
inline constexpr double kSquaredTangentOfHalf30 = 0.07179676972449082;
inline constexpr double kSquaredTangentOfHalf45 = 0.17157287525380988;

struct TetrahedronMeasures {
  double volume = 0.0;         ///< positive if (b-a) x (c-a) . (d-a) > 0
  double radiusRatio = 0.0;    ///< 3 x inradius / circumradius, 1 if regular; 0 if flat or inverted
  double largestCosine = 0.0;  ///< of the dihedral angles: the smallest angle's
  double smallestCosine = 0.0;  ///< the largest angle's
  /// Of all six, between the faces opposite kCosineFaces[i] and kCosineFaces[j] for i < j, in
  /// lexical order.
  std::array<double, 6> cosines{};
};
inline constexpr std::array<std::size_t, 4> kCosineFaces{1, 2, 3, 0};

[[nodiscard]] TetrahedronMeasures measureTetrahedron(const Vec3& a, const Vec3& b, const Vec3& c,
                                                     const Vec3& d);

/// 2 x inradius / circumradius, 1 if equilateral; 0 if two corners are at one place.
[[nodiscard]] double triangleRadiusRatio(const Vec3& a, const Vec3& b, const Vec3& c);

/// The angle, also where rounding took its cosine beyond 1. It must only ever reach a report: the
/// arc cosine differs from library to library.
[[nodiscard]] double degreesOf(double cosine);

/// Gathers the QualitySummary of a mesh in slices.
class QualityMeter {
 public:
  /// Adds tetrahedra [first, last) of the mesh. About 0.1 µs each.
  void add(const VolumeMesh& mesh, std::size_t first, std::size_t last);

  void add(const TetrahedronMeasures& measures);

  /// All zero if nothing was added.
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
