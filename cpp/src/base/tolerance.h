#pragma once

/// @file The relative tolerances of the engine. Exact signs decide topology, without a tolerance
/// (geom/predicates.h). A tolerance decides what drawn geometry means where coordinates are rounded: in files and
/// dialogs, or by the evaluation of a curve.
///
/// Constants with another meaning stand beside their use, each with a name that says what it limits: accuracies that
/// a user may expect (kPlaneTolerance), error bounds of one computation (kVolumeRounding) and stop criteria.

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Lengths below which differences do not count, relative to the extent of what is compared.
class Tolerance {
 public:
  /// Bounds the rounding error of some thousand operations, relative to the numbers compared.
  static constexpr double kRounding = 1e-12;
  /// Geometry closer than this counts as coincident: far above the rounding of coordinates, far
  /// below the size of any element.
  static constexpr double kCoincidence = 1e-9;

  /// What counts as equal after a rounding to single precision, which has about 7 digits: a part of the coordinates and a part of
  /// the diagonal.
  static constexpr double kSinglePerCoordinate = 2e-7;
  static constexpr double kSinglePerDiagonal = 1e-6;
  /// Returns the distance within which positions count as equal in a surface that was rounded to single precision. `diagonal`
  /// of the surface, and its largest `coordinate`.
  static constexpr double ofSingle(double diagonal, double coordinate) {
    return kSinglePerDiagonal * diagonal + kSinglePerCoordinate * coordinate;
  }

  /// `extent`: length of a line, or diagonal of the box around what is compared.
  constexpr explicit Tolerance(double extent) : extent_(extent) {}

  /// Tolerance of a model, patch or line in a box, which may have no volume.
  static Tolerance ofBox(const Vec3& low, const Vec3& high) {
    return Tolerance(glm::length(high - low));
  }

  /// Positions closer than this are one position: a side between them would be of the size of rounding errors.
  [[nodiscard]] constexpr double rounding() const { return kRounding * extent_; }
  /// Lines and sides closer than this touch or coincide.
  [[nodiscard]] constexpr double coincidence() const { return kCoincidence * extent_; }
  /// A surface with a smaller area is degenerate.
  [[nodiscard]] constexpr double area() const { return kCoincidence * extent_ * extent_; }

 private:
  double extent_;
};

}  // namespace tetrafront
