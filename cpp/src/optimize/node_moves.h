#pragma once

/// @file Moves a free node within the cavity of its star so that the cost of its elements falls.

#include <array>
#include <cstdint>

#include "optimize/element_cost.h"
#include "optimize/tet_complex.h"

namespace tetrafront {

/// Outer faces of a star or cavity, as positions: an element is the apex and one of them. Each face
/// has the frame of its element, which does not change as the apex moves.
template <class Space = PlainSpace>
class Hollow {
 public:
  using Frame = typename Space::Frame;

  void clear() {
    size_ = 0;
    suspect_ = 0;
  }
  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Frame& frame = {}) {
    frames_[size_] = frame;
    faces_[size_++] = {a, b, c};
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const std::array<Vec3, 3>& face(std::size_t i) const { return faces_[i]; }
  [[nodiscard]] const Frame& frame(std::size_t i) const { return frames_[i]; }

  [[nodiscard]] double costOf(std::size_t i, const Vec3& apex,
                              const ElementCost<Space>& cost) const {
    return cost(apex, faces_[i][0], faces_[i][1], faces_[i][2], frames_[i]);
  }
  /// Slope at the apex of one element's dihedral cost.
  [[nodiscard]] typename ElementCost<Space>::Slope slopeOf(std::size_t i, const Vec3& apex,
                                                           const ElementCost<Space>& cost) const {
    return cost.slopeOf(apex, faces_[i][0], faces_[i][1], faces_[i][2], frames_[i]);
  }
  /// Cost of all elements together; kInvalidCost as soon as `bound` is reached.
  [[nodiscard]] double costAt(const Vec3& apex, const ElementCost<Space>& cost, double bound);
  /// Cost of one element at the apex of the last costAt() that stayed below its bound.
  [[nodiscard]] double lastCostOf(std::size_t i) const { return costs_[i]; }

  /// Mean distance from `apex` to the first corners, in the unit space of a frame.
  [[nodiscard]] double meanRadius(const Vec3& apex, const Frame& frame) const;

 private:
  std::array<std::array<Vec3, 3>, kMaxCavity> faces_;
  std::array<Frame, kMaxCavity> frames_;
  std::array<double, kMaxCavity> costs_;
  std::size_t size_ = 0;
  std::size_t suspect_ = 0;  ///< the element at which costAt() last reached its bound
};

/// Returns the mean of the elements' circumcentres, weighted by volume. It minimizes the error of
/// an optimal Delaunay triangulation (ODT).
template <class Space>
[[nodiscard]] Vec3 circumcentreMean(const Hollow<Space>& hollow, const Vec3& apex);

/// Makes a Newton step on the sum of e^power, power 1/2 or 1, from `apex`. Returns false if it does
/// not descend.
template <class Space>
[[nodiscard]] bool newtonStep(const Hollow<Space>& hollow, const Vec3& apex, bool squareRoot,
                              Vec3& step);

/// Moves `apex` against the gradients of the worst elements until their cost stops falling, at most
/// `steps` times. `worst` is the cost at the start. Returns whether it fell. `cost` must use the
/// dihedral measure, the only one with a known slope.
template <class Space>
bool lowerWorst(Hollow<Space>& hollow, const ElementCost<Space>& cost, int steps, Vec3& apex,
                double& worst);

/// Moves `apex` against the gradient of the sum of the costs' eighth powers. This sum is smooth
/// where the maximum is not, and it includes the elements behind the worst one: where nodes block
/// each other from lowering the worst one by one, it still descends. `cost` as for lowerWorst().
template <class Space>
bool lowerPowers(Hollow<Space>& hollow, const ElementCost<Space>& cost, int steps, Vec3& apex);

enum class MoveKind : std::uint8_t { kCircumcentres, kNewton, kLowerWorst, kLowerPowers };

template <class Space = PlainSpace>
class NodeMover {
 public:
  explicit NodeMover(TetComplex& complex) : complex_(complex) {}

  /// Moves a free node if that lowers its elements' cost. Returns whether it moved.
  bool improve(NodeId node, MoveKind kind, const ElementCost<Space>& cost);

 private:
  bool stepAlong(const Vec3& direction, const ElementCost<Space>& cost, double old, Vec3& position);
  void accept(NodeId node, const Vec3& position);

  TetComplex& complex_;
  Star star_;
  Hollow<Space> hollow_;
};

}  // namespace tetrafront
