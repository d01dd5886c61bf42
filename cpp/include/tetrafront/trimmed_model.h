#pragma once

/// @file Input: faces of solids as trimmed surfaces, as CAD programs describe them. All references are indices into
/// the arrays of the same TrimmedModel. Parameters of curves and surfaces are those of OpenCascade and of STEP, so that
/// curves in the parameter plane fit without change. Angles are radians.

#include <cstdint>
#include <optional>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// A position and three orthogonal unit axes. The axes may be left-handed.
struct Frame3 {
  Vec3 origin{0.0};
  Vec3 x{1.0, 0.0, 0.0};
  Vec3 y{0.0, 1.0, 0.0};
  Vec3 z{0.0, 0.0, 1.0};
  friend bool operator==(const Frame3&, const Frame3&) = default;
};

/// A position of the parameter plane and two orthogonal unit axes, in either orientation.
struct Frame2 {
  Vec2 origin{0.0};
  Vec2 x{1.0, 0.0};
  Vec2 y{0.0, 1.0};
};

enum class CurveKind : std::uint8_t {
  kLine = 0,     ///< origin + t x
  kCircle = 1,   ///< origin + radius (cos t x + sin t y)
  kEllipse = 2,  ///< origin + radius cos t x + minorRadius sin t y
  kBSpline = 3,  ///< t from knots[degree] to knots[poles.size()]
};

/// A B-spline, or a NURBS if it has weights. Knots are flat: one entry per multiplicity, ascending, degree + 1 more than
/// poles. A periodic spline is given over one period: its first `degree` poles are repeated at the end.
template <class Vector>
struct SplineCurve {
  std::uint32_t degree = 0;
  std::vector<double> knots;
  std::vector<Vector> poles;
  std::vector<double> weights;  ///< positive, one per pole; or empty
  friend bool operator==(const SplineCurve&, const SplineCurve&) = default;
};

/// A curve in space. The fields that its kind does not name are not read.
struct SpaceCurve {
  CurveKind kind = CurveKind::kLine;
  Frame3 frame;
  double radius = 0.0;
  double minorRadius = 0.0;
  SplineCurve<Vec3> spline;
  friend bool operator==(const SpaceCurve&, const SpaceCurve&) = default;
};

/// A curve in the parameter plane (u, v) of a surface.
struct PlaneCurve {
  CurveKind kind = CurveKind::kLine;
  Frame2 frame;
  double radius = 0.0;
  double minorRadius = 0.0;
  SplineCurve<Vec2> spline;
};

enum class SurfaceKind : std::uint8_t {
  kPlane = 0,     ///< origin + u x + v y
  kCylinder = 1,  ///< origin + radius (cos u x + sin u y) + v z
  /// origin + (radius + v sin halfAngle) (cos u x + sin u y) + v cos halfAngle z
  kCone = 2,
  kSphere = 3,  ///< origin + radius cos v (cos u x + sin u y) + radius sin v z
  /// origin + (radius + minorRadius cos v) (cos u x + sin u y) + minorRadius sin v z
  kTorus = 4,
  kBSpline = 5,    ///< see SplineSurface
  kExtrusion = 6,  ///< profile(u) + v z
  kRevolution =
      7,  ///< profile(v), turned by u about the axis through the origin along z, from x to y
};

/// A B-spline surface, or a NURBS if it has weights. Knots are as in SplineCurve; pole (i, j), the i-th in the direction
/// of u, is at poles[i * vCount() + j].
struct SplineSurface {
  std::uint32_t uDegree = 0;
  std::uint32_t vDegree = 0;
  std::vector<double> uKnots;
  std::vector<double> vKnots;
  std::vector<Vec3> poles;
  std::vector<double> weights;  ///< positive, one per pole; or empty

  friend bool operator==(const SplineSurface&, const SplineSurface&) = default;

  [[nodiscard]] std::size_t uCount() const { return uKnots.size() - uDegree - 1; }
  [[nodiscard]] std::size_t vCount() const { return vKnots.size() - vDegree - 1; }
};

/// A surface without boundary. The fields that its kind does not name are not read.
struct FaceSurface {
  SurfaceKind kind = SurfaceKind::kPlane;
  Frame3 frame;
  double radius = 0.0;
  double minorRadius = 0.0;
  double halfAngle = 0.0;  ///< of a cone, from -pi/2 to pi/2
  SplineSurface spline;
  SpaceCurve profile;  ///< of an extrusion or a revolution
  friend bool operator==(const FaceSurface&, const FaceSurface&) = default;
};

/// A part of a curve between two vertices, which are the same for a closed edge. Faces share an edge.
struct TrimmedEdge {
  /// Index of a curve; none for a degenerate edge, which is one vertex in space: a pole or an apex of its surface.
  std::optional<std::uint32_t> curve;
  double first = 0.0;  ///< parameter at the start vertex
  double last = 1.0;   ///< parameter at the end vertex, above `first`
  std::uint32_t start = 0;
  std::uint32_t end = 0;
  /// Largest distance of the curve's ends from the vertices, and of the curve from the surfaces of its faces.
  double tolerance = 0.0;
};

/// An edge in a loop of a face.
struct Coedge {
  std::uint32_t edge = 0;
  bool reversed = false;  ///< the loop runs from the edge's end to its start
  /// The edge in the plane (u, v) at the edge's parameter. If it is missing, nodes are projected onto the surface. An edge
  /// that occurs twice in a face (a seam) and a degenerate edge must have it.
  std::optional<PlaneCurve> inPlane;
};

/// A part of a surface between loops. The first loop need not be the outer one, and the directions of loops are not
/// read: the loop that encloses the largest area of the plane is the outer one. The loops must be closed in the plane;
/// closed surfaces are therefore cut along a seam.
struct TrimmedFace {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  std::uint32_t surface = 0;
  /// True if dS/du x dS/dv points into the solid.
  bool reversed = false;
  std::vector<std::vector<Coedge>> loops;
  std::uint32_t solid = 0;  ///< index of the solid behind the face
  std::uint32_t otherSolid =
      kNone;                     ///< index of the solid before it, for a face that two solids share
  std::uint32_t name = kNone;    ///< index into names that the caller keeps
  std::uint32_t colour = kNone;  ///< 0xRRGGBB
};

struct TrimmedModel {
  std::vector<Vec3> vertices;
  std::vector<SpaceCurve> curves;
  std::vector<FaceSurface> surfaces;
  std::vector<TrimmedEdge> edges;
  std::vector<TrimmedFace> faces;
};

}  // namespace tetrafront
