#pragma once

/// @file The model with all its curves, built once.
///
/// A curve is built in the line's canonical direction: from the end point with the lower index to
/// the other (for a closed line, towards the lower of the two points next to that end). Reversing a
/// line therefore moves no node, not even by rounding.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "model/curve.h"
#include "tetrafront/model.h"

namespace tetrafront {

class ResolvedModel {
 public:
  /// `model` must be free of problems (diagnoseModel()) and must outlive this.
  explicit ResolvedModel(const Model& model);

  /// For a model that may have problems: lines with usableLines[line] == 0 get a placeholder, which
  /// must not be used.
  ResolvedModel(const Model& model, std::span<const std::uint8_t> usableLines);

  [[nodiscard]] const Model& model() const { return *model_; }

  /// Curve in the canonical direction.
  [[nodiscard]] const Curve& curve(LineId line) const { return curves_[line.index()]; }

  /// True if the canonical direction is opposite to the line as drawn.
  [[nodiscard]] bool isFlipped(LineId line) const { return flipped_[line.index()] != 0; }

  /// Curve in the direction of a loop.
  [[nodiscard]] OrientedCurve curve(const OrientedLine& line) const {
    return {curves_[line.line], line.reversed != isFlipped(LineId(line.line))};
  }

  /// First and last point of a line in the direction of a loop.
  [[nodiscard]] PointId startPoint(const OrientedLine& line) const;
  [[nodiscard]] PointId endPoint(const OrientedLine& line) const;

 private:
  const Model* model_;
  std::vector<Curve> curves_;
  std::vector<std::uint8_t> flipped_;
};

/// Returns the positions of a line's points, in its own direction. All indices must exist.
[[nodiscard]] std::vector<Vec3> pointsOf(const Model& model, const Line& line);

}  // namespace tetrafront
