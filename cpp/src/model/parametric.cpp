// Rational splines are evaluated with homogeneous poles (w p, w); the quotient rule gives the derivatives.

#include "model/parametric.h"

#include <algorithm>
#include <cmath>

#include "geom/sine.h"
#include "model/spline_basis.h"

namespace tetrafront {

namespace {

/// A weighted sum of poles, and the sum of their weights.
template <class Vector>
struct Homogeneous {
  Vector sum{0.0};
  double weight = 0.0;

  void add(double factor, double poleWeight, const Vector& pole) {
    sum += (factor * poleWeight) * pole;
    weight += factor * poleWeight;
  }
};

template <class Vector>
CurveJet<Vector> evaluateSpline(const SplineCurve<Vector>& spline, double t) {
  const SplineBasis basis = evaluateBasis(spline.knots, spline.degree, t);
  Homogeneous<Vector> value;
  Homogeneous<Vector> first;
  Homogeneous<Vector> second;
  for (std::uint32_t k = 0; k <= spline.degree; ++k) {
    const std::size_t at = basis.firstPole + k;
    const double weight = spline.weights.empty() ? 1.0 : spline.weights[at];
    value.add(basis.values[k], weight, spline.poles[at]);
    first.add(basis.first[k], weight, spline.poles[at]);
    second.add(basis.second[k], weight, spline.poles[at]);
  }
  if (spline.weights.empty()) return {value.sum, first.sum, second.sum};
  CurveJet<Vector> jet;
  jet.position = value.sum / value.weight;
  jet.first = (first.sum - first.weight * jet.position) / value.weight;
  jet.second =
      (second.sum - 2.0 * first.weight * jet.first - second.weight * jet.position) / value.weight;
  return jet;
}

template <class Curve>
auto evaluateCurve(const Curve& curve, double t) -> decltype(evaluateSpline(curve.spline, t)) {
  const auto& origin = curve.frame.origin;
  const auto& x = curve.frame.x;
  const auto& y = curve.frame.y;
  switch (curve.kind) {
    case CurveKind::kLine:
      return {origin + t * x, x};
    case CurveKind::kCircle:
    case CurveKind::kEllipse: {
      const auto [sine, cosine] = sineCosine(t);
      const double minor = curve.kind == CurveKind::kCircle ? curve.radius : curve.minorRadius;
      const auto out = (curve.radius * cosine) * x + (minor * sine) * y;
      return {origin + out, (minor * cosine) * y - (curve.radius * sine) * x, -out};
    }
    case CurveKind::kBSpline:
      break;
  }
  return evaluateSpline(curve.spline, t);
}

SurfaceJet evaluateSpline(const SplineSurface& spline, const Vec2& uv) {
  const SplineBasis u = evaluateBasis(spline.uKnots, spline.uDegree, uv.x);
  const SplineBasis v = evaluateBasis(spline.vKnots, spline.vDegree, uv.y);
  const std::size_t vCount = spline.vCount();
  Homogeneous<Vec3> s;
  Homogeneous<Vec3> su;
  Homogeneous<Vec3> sv;
  Homogeneous<Vec3> suu;
  Homogeneous<Vec3> suv;
  Homogeneous<Vec3> svv;
  for (std::uint32_t i = 0; i <= spline.uDegree; ++i) {
    for (std::uint32_t j = 0; j <= spline.vDegree; ++j) {
      const std::size_t at = (u.firstPole + i) * vCount + v.firstPole + j;
      const double weight = spline.weights.empty() ? 1.0 : spline.weights[at];
      const Vec3& pole = spline.poles[at];
      s.add(u.values[i] * v.values[j], weight, pole);
      su.add(u.first[i] * v.values[j], weight, pole);
      sv.add(u.values[i] * v.first[j], weight, pole);
      suu.add(u.second[i] * v.values[j], weight, pole);
      suv.add(u.first[i] * v.first[j], weight, pole);
      svv.add(u.values[i] * v.second[j], weight, pole);
    }
  }
  if (spline.weights.empty()) return {s.sum, su.sum, sv.sum, suu.sum, suv.sum, svv.sum};
  const double w = s.weight;
  SurfaceJet jet;
  jet.position = s.sum / w;
  jet.u = (su.sum - su.weight * jet.position) / w;
  jet.v = (sv.sum - sv.weight * jet.position) / w;
  jet.uu = (suu.sum - 2.0 * su.weight * jet.u - suu.weight * jet.position) / w;
  jet.vv = (svv.sum - 2.0 * sv.weight * jet.v - svv.weight * jet.position) / w;
  jet.uv = (suv.sum - su.weight * jet.v - sv.weight * jet.u - suv.weight * jet.position) / w;
  return jet;
}

/// A meridian of a surface of revolution in its half plane: distance from the axis and height along it, and their
/// first and second derivatives.
struct Meridian {
  Vec2 position;
  Vec2 first;
  Vec2 second;
};

SurfaceJet turned(const Frame3& frame, const Meridian& meridian, double u) {
  const auto [sine, cosine] = sineCosine(u);
  const Vec3 outward = cosine * frame.x + sine * frame.y;
  const Vec3 around = cosine * frame.y - sine * frame.x;
  const auto at = [&](const Vec2& p) { return p.x * outward + p.y * frame.z; };
  return {frame.origin + at(meridian.position), meridian.position.x * around, at(meridian.first),
          -meridian.position.x * outward,       meridian.first.x * around,    at(meridian.second)};
}

Meridian circularMeridian(double centre, double radius, double v) {
  const auto [sine, cosine] = sineCosine(v);
  return {{centre + radius * cosine, radius * sine},
          {-radius * sine, radius * cosine},
          {-radius * cosine, -radius * sine}};
}

SurfaceJet revolved(const FaceSurface& surface, const Vec2& uv) {
  const CurveJet<Vec3> profile = evaluate(surface.profile, uv.y);
  const Frame3& frame = surface.frame;
  const auto [sine, cosine] = sineCosine(uv.x);
  const auto local = [&](const Vec3& p) {
    return Vec3(glm::dot(p, frame.x), glm::dot(p, frame.y), glm::dot(p, frame.z));
  };
  const auto world = [&](const Vec3& p) { return p.x * frame.x + p.y * frame.y + p.z * frame.z; };
  const auto turn = [&](const Vec3& p) {
    return Vec3(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z);
  };
  const auto quarter = [](const Vec3& p) { return Vec3(-p.y, p.x, 0.0); };
  const Vec3 p = turn(local(profile.position - frame.origin));
  const Vec3 first = turn(local(profile.first));
  const Vec3 second = turn(local(profile.second));
  return {frame.origin + world(p),    world(quarter(p)),     world(first),
          world(quarter(quarter(p))), world(quarter(first)), world(second)};
}

}  // namespace

CurveJet<Vec3> evaluate(const SpaceCurve& curve, double t) { return evaluateCurve(curve, t); }
CurveJet<Vec2> evaluate(const PlaneCurve& curve, double t) { return evaluateCurve(curve, t); }

SurfaceJet evaluate(const FaceSurface& surface, const Vec2& uv) {
  const Frame3& frame = surface.frame;
  switch (surface.kind) {
    case SurfaceKind::kPlane:
      return {frame.origin + uv.x * frame.x + uv.y * frame.y, frame.x, frame.y};
    case SurfaceKind::kCylinder:
      return turned(frame, {{surface.radius, uv.y}, {0.0, 1.0}, {0.0, 0.0}}, uv.x);
    case SurfaceKind::kCone: {
      const auto [sine, cosine] = sineCosine(surface.halfAngle);
      return turned(
          frame, {{surface.radius + uv.y * sine, uv.y * cosine}, {sine, cosine}, {0.0, 0.0}}, uv.x);
    }
    case SurfaceKind::kSphere:
      return turned(frame, circularMeridian(0.0, surface.radius, uv.y), uv.x);
    case SurfaceKind::kTorus:
      return turned(frame, circularMeridian(surface.radius, surface.minorRadius, uv.y), uv.x);
    case SurfaceKind::kExtrusion: {
      const CurveJet<Vec3> profile = evaluate(surface.profile, uv.x);
      return {profile.position + uv.y * frame.z, profile.first, frame.z, profile.second};
    }
    case SurfaceKind::kRevolution:
      return revolved(surface, uv);
    case SurfaceKind::kBSpline:
      break;
  }
  return evaluateSpline(surface.spline, uv);
}

std::vector<double> knotsBetween(const SpaceCurve& curve, double first, double last) {
  std::vector<double> knots;
  if (curve.kind != CurveKind::kBSpline) return knots;
  for (const double knot : curve.spline.knots)
    if (knot > first && knot < last && (knots.empty() || knot > knots.back()))
      knots.push_back(knot);
  return knots;
}

Vec2 clampedToDomain(const FaceSurface& surface, const Vec2& uv) {
  const auto clampTo = [](const std::vector<double>& knots, std::uint32_t degree, double t) {
    return std::clamp(t, knots[degree], knots[knots.size() - degree - 1]);
  };
  const SplineSurface& spline = surface.spline;
  const SplineCurve<Vec3>& profile = surface.profile.spline;
  const bool hasSplineProfile = surface.profile.kind == CurveKind::kBSpline;
  switch (surface.kind) {
    case SurfaceKind::kBSpline:
      return {clampTo(spline.uKnots, spline.uDegree, uv.x),
              clampTo(spline.vKnots, spline.vDegree, uv.y)};
    case SurfaceKind::kExtrusion:
      return {hasSplineProfile ? clampTo(profile.knots, profile.degree, uv.x) : uv.x, uv.y};
    case SurfaceKind::kRevolution:
      return {uv.x, hasSplineProfile ? clampTo(profile.knots, profile.degree, uv.y) : uv.y};
    default:
      return uv;
  }
}

// ---- closest position ----------------------------------------------------------------------------

namespace {

/// Cells per direction of the lattice of starts.
constexpr int kStartCells = 24;
constexpr int kMaxNewtonSteps = 40;
constexpr int kMaxStepHalvings = 12;
/// Determinant / product of the diagonal below which a system counts as singular: beside the rounding of both products, 2e-16, it
/// would have no correct digits.
constexpr double kSingular = 1e-12;

/// Solves a symmetric system; zero if it is not positive definite.
Vec2 solve(double xx, double xy, double yy, const Vec2& right) {
  const double determinant = xx * yy - xy * xy;
  if (!(xx > 0.0) || !(yy > 0.0) || !(determinant > kSingular * xx * yy)) return Vec2(0.0);
  return {(yy * right.x - xy * right.y) / determinant, (xx * right.y - xy * right.x) / determinant};
}

/// The step from `jet` towards the position closest to the target.
Vec2 stepTowards(const SurfaceJet& jet, const Vec3& target) {
  const Vec3 offset = target - jet.position;
  const Vec2 right(glm::dot(jet.u, offset), glm::dot(jet.v, offset));
  const double uu = glm::dot(jet.u, jet.u);
  const double uv = glm::dot(jet.u, jet.v);
  const double vv = glm::dot(jet.v, jet.v);
  const Vec2 newton = solve(uu - glm::dot(jet.uu, offset), uv - glm::dot(jet.uv, offset),
                            vv - glm::dot(jet.vv, offset), right);
  if (newton != Vec2(0.0)) return newton;
  const double floor = kSingular * (uu + vv);
  return solve(uu + floor, uv, vv + floor, right);
}

Vec2 clampedTo(const ParameterBox& box, const Vec2& uv) {
  return {std::clamp(uv.x, box.low.x, box.high.x), std::clamp(uv.y, box.low.y, box.high.y)};
}

/// The same on a curve; zero where the curve has no speed.
double stepTowards(const CurveJet<Vec3>& jet, const Vec3& target) {
  const Vec3 offset = target - jet.position;
  const double squaredSpeed = glm::dot(jet.first, jet.first);
  const double newton = squaredSpeed - glm::dot(jet.second, offset);
  const double slope = newton > 0.0 ? newton : squaredSpeed;
  return slope > 0.0 ? glm::dot(jet.first, offset) / slope : 0.0;
}

double squaredDistance(const Vec3& a, const Vec3& b) { return glm::dot(a - b, a - b); }

/// Follows the steps of `stepFrom`, halved until they lead nearer to the target.
template <class Parameter, class Evaluate, class Step, class Clamp>
Parameter descend(const Parameter& start, const Vec3& target, const Evaluate& evaluateAt,
                  const Step& stepFrom, const Clamp& clamped) {
  Parameter best = clamped(start);
  auto jet = evaluateAt(best);
  double distance = squaredDistance(jet.position, target);
  for (int step = 0; step < kMaxNewtonSteps; ++step) {
    Parameter move = stepFrom(jet);
    bool isBetter = false;
    for (int halving = 0; halving < kMaxStepHalvings && !isBetter; ++halving, move *= 0.5) {
      const Parameter to = clamped(best + move);
      if (to == best) break;
      const auto next = evaluateAt(to);
      const double nextDistance = squaredDistance(next.position, target);
      if (!(nextDistance < distance)) continue;
      isBetter = true;
      best = to;
      jet = next;
      distance = nextDistance;
    }
    if (!isBetter) break;
  }
  return best;
}

}  // namespace

Vec2 closestParametersFrom(const FaceSurface& surface, const ParameterBox& box, const Vec3& target,
                           const Vec2& start) {
  return descend(
      start, target, [&](const Vec2& uv) { return evaluate(surface, uv); },
      [&](const SurfaceJet& jet) { return stepTowards(jet, target); },
      [&](const Vec2& uv) { return clampedTo(box, uv); });
}

double closestParameterFrom(const SpaceCurve& curve, double first, double last, const Vec3& target,
                            double start) {
  return descend(
      start, target, [&](double t) { return evaluate(curve, t); },
      [&](const CurveJet<Vec3>& jet) { return stepTowards(jet, target); },
      [&](double t) { return std::clamp(t, first, last); });
}

Vec2 closestParameters(const FaceSurface& surface, const ParameterBox& box, const Vec3& target) {
  Vec2 start = box.low;
  double least = squaredDistance(evaluate(surface, start).position, target);
  for (int i = 0; i <= kStartCells; ++i) {
    for (int j = 0; j <= kStartCells; ++j) {
      const Vec2 part(static_cast<double>(i) / kStartCells, static_cast<double>(j) / kStartCells);
      const Vec2 uv = box.low + part * (box.high - box.low);
      const double distance = squaredDistance(evaluate(surface, uv).position, target);
      if (!(distance < least)) continue;
      least = distance;
      start = uv;
    }
  }
  return closestParametersFrom(surface, box, target, start);
}

}  // namespace tetrafront
