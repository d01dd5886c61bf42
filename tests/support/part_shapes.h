#pragma once

/// @file Closed surfaces as CAD programs export mechanical parts: flat faces and round walls in as few triangles as
/// possible, so most of them are needles. Triangles face outward. Only `points` and `triangles` are set.

#include <functional>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront::testing {

/// A closed polygon in the plane without self-intersections, counter-clockwise unless stated otherwise.
using Outline = std::vector<Vec2>;

/// A flat face with holes; the outlines of the holes are counter-clockwise, too.
struct FlatFace {
  Outline outline;
  std::vector<Outline> holes;
};

// ---- outlines --------------------------------------------------------------------------------------

Outline rectangle(const Vec2& lower, const Vec2& upper);

/// A regular polygon.
Outline circle(const Vec2& centre, double radius, int sectors);

/// Returns the outline with each corner rounded by an arc of this radius, in `pieces` straight pieces.
Outline filleted(const Outline& outline, double radius, int pieces);

/// A gear wheel; `tooth` lists the corners of one tooth, each as a share of the pitch angle and a radius.
Outline gear(int teeth, const std::vector<Vec2>& tooth);

Outline shifted(Outline outline, const Vec2& by);

// ---- solids ----------------------------------------------------------------------------------------

/// A prism from z = 0 to `height`.
SurfaceMesh prism(const FlatFace& base, double height);

/// A plate with raised faces on its top, for example letters. If `rise` is negative, they are engraved.
SurfaceMesh embossed(const Outline& outline, const std::vector<FlatFace>& letters, double thickness,
                     double rise);

/// Revolves an outline of radii and heights about the z axis.
SurfaceMesh revolved(const Outline& section, int sectors);

/// Centre of a section of a swept solid, and the directions of its two axes.
struct SectionFrame {
  Vec3 centre{0.0};
  Vec3 u{1.0, 0.0, 0.0};
  Vec3 v{0.0, 1.0, 0.0};
};

/// Sweeps a section through `count` + 1 frames; the frame of a position from 0 to 1. Both ends are flat.
SurfaceMesh swept(const FlatFace& section, int count,
                  const std::function<SectionFrame(double position)>& frameAt);

/// A frame of a helix about the z axis; its section has u along the radius and v against the axis.
SectionFrame helixFrame(double radius, double pitch, double turn);

/// The cells of a grid with these coordinates for which `isSolid` holds, each of their squares as two triangles.
SurfaceMesh blocks(const std::vector<double>& x, const std::vector<double>& y,
                   const std::vector<double>& z,
                   const std::function<bool(int i, int j, int k)>& isSolid);

}  // namespace tetrafront::testing
