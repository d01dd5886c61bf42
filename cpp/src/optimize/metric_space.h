#pragma once

/// @file The space in which the optimizer measures shapes and lengths. Without stretching it is
/// plain space. In a stretched size field it is each element's own unit space: T = H^-1
/// (field/size_tensor.h), constant over the element, the mean of its corners' tensors. An element's
/// cost thus depends on its corners alone, and a sum of costs that fell stays lower. The operators
/// are compiled once for either space; plain space has no overhead.

#include <cmath>

#include "field/size_field.h"
#include "field/size_tensor.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct PlainSpace {
  static constexpr bool kIsStretched = false;
  /// Target at a node: the edge length.
  using Target = double;
  /// Frame in which an element is measured.
  struct Frame {};
  /// Map back from an element's unit space.
  struct Back {};

  static Target targetAt(const SizeField& field, const Vec3& position, FieldHint& hint) {
    return field.sizeAt(position, hint);
  }
  static Target meanOf(Target a, Target b) { return 0.5 * (a + b); }
  static Target meanOf(Target a, Target b, Target c, Target d) {
    return a * 0.25 + b * 0.25 + c * 0.25 + d * 0.25;
  }
  /// A vector in units of the target length.
  static Vec3 inTargetLengths(Target target, const Vec3& v) { return v * (1.0 / target); }
  static Vec3 toUnit(const Frame& /*frame*/, const Vec3& v) { return v; }
  static Vec3 toSpace(const Back& /*back*/, const Vec3& v) { return v; }
  static Back backFrom(const Frame& /*frame*/) { return {}; }
  static double relativeLength(const Vec3& edge, Target a, Target b) {
    return std::sqrt(glm::dot(edge, edge)) / meanOf(a, b);
  }

  /// Decides whether edges are longer than a multiple of the target length.
  class Limit {
   public:
    Limit(double most, Target a, Target b) : longest_(most * (a < b ? b : a)) {}
    [[nodiscard]] bool isExceededBy(const Vec3& edge) const {
      return std::sqrt(glm::dot(edge, edge)) > longest_;
    }

   private:
    double longest_;
  };
};

struct StretchedSpace {
  static constexpr bool kIsStretched = true;
  /// Target at a node: T.
  using Target = SymmetricTensor;
  /// Sum of T at the corners; the costs are independent of its scale.
  using Frame = SymmetricTensor;
  /// Inverse of a frame.
  using Back = SymmetricTensor;

  static Target targetAt(const SizeField& field, const Vec3& position, FieldHint& hint) {
    return field.tensorAt(position, hint).inverse();
  }
  static Target meanOf(const Target& a, const Target& b) {
    Target mean = a.scaledBy(0.5);
    mean.accumulate(b, 0.5);
    return mean;
  }
  static Target meanOf(const Target& a, const Target& b, const Target& c, const Target& d) {
    return frameOf(a, b, c, d).scaledBy(0.25);
  }
  static Frame frameOf(const Target& a, const Target& b, const Target& c, const Target& d) {
    Frame frame = a;
    frame.accumulate(b, 1.0);
    frame.accumulate(c, 1.0);
    frame.accumulate(d, 1.0);
    return frame;
  }
  static Vec3 inTargetLengths(const Target& target, const Vec3& v) { return target * v; }
  static Vec3 toUnit(const Frame& frame, const Vec3& v) { return frame * v; }
  static Vec3 toSpace(const Back& back, const Vec3& v) { return back * v; }
  static Back backFrom(const Frame& frame) { return frame.inverse(); }
  static double relativeLength(const Vec3& edge, const Target& a, const Target& b) {
    const Vec3 unit = meanOf(a, b) * edge;
    return std::sqrt(glm::dot(unit, unit));
  }

  class Limit {
   public:
    Limit(double most, const Target& a, const Target& b) : most_(most), toUnit_(meanOf(a, b)) {}
    [[nodiscard]] bool isExceededBy(const Vec3& edge) const {
      const Vec3 unit = toUnit_ * edge;
      return std::sqrt(glm::dot(unit, unit)) > most_;
    }

   private:
    double most_;
    SymmetricTensor toUnit_;
  };
};

}  // namespace tetrafront
