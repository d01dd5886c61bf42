#pragma once

/// @file The model with its curves built, once for everybody.
///
/// A curve is built in the line's canonical direction, from the end point with the lower position
/// to the other (of a closed line, towards the lower one of the two points next to that end), so
/// that drawing a line the other way round moves no node, not even by rounding.

#include <cstdint>
#include <span>
#include <vector>

#include "model/curve.h"
#include "tetrafront/model.h"

namespace tetrafront {

class ResolvedModel {
 public:
  /// `model` must have passed diagnoseModel() and must outlive this.
  explicit ResolvedModel(const Model& model);

  /// For a model that may have faults: lines with usableLines[line] == 0 get a stand-in, which
  /// nobody must ask for.
  ResolvedModel(const Model& model, std::span<const std::uint8_t> usableLines);

  [[nodiscard]] const Model& model() const { return *model_; }

  /// In the canonical direction.
  [[nodiscard]] const Curve& curve(std::uint32_t line) const { return curves_[line]; }

  /// True if the curve runs against the line as drawn.
  [[nodiscard]] bool flipped(std::uint32_t line) const { return flipped_[line] != 0; }

  /// As a loop walks it.
  [[nodiscard]] OrientedCurve curve(const OrientedLine& line) const {
    return {curves_[line.line], line.reversed != flipped(line.line)};
  }

  /// First and last point as a loop walks the line; positions in Model::points.
  [[nodiscard]] std::uint32_t startPoint(const OrientedLine& line) const;
  [[nodiscard]] std::uint32_t endPoint(const OrientedLine& line) const;

 private:
  const Model* model_;
  std::vector<Curve> curves_;
  std::vector<std::uint8_t> flipped_;
};

/// The coordinates of a line's points, in its own direction. All positions must exist.
[[nodiscard]] std::vector<Vec3> pointsOf(const Model& model, const Line& line);

}  // namespace tetrafront
