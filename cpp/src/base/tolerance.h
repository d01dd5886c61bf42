#pragma once

/// @file The two relative tolerances of the engine. Signs that decide topology are exact (geom/predicates.h) and use
/// none. A tolerance decides what drawn geometry means where it is not exact by nature: coordinates come rounded
/// from files and dialogs, and points on curves from sums and roots. Each use says why it may be inexact.

namespace tetrafront {

/// Lengths below which differences do not count, relative to the box around what is compared: the model for its
/// points, else one patch or line.
class Tolerance {
 public:
  /// Rounding, relative to the numbers compared. Above the error of some thousand operations; a side this short
  /// could not be told from none.
  static constexpr double kRounding = 1e-12;
  /// Geometry that is nearer than this is drawn as the same: far above the rounding of coordinates, far below the
  /// size of any element.
  static constexpr double kCoincidence = 1e-9;

  /// `extent`: length of the diagonal of the box, or of the line.
  constexpr explicit Tolerance(double extent) : extent_(extent) {}

  /// Positions closer than this are one position.
  [[nodiscard]] constexpr double rounding() const { return kRounding * extent_; }
  /// Lines and sides closer than this touch or coincide.
  [[nodiscard]] constexpr double coincidence() const { return kCoincidence * extent_; }
  /// A surface with less area than this is degenerate.
  [[nodiscard]] constexpr double area() const { return kCoincidence * extent_ * extent_; }

 private:
  double extent_;
};

}  // namespace tetrafront
