#pragma once

/// @file The intersection of two tetrahedra, as tetrahedra: one is clipped by the planes of the other's faces.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

using Corners = std::array<Vec3, 4>;

/// The half-spaces inside a tetrahedron. Two tetrahedra with a common face have exactly opposite half-spaces there, so
/// a region is divided between them without gap or overlap.
struct ClippingPlanes {
  struct Plane {
    Vec3 origin;
    Vec3 normal;  ///< inward, of any length
  };
  std::array<Plane, 4> planes;

  /// `nodes`: the nodes of the corners, by which planes are computed in the same way from both sides.
  ClippingPlanes(const Corners& corners, const std::array<std::uint32_t, 4>& nodes);
};

/// Clips tetrahedra; keeps its memory between calls.
class TetrahedronClipper {
 public:
  /// Returns the part of a tetrahedron within the planes, as tetrahedra of either orientation, until the next call.
  const std::vector<Corners>& clip(const Corners& tetrahedron, const ClippingPlanes& planes);

 private:
  void clipOne(const Corners& tetrahedron, const ClippingPlanes::Plane& plane);

  std::vector<Corners> pieces_;
  std::vector<Corners> next_;
};

/// Returns the volume, whatever the orientation.
[[nodiscard]] double volumeWithin(const Corners& p);

}  // namespace tetrafront
