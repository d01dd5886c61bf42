#include "support/trimmed_models.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace tetrafront::testing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Vec3 kX(1.0, 0.0, 0.0);
constexpr Vec3 kY(0.0, 1.0, 0.0);
constexpr Vec3 kZ(0.0, 0.0, 1.0);

class TrimmedBuilder {
 public:
  std::uint32_t vertex(const Vec3& position) { return add(model.vertices, position); }
  std::uint32_t edge(SpaceCurve curve, double first, double last, std::uint32_t start,
                     std::uint32_t end) {
    return add(model.edges, {add(model.curves, std::move(curve)), first, last, start, end, 0.0});
  }
  std::uint32_t segment(std::uint32_t start, std::uint32_t end) {
    const Vec3 along = model.vertices[end] - model.vertices[start];
    SpaceCurve line;
    line.frame.origin = model.vertices[start];
    line.frame.x = glm::normalize(along);
    return edge(line, 0.0, glm::length(along), start, end);
  }
  void face(FaceSurface surface, bool reversed, std::vector<std::vector<Coedge>> loops) {
    TrimmedFace made;
    made.surface = add(model.surfaces, std::move(surface));
    made.reversed = reversed;
    made.loops = std::move(loops);
    model.faces.push_back(std::move(made));
  }

  TrimmedModel model;

 private:
  template <class T>
  static std::uint32_t add(std::vector<T>& list, T value) {
    list.push_back(std::move(value));
    return static_cast<std::uint32_t>(list.size() - 1);
  }
};

SpaceCurve circle(const Vec3& centre, double radius, const Vec3& x = kX, const Vec3& y = kY) {
  SpaceCurve curve;
  curve.kind = CurveKind::kCircle;
  curve.frame = {centre, x, y, glm::cross(x, y)};
  curve.radius = radius;
  return curve;
}

PlaneCurve lineInPlane(const Vec2& origin, const Vec2& direction) {
  PlaneCurve curve;
  curve.frame.origin = origin;
  curve.frame.x = direction;
  return curve;
}

PlaneCurve circleInPlane(double radius) {
  PlaneCurve curve;
  curve.kind = CurveKind::kCircle;
  curve.radius = radius;
  return curve;
}

FaceSurface planeAt(const Vec3& origin, const Vec3& x = kX, const Vec3& y = kY) {
  FaceSurface plane;
  plane.frame = {origin, x, y, glm::cross(x, y)};
  return plane;
}

FaceSurface elementary(SurfaceKind kind, double radius) {
  FaceSurface surface;
  surface.kind = kind;
  surface.radius = radius;
  return surface;
}

/// A whole turn of a side between two circles and a seam, in (u, v) from (0, low) to (turn, high).
std::vector<Coedge> sideLoop(std::uint32_t bottom, std::uint32_t top, std::uint32_t seam,
                             double turn, double low, double high) {
  return {{bottom, false, lineInPlane({0.0, low}, {1.0, 0.0})},
          {seam, false, lineInPlane({turn, 0.0}, {0.0, 1.0})},
          {top, true, lineInPlane({0.0, high}, {1.0, 0.0})},
          {seam, true, lineInPlane({0.0, 0.0}, {0.0, 1.0})}};
}

std::function<double(const Vec3&)> fromPlane(int axis, double value) {
  return [=](const Vec3& p) { return std::fabs(p[axis] - value); };
}

double fromAxis(const Vec3& p) { return std::sqrt(p.x * p.x + p.y * p.y); }

/// Adds the outline of a box without faces in z; returns the loops of its top and bottom.
struct BoxEdges {
  std::array<std::uint32_t, 4> bottom{};
  std::array<std::uint32_t, 4> top{};
  std::array<std::uint32_t, 4> upright{};
};

BoxEdges addBoxSides(TrimmedBuilder& builder, const Vec3& low, const Vec3& high) {
  std::array<std::uint32_t, 4> below{};
  std::array<std::uint32_t, 4> above{};
  const std::array<Vec2, 4> corners{
      {{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}};
  for (std::size_t i = 0; i < 4; ++i)
    below[i] = builder.vertex({corners[i].x, corners[i].y, low.z});
  for (std::size_t i = 0; i < 4; ++i)
    above[i] = builder.vertex({corners[i].x, corners[i].y, high.z});
  BoxEdges edges;
  for (std::size_t i = 0; i < 4; ++i) {
    edges.bottom[i] = builder.segment(below[i], below[(i + 1) % 4]);
    edges.top[i] = builder.segment(above[i], above[(i + 1) % 4]);
    edges.upright[i] = builder.segment(below[i], above[i]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 from(corners[i].x, corners[i].y, low.z);
    const Vec2 next = corners[(i + 1) % 4];
    const Vec3 along = glm::normalize(Vec3(next.x, next.y, low.z) - from);
    builder.face(planeAt(from, along, kZ), false,
                 {{{edges.bottom[i], false, {}},
                   {edges.upright[(i + 1) % 4], false, {}},
                   {edges.top[i], true, {}},
                   {edges.upright[i], true, {}}}});
  }
  return edges;
}

std::vector<Coedge> loopOf(const std::array<std::uint32_t, 4>& edges) {
  std::vector<Coedge> loop;
  for (const std::uint32_t edge : edges) loop.push_back({edge, false, {}});
  return loop;
}

void addDistancesOfBoxSides(TrimmedSolid& solid, const Vec3& low, const Vec3& high) {
  solid.distances = {fromPlane(1, low.y), fromPlane(0, high.x), fromPlane(1, high.y),
                     fromPlane(0, low.x)};
}

/// Knots, poles and weights of a rational quadratic arc of `quarters` quarters of a circle, one per unit.
struct ArcSpline {
  std::vector<double> knots;
  std::vector<Vec2> poles;
  std::vector<double> weights;
};

ArcSpline arcSpline(int quarters, double start) {
  ArcSpline arc;
  arc.knots = {0.0};
  for (int i = 0; i <= quarters; ++i) arc.knots.insert(arc.knots.end(), 2, i);
  arc.knots.push_back(quarters);
  for (int i = 0; i <= 2 * quarters; ++i) {
    const double angle = start + 0.25 * kPi * i;
    const double reach = i % 2 == 0 ? 1.0 : std::sqrt(2.0);
    arc.poles.emplace_back(reach * std::cos(angle), reach * std::sin(angle));
    arc.weights.push_back(1.0 / reach);
  }
  return arc;
}

SpaceCurve nurbsArc(const ArcSpline& arc, const Vec3& centre, double radius, const Vec3& x,
                    const Vec3& y) {
  SpaceCurve curve;
  curve.kind = CurveKind::kBSpline;
  curve.spline.degree = 2;
  curve.spline.knots = arc.knots;
  curve.spline.weights = arc.weights;
  for (const Vec2& pole : arc.poles)
    curve.spline.poles.push_back(centre + radius * (pole.x * x + pole.y * y));
  return curve;
}

/// Simpson's rule from 0 to 1.
double integrate(const std::function<double(double)>& f) {
  constexpr int kSteps = 2000;
  double sum = f(0.0) + f(1.0);
  for (int i = 1; i < kSteps; ++i)
    sum += (i % 2 == 0 ? 2.0 : 4.0) * f(static_cast<double>(i) / kSteps);
  return sum / (3.0 * kSteps);
}

/// A cubic by its Bernstein coefficients, and its derivative.
struct Cubic {
  std::array<double, 4> b;

  [[nodiscard]] double at(double t) const {
    const double s = 1.0 - t;
    return s * s * s * b[0] + 3.0 * s * s * t * b[1] + 3.0 * s * t * t * b[2] + t * t * t * b[3];
  }
  [[nodiscard]] double slope(double t) const {
    const double s = 1.0 - t;
    return 3.0 * (s * s * (b[1] - b[0]) + 2.0 * s * t * (b[2] - b[1]) + t * t * (b[3] - b[2]));
  }
  /// The curve (t, at(t)) along two axes.
  [[nodiscard]] SpaceCurve curve(const Vec3& along, const Vec3& across) const {
    SpaceCurve made;
    made.kind = CurveKind::kBSpline;
    made.spline.degree = 3;
    made.spline.knots = {0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0};
    for (std::size_t i = 0; i < 4; ++i)
      made.spline.poles.push_back((static_cast<double>(i) / 3.0) * along + b[i] * across);
    return made;
  }
};

}  // namespace

TrimmedSolid trimmedBox(const Vec3& low, const Vec3& high) {
  TrimmedBuilder builder;
  const BoxEdges edges = addBoxSides(builder, low, high);
  builder.face(planeAt(low), true, {loopOf(edges.bottom)});
  builder.face(planeAt(high), false, {loopOf(edges.top)});
  const Vec3 d = high - low;
  TrimmedSolid solid{
      "box", builder.model, 2.0 * (d.x * d.y + d.y * d.z + d.z * d.x), d.x * d.y * d.z, 2, {}};
  addDistancesOfBoxSides(solid, low, high);
  solid.distances.push_back(fromPlane(2, low.z));
  solid.distances.push_back(fromPlane(2, high.z));
  return solid;
}

TrimmedSolid trimmedCylinder(double radius, double height) {
  TrimmedBuilder builder;
  const std::uint32_t a = builder.vertex({radius, 0.0, 0.0});
  const std::uint32_t b = builder.vertex({radius, 0.0, height});
  const std::uint32_t bottom = builder.edge(circle({}, radius), 0.0, 2.0 * kPi, a, a);
  const std::uint32_t top = builder.edge(circle(height * kZ, radius), 0.0, 2.0 * kPi, b, b);
  const std::uint32_t seam = builder.segment(a, b);
  builder.face(elementary(SurfaceKind::kCylinder, radius), false,
               {sideLoop(bottom, top, seam, 2.0 * kPi, 0.0, height)});
  builder.face(planeAt({}), true, {{{bottom, false, circleInPlane(radius)}}});
  builder.face(planeAt(height * kZ), false, {{{top, false, {}}}});
  return {"cylinder",
          builder.model,
          2.0 * kPi * radius * (radius + height),
          kPi * radius * radius * height,
          2,
          {[=](const Vec3& p) { return std::fabs(fromAxis(p) - radius); }, fromPlane(2, 0.0),
           fromPlane(2, height)}};
}

TrimmedSolid trimmedCone(double bottom, double top, double height) {
  TrimmedBuilder builder;
  const bool hasApex = top == 0.0;
  const double slant = std::hypot(bottom - top, height);
  const std::uint32_t a = builder.vertex({bottom, 0.0, 0.0});
  const std::uint32_t b = builder.vertex({top, 0.0, height});
  const std::uint32_t base = builder.edge(circle({}, bottom), 0.0, 2.0 * kPi, a, a);
  const std::uint32_t seam = builder.segment(a, b);
  FaceSurface cone = elementary(SurfaceKind::kCone, bottom);
  cone.halfAngle = std::atan2(top - bottom, height);
  std::uint32_t rim = 0;
  if (hasApex) {
    builder.model.edges.push_back({{}, 0.0, 2.0 * kPi, b, b, 0.0});
    rim = static_cast<std::uint32_t>(builder.model.edges.size() - 1);
  } else {
    rim = builder.edge(circle(height * kZ, top), 0.0, 2.0 * kPi, b, b);
  }
  builder.face(cone, false, {sideLoop(base, rim, seam, 2.0 * kPi, 0.0, slant)});
  builder.face(planeAt({}), true, {{{base, false, circleInPlane(bottom)}}});
  TrimmedSolid solid{hasApex ? "cone" : "frustum",
                     builder.model,
                     kPi * (bottom + top) * slant + kPi * bottom * bottom + kPi * top * top,
                     kPi * height * (bottom * bottom + bottom * top + top * top) / 3.0,
                     2,
                     {[=](const Vec3& p) {
                        const double radius = bottom + (top - bottom) * p.z / height;
                        return std::fabs(fromAxis(p) - radius) * height / slant;
                      },
                      fromPlane(2, 0.0)}};
  if (!hasApex) {
    TrimmedBuilder closing;
    closing.model = solid.model;
    closing.face(planeAt(height * kZ), false, {{{rim, false, circleInPlane(top)}}});
    solid.model = closing.model;
    solid.distances.push_back(fromPlane(2, height));
  }
  return solid;
}

TrimmedSolid trimmedSphere(double radius) {
  TrimmedBuilder builder;
  const std::uint32_t south = builder.vertex({0.0, 0.0, -radius});
  const std::uint32_t north = builder.vertex({0.0, 0.0, radius});
  const std::uint32_t seam =
      builder.edge(circle({}, radius, kX, kZ), -0.5 * kPi, 0.5 * kPi, south, north);
  builder.model.edges.push_back({{}, 0.0, 2.0 * kPi, south, south, 0.0});
  builder.model.edges.push_back({{}, 0.0, 2.0 * kPi, north, north, 0.0});
  builder.face(elementary(SurfaceKind::kSphere, radius), false,
               {sideLoop(seam + 1, seam + 2, seam, 2.0 * kPi, -0.5 * kPi, 0.5 * kPi)});
  return {"sphere",
          builder.model,
          4.0 * kPi * radius * radius,
          4.0 / 3.0 * kPi * radius * radius * radius,
          2,
          {[=](const Vec3& p) { return std::fabs(glm::length(p) - radius); }}};
}

TrimmedSolid trimmedTorus(double radius, double minorRadius) {
  TrimmedBuilder builder;
  const std::uint32_t vertex = builder.vertex({radius + minorRadius, 0.0, 0.0});
  const std::uint32_t around =
      builder.edge(circle({}, radius + minorRadius), 0.0, 2.0 * kPi, vertex, vertex);
  const std::uint32_t section =
      builder.edge(circle(radius * kX, minorRadius, kX, kZ), 0.0, 2.0 * kPi, vertex, vertex);
  FaceSurface torus = elementary(SurfaceKind::kTorus, radius);
  torus.minorRadius = minorRadius;
  builder.face(torus, false, {sideLoop(around, around, section, 2.0 * kPi, 0.0, 2.0 * kPi)});
  return {"torus",
          builder.model,
          4.0 * kPi * kPi * radius * minorRadius,
          2.0 * kPi * kPi * radius * minorRadius * minorRadius,
          0,
          {[=](const Vec3& p) {
            return std::fabs(std::hypot(fromAxis(p) - radius, p.z) - minorRadius);
          }}};
}

TrimmedSolid trimmedPlate(double width, double thickness, double holeRadius) {
  TrimmedBuilder builder;
  const Vec3 low(-0.5 * width, -0.5 * width, 0.0);
  const Vec3 high(0.5 * width, 0.5 * width, thickness);
  const BoxEdges edges = addBoxSides(builder, low, high);
  const std::uint32_t a = builder.vertex({holeRadius, 0.0, 0.0});
  const std::uint32_t b = builder.vertex({holeRadius, 0.0, thickness});
  const std::uint32_t bottom = builder.edge(circle({}, holeRadius), 0.0, 2.0 * kPi, a, a);
  const std::uint32_t top = builder.edge(circle(thickness * kZ, holeRadius), 0.0, 2.0 * kPi, b, b);
  const std::uint32_t seam = builder.segment(a, b);
  builder.face(elementary(SurfaceKind::kCylinder, holeRadius), true,
               {sideLoop(bottom, top, seam, 2.0 * kPi, 0.0, thickness)});
  // The hole comes first in one face: which loop is the outer one follows from the areas.
  builder.face(planeAt({}), true, {{{bottom, false, {}}}, loopOf(edges.bottom)});
  builder.face(planeAt(thickness * kZ), false, {loopOf(edges.top), {{top, true, {}}}});
  const double opening = kPi * holeRadius * holeRadius;
  TrimmedSolid solid{"plate",
                     builder.model,
                     4.0 * width * thickness + 2.0 * (width * width - opening) +
                         2.0 * kPi * holeRadius * thickness,
                     (width * width - opening) * thickness,
                     0,
                     {}};
  addDistancesOfBoxSides(solid, low, high);
  solid.distances.push_back([=](const Vec3& p) { return std::fabs(fromAxis(p) - holeRadius); });
  solid.distances.push_back(fromPlane(2, 0.0));
  solid.distances.push_back(fromPlane(2, thickness));
  return solid;
}

TrimmedSolid nurbsCylinder(double radius, double height) {
  TrimmedBuilder builder;
  const ArcSpline turn = arcSpline(4, 0.0);
  const std::uint32_t a = builder.vertex({radius, 0.0, 0.0});
  const std::uint32_t b = builder.vertex({radius, 0.0, height});
  const std::uint32_t bottom = builder.edge(nurbsArc(turn, {}, radius, kX, kY), 0.0, 4.0, a, a);
  const std::uint32_t top =
      builder.edge(nurbsArc(turn, height * kZ, radius, kX, kY), 0.0, 4.0, b, b);
  const std::uint32_t seam = builder.segment(a, b);
  FaceSurface side;
  side.kind = SurfaceKind::kBSpline;
  side.spline.uDegree = 2;
  side.spline.vDegree = 1;
  side.spline.uKnots = turn.knots;
  side.spline.vKnots = {0.0, 0.0, height, height};
  for (std::size_t i = 0; i < turn.poles.size(); ++i) {
    for (const double z : {0.0, height}) {
      side.spline.poles.emplace_back(radius * turn.poles[i].x, radius * turn.poles[i].y, z);
      side.spline.weights.push_back(turn.weights[i]);
    }
  }
  builder.face(side, false, {sideLoop(bottom, top, seam, 4.0, 0.0, height)});
  builder.face(planeAt({}), true, {{{bottom, false, {}}}});
  builder.face(planeAt(height * kZ), false, {{{top, false, {}}}});
  TrimmedSolid solid = trimmedCylinder(radius, height);
  solid.name = "nurbs cylinder";
  solid.model = builder.model;
  return solid;
}

TrimmedSolid nurbsSphere(double radius) {
  TrimmedBuilder builder;
  const ArcSpline turn = arcSpline(4, 0.0);
  const ArcSpline half = arcSpline(2, -0.5 * kPi);
  const std::uint32_t south = builder.vertex({0.0, 0.0, -radius});
  const std::uint32_t north = builder.vertex({0.0, 0.0, radius});
  const std::uint32_t seam =
      builder.edge(nurbsArc(half, {}, radius, kX, kZ), 0.0, 2.0, south, north);
  builder.model.edges.push_back({{}, 0.0, 4.0, south, south, 0.0});
  builder.model.edges.push_back({{}, 0.0, 4.0, north, north, 0.0});
  FaceSurface sphere;
  sphere.kind = SurfaceKind::kBSpline;
  sphere.spline.uDegree = 2;
  sphere.spline.vDegree = 2;
  sphere.spline.uKnots = turn.knots;
  sphere.spline.vKnots = half.knots;
  for (std::size_t i = 0; i < turn.poles.size(); ++i) {
    for (std::size_t j = 0; j < half.poles.size(); ++j) {
      sphere.spline.poles.push_back(radius * Vec3(half.poles[j].x * turn.poles[i].x,
                                                  half.poles[j].x * turn.poles[i].y,
                                                  half.poles[j].y));
      sphere.spline.weights.push_back(turn.weights[i] * half.weights[j]);
    }
  }
  builder.face(sphere, false, {sideLoop(seam + 1, seam + 2, seam, 4.0, 0.0, 2.0)});
  TrimmedSolid solid = trimmedSphere(radius);
  solid.name = "nurbs sphere";
  solid.model = builder.model;
  return solid;
}

TrimmedSolid extrudedProfile(double height) {
  const Cubic arch{{0.0, 0.9, 0.5, 0.0}};
  TrimmedBuilder builder;
  const std::uint32_t a = builder.vertex({});
  const std::uint32_t b = builder.vertex(kX);
  const std::uint32_t c = builder.vertex(height * kZ);
  const std::uint32_t d = builder.vertex(kX + height * kZ);
  SpaceCurve raised = arch.curve(kX, kY);
  for (Vec3& pole : raised.spline.poles) pole.z = height;
  const std::uint32_t lower = builder.edge(arch.curve(kX, kY), 0.0, 1.0, a, b);
  const std::uint32_t upper = builder.edge(raised, 0.0, 1.0, c, d);
  const std::uint32_t base = builder.segment(a, b);
  const std::uint32_t roof = builder.segment(c, d);
  const std::uint32_t left = builder.segment(a, c);
  const std::uint32_t right = builder.segment(b, d);
  FaceSurface side;
  side.kind = SurfaceKind::kExtrusion;
  side.profile = arch.curve(kX, kY);
  // dS/du x dS/dv is about x cross z = -y, into the solid.
  builder.face(side, true,
               {{{lower, false, lineInPlane({}, {1.0, 0.0})},
                 {right, false, lineInPlane({1.0, 0.0}, {0.0, 1.0})},
                 {upper, true, {}},
                 {left, true, {}}}});
  builder.face(planeAt({}, kX, kZ), false,
               {{{base, false, {}}, {right, false, {}}, {roof, true, {}}, {left, true, {}}}});
  builder.face(planeAt({}), true, {{{base, false, {}}, {lower, true, {}}}});
  builder.face(planeAt(height * kZ), false, {{{roof, false, {}}, {upper, true, {}}}});
  const double area = integrate([&](double t) { return arch.at(t); });
  const double length = integrate([&](double t) { return std::hypot(1.0, arch.slope(t)); });
  return {"extrusion",
          builder.model,
          2.0 * area + (1.0 + length) * height,
          area * height,
          2,
          {[=](const Vec3& p) { return std::fabs(p.y - arch.at(p.x)); }, fromPlane(1, 0.0),
           fromPlane(2, 0.0), fromPlane(2, height)}};
}

TrimmedSolid revolvedProfile() {
  const Cubic r{{0.5, 0.9, 0.1, 0.4}};
  TrimmedBuilder builder;
  const std::uint32_t a = builder.vertex({r.b[0], 0.0, 0.0});
  const std::uint32_t b = builder.vertex({r.b[3], 0.0, 1.0});
  const std::uint32_t bottom = builder.edge(circle({}, r.b[0]), 0.0, 2.0 * kPi, a, a);
  const std::uint32_t top = builder.edge(circle(kZ, r.b[3]), 0.0, 2.0 * kPi, b, b);
  const std::uint32_t seam = builder.edge(r.curve(kZ, kX), 0.0, 1.0, a, b);
  FaceSurface side;
  side.kind = SurfaceKind::kRevolution;
  side.profile = r.curve(kZ, kX);
  builder.face(side, false, {sideLoop(bottom, top, seam, 2.0 * kPi, 0.0, 1.0)});
  builder.face(planeAt({}), true, {{{bottom, false, {}}}});
  builder.face(planeAt(kZ), false, {{{top, false, {}}}});
  const double sideArea =
      integrate([&](double t) { return 2.0 * kPi * r.at(t) * std::hypot(1.0, r.slope(t)); });
  return {"revolution",
          builder.model,
          sideArea + kPi * (r.b[0] * r.b[0] + r.b[3] * r.b[3]),
          integrate([&](double t) { return kPi * r.at(t) * r.at(t); }),
          2,
          {[=](const Vec3& p) { return std::fabs(fromAxis(p) - r.at(p.z)); }, fromPlane(2, 0.0),
           fromPlane(2, 1.0)}};
}

std::vector<TrimmedSolid> trimmedSolids() {
  return {trimmedBox({0.0, 0.0, 0.0}, {1.0, 2.0, 1.5}),
          trimmedCylinder(1.0, 2.0),
          trimmedCone(1.0, 0.0, 1.5),
          trimmedCone(1.0, 0.4, 1.0),
          trimmedSphere(1.0),
          trimmedTorus(1.0, 0.4),
          trimmedPlate(2.0, 0.5, 0.5),
          nurbsCylinder(1.0, 2.0),
          nurbsSphere(1.0),
          extrudedProfile(0.8),
          revolvedProfile()};
}

namespace {

class NumberWriter {
 public:
  void add(double number) { numbers_.push_back(number); }
  template <class Vector>
  void addVector(const Vector& vector) {
    for (glm::length_t k = 0; k < Vector::length(); ++k) add(vector[k]);
  }
  void addList(const std::vector<double>& list) {
    addCount(list.size());
    numbers_.insert(numbers_.end(), list.begin(), list.end());
  }
  template <class Vector>
  void addVectors(const std::vector<Vector>& vectors) {
    addCount(vectors.size() * Vector::length());
    for (const Vector& vector : vectors) addVector(vector);
  }
  void addCount(std::size_t count) { add(static_cast<double>(count)); }
  template <class Kind>
  void addKind(Kind kind) {
    add(static_cast<double>(kind));
  }
  template <class Curve>
  void addCurve(const Curve& curve) {
    addKind(curve.kind);
    if (curve.kind == CurveKind::kBSpline) {
      add(curve.spline.degree);
      addList(curve.spline.knots);
      addVectors(curve.spline.poles);
      addList(curve.spline.weights);
      return;
    }
    addVector(curve.frame.origin);
    addVector(curve.frame.x);
    addVector(curve.frame.y);
    if constexpr (requires { curve.frame.z; }) addVector(curve.frame.z);
    add(curve.radius);
    add(curve.minorRadius);
  }
  void addSurface(const FaceSurface& surface) {
    addKind(surface.kind);
    if (surface.kind == SurfaceKind::kBSpline) {
      add(surface.spline.uDegree);
      add(surface.spline.vDegree);
      addList(surface.spline.uKnots);
      addList(surface.spline.vKnots);
      addVectors(surface.spline.poles);
      addList(surface.spline.weights);
      return;
    }
    for (const Vec3& vector :
         {surface.frame.origin, surface.frame.x, surface.frame.y, surface.frame.z})
      addVector(vector);
    for (const double number : {surface.radius, surface.minorRadius, surface.halfAngle})
      add(number);
    if (surface.kind == SurfaceKind::kExtrusion || surface.kind == SurfaceKind::kRevolution)
      addCurve(surface.profile);
  }
  void addFace(const TrimmedFace& face) {
    add(face.surface);
    add(face.reversed ? 1.0 : 0.0);
    add(face.solid);
    add(face.otherSolid == TrimmedFace::kNone ? -1.0 : face.otherSolid);
    addCount(face.loops.size());
    for (const std::vector<Coedge>& loop : face.loops) {
      addCount(loop.size());
      for (const Coedge& coedge : loop) {
        add(coedge.edge);
        add(coedge.reversed ? 1.0 : 0.0);
        if (coedge.inPlane) {
          addCurve(*coedge.inPlane);
        } else {
          add(-1.0);
        }
      }
    }
  }
  std::vector<double> take() { return std::move(numbers_); }

 private:
  std::vector<double> numbers_;
};

}  // namespace

std::vector<double> numbersOf(const TrimmedModel& model) {
  NumberWriter writer;
  writer.addCount(model.vertices.size());
  for (const Vec3& vertex : model.vertices) writer.addVector(vertex);
  writer.addCount(model.curves.size());
  for (const SpaceCurve& curve : model.curves) writer.addCurve(curve);
  writer.addCount(model.surfaces.size());
  for (const FaceSurface& surface : model.surfaces) writer.addSurface(surface);
  writer.addCount(model.edges.size());
  for (const TrimmedEdge& edge : model.edges) {
    writer.add(edge.curve ? static_cast<double>(*edge.curve) : -1.0);
    for (const double number : {edge.first, edge.last}) writer.add(number);
    for (const std::uint32_t vertex : {edge.start, edge.end}) writer.add(vertex);
    writer.add(edge.tolerance);
  }
  writer.addCount(model.faces.size());
  for (const TrimmedFace& face : model.faces) writer.addFace(face);
  return writer.take();
}

}  // namespace tetrafront::testing
