#pragma once

/// @file The loops of a trimmed face in the parameter plane of its surface.

#include <optional>
#include <vector>

#include "model/face_plane.h"
#include "tetrafront/trimmed_model.h"

namespace tetrafront {

/// A place where a loop is not closed in the parameter plane: the coedge `index` of loop `loop` does not begin where the
/// one before it ends.
struct OpenJunction {
  std::uint32_t loop = 0;
  std::uint32_t index = 0;
};

class FaceLoops {
 public:
  /// The references of the face must be valid. `model` must outlive this.
  FaceLoops(const TrimmedModel& model, const TrimmedFace& face);

  /// Loops without their degenerate edges; the indices below refer to them. Loops that have no other edges are left out.
  [[nodiscard]] const std::vector<std::vector<const Coedge*>>& loops() const { return loops_; }

  /// Returns (u, v) on a coedge at t of its edge, 0 to 1 (see EdgeCurve). `position` is the position in space there,
  /// which is projected if the coedge has no curve in the plane.
  [[nodiscard]] Vec2 parametersAt(std::size_t loop, std::size_t index, double t,
                                  const Vec3& position) const;

  [[nodiscard]] const ParameterBox& box() const { return box_; }
  [[nodiscard]] const PoleSides& poles() const { return poles_; }
  /// The first place at which a loop is open other than at a pole, if any.
  [[nodiscard]] const std::optional<OpenJunction>& open() const { return open_; }
  /// True if the front can mesh the face in a FacePlane: the loops are closed and their box is not empty.
  [[nodiscard]] bool isUsable() const;

 private:
  void sampleLoops();
  void project(std::size_t loop, std::size_t index, const Vec2* before);
  void checkJunctions();
  void addPole(const Vec2& from, const Vec2& to);

  const TrimmedModel* model_;
  const FaceSurface* surface_;
  std::vector<std::vector<const Coedge*>> loops_;
  /// Per coedge: (u, v) at equal steps of t in the direction of the loop.
  std::vector<std::vector<std::vector<Vec2>>> samples_;
  ParameterBox box_;
  PoleSides poles_;
  std::optional<OpenJunction> open_;
};

/// Returns the period of u and of v; 0 in a direction that is not periodic.
[[nodiscard]] Vec2 periodsOf(const FaceSurface& surface);

}  // namespace tetrafront
