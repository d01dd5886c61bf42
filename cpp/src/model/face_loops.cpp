#include "model/face_loops.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geom/sine.h"
#include "model/edge_curve.h"

namespace tetrafront {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Steps in which a coedge is sampled.
constexpr std::size_t kCoedgeSamples = 24;
/// Gap between two coedges / width of the box, above which the loop is open there or runs through a pole.
constexpr double kLargeGap = 0.01;
/// Distance of positions at a pole from each other / extent of the edges of the face: far above rounding, far below a side.
constexpr double kPoleTolerance = 1e-6;

/// Range of a curve's parameters in which the position closest to `target` lies.
Vec2 rangeOf(const SpaceCurve& curve, const Vec3& target) {
  switch (curve.kind) {
    case CurveKind::kLine: {
      const double reach = glm::length(target - curve.frame.origin);
      return {-reach, reach};
    }
    case CurveKind::kCircle:
    case CurveKind::kEllipse:
      return {0.0, kTurn};
    case CurveKind::kBSpline:
      break;
  }
  const SplineCurve<Vec3>& spline = curve.spline;
  return {spline.knots[spline.degree], spline.knots[spline.knots.size() - spline.degree - 1]};
}

/// Box of the parameters at which the surface may be closest to `target`.
ParameterBox searchBox(const FaceSurface& surface, const Vec3& target) {
  const double reach = glm::length(target - surface.frame.origin) + surface.radius;
  constexpr double kHalfTurn = 0.5 * std::numbers::pi;
  switch (surface.kind) {
    case SurfaceKind::kPlane:
      return {Vec2(-reach), Vec2(reach)};
    case SurfaceKind::kCylinder:
    case SurfaceKind::kCone:
      return {{0.0, -2.0 * reach}, {kTurn, 2.0 * reach}};
    case SurfaceKind::kSphere:
      return {{0.0, -kHalfTurn}, {kTurn, kHalfTurn}};
    case SurfaceKind::kTorus:
      return {Vec2(0.0), Vec2(kTurn)};
    case SurfaceKind::kExtrusion: {
      const Vec2 range = rangeOf(surface.profile, target);
      double farthest = 0.0;
      for (std::size_t i = 0; i <= kCoedgeSamples; ++i) {
        const double t = range.x + (range.y - range.x) * static_cast<double>(i) / kCoedgeSamples;
        farthest = std::max(farthest, glm::length(target - evaluate(surface.profile, t).position));
      }
      return {{range.x, -farthest}, {range.y, farthest}};
    }
    case SurfaceKind::kRevolution: {
      const Vec2 range = rangeOf(surface.profile, target);
      return {{0.0, range.x}, {kTurn, range.y}};
    }
    case SurfaceKind::kBSpline:
      break;
  }
  constexpr double kFar = std::numeric_limits<double>::max();
  return {clampedToDomain(surface, Vec2(-kFar)), clampedToDomain(surface, Vec2(kFar))};
}

double nearestCopy(double value, double reference, double period) {
  return period > 0.0 ? value + period * std::floor((reference - value) / period + 0.5) : value;
}

}  // namespace

Vec2 periodsOf(const FaceSurface& surface) {
  const bool hasClosedProfile =
      surface.profile.kind == CurveKind::kCircle || surface.profile.kind == CurveKind::kEllipse;
  switch (surface.kind) {
    case SurfaceKind::kCylinder:
    case SurfaceKind::kCone:
    case SurfaceKind::kSphere:
      return {kTurn, 0.0};
    case SurfaceKind::kTorus:
      return {kTurn, kTurn};
    case SurfaceKind::kExtrusion:
      return {hasClosedProfile ? kTurn : 0.0, 0.0};
    case SurfaceKind::kRevolution:
      return {kTurn, hasClosedProfile ? kTurn : 0.0};
    case SurfaceKind::kPlane:
    case SurfaceKind::kBSpline:
      break;
  }
  return Vec2(0.0);
}

FaceLoops::FaceLoops(const TrimmedModel& model, const TrimmedFace& face)
    : model_(&model), surface_(&model.surfaces[face.surface]) {
  for (const std::vector<Coedge>& loop : face.loops) {
    std::vector<const Coedge*> kept;
    for (const Coedge& coedge : loop)
      if (model.edges[coedge.edge].curve) kept.push_back(&coedge);
    if (!kept.empty()) loops_.push_back(std::move(kept));
  }
  sampleLoops();
  checkJunctions();
}

void FaceLoops::sampleLoops() {
  constexpr double kFar = std::numeric_limits<double>::max();
  box_ = {Vec2(kFar), Vec2(-kFar)};
  for (std::size_t loop = 0; loop < loops_.size(); ++loop) {
    samples_.emplace_back();
    const Vec2* before = nullptr;
    for (std::size_t index = 0; index < loops_[loop].size(); ++index) {
      project(loop, index, before);
      before = &samples_[loop][index].back();
      for (const Vec2& uv : samples_[loop][index])
        box_ = {glm::min(box_.low, uv), glm::max(box_.high, uv)};
    }
  }
}

/// Samples a coedge by its curve in the plane, or by projection: on a periodic surface, near the coedge before it.
void FaceLoops::project(std::size_t loop, std::size_t index, const Vec2* before) {
  const Coedge& coedge = *loops_[loop][index];
  const EdgeCurve curve(*model_, model_->edges[coedge.edge]);
  const Vec2 periods = periodsOf(*surface_);
  std::vector<Vec2> samples;
  for (std::size_t i = 0; i <= kCoedgeSamples; ++i) {
    const double part = static_cast<double>(i) / kCoedgeSamples;
    const double t = coedge.reversed ? 1.0 - part : part;
    if (coedge.inPlane) {
      samples.push_back(evaluate(*coedge.inPlane, curve.parameterAt(t)).position);
      continue;
    }
    const Vec3 position = curve.position(t);
    Vec2 uv = closestParameters(*surface_, searchBox(*surface_, position), position);
    const Vec2* near = samples.empty() ? before : &samples.back();
    if (near != nullptr)
      uv = {nearestCopy(uv.x, near->x, periods.x), nearestCopy(uv.y, near->y, periods.y)};
    samples.push_back(uv);
  }
  samples_[loop].push_back(std::move(samples));
}

Vec2 FaceLoops::parametersAt(std::size_t loop, std::size_t index, double t,
                             const Vec3& position) const {
  const Coedge& coedge = *loops_[loop][index];
  const TrimmedEdge& edge = model_->edges[coedge.edge];
  if (coedge.inPlane) {
    const double parameter = t < 1.0 ? edge.first + t * (edge.last - edge.first) : edge.last;
    return evaluate(*coedge.inPlane, parameter).position;
  }
  const double along = (coedge.reversed ? 1.0 - t : t) * kCoedgeSamples;
  const auto first = std::min(static_cast<std::size_t>(along), kCoedgeSamples - 1);
  const std::vector<Vec2>& samples = samples_[loop][index];
  const Vec2 start =
      samples[first] + (along - static_cast<double>(first)) * (samples[first + 1] - samples[first]);
  const Vec2 reach = box_.high - box_.low;
  return closestParametersFrom(*surface_, {box_.low - reach, box_.high + reach}, position, start);
}

/// Finds the poles and open places: where a coedge does not begin at the end of the one before it.
void FaceLoops::checkJunctions() {
  const Vec2 extent = box_.high - box_.low;
  for (std::uint32_t loop = 0; loop < loops_.size(); ++loop) {
    const std::vector<std::vector<Vec2>>& samples = samples_[loop];
    for (std::uint32_t index = 0; index < samples.size(); ++index) {
      const Vec2 from = (index == 0 ? samples.back() : samples[index - 1]).back();
      const Vec2 to = samples[index].front();
      const Vec2 gap = glm::abs(to - from);
      if (!(gap.x > kLargeGap * extent.x) && !(gap.y > kLargeGap * extent.y)) continue;
      const Vec3 pole = evaluate(*surface_, from).position;
      const Vec3 between = evaluate(*surface_, 0.5 * (from + to)).position;
      const Vec3 far = evaluate(*surface_, 0.5 * (box_.low + box_.high)).position;
      // A narrow face may have a gap that is wide in its plane and small in space.
      const double gapInSpace = glm::length(evaluate(*surface_, to).position - pole);
      const Vec3 low = evaluate(*surface_, box_.low).position;
      const Vec3 high = evaluate(*surface_, box_.high).position;
      if (glm::length(between - pole) <= kPoleTolerance * glm::length(far - pole)) {
        addPole(from, to);
      } else if (!open_ && gapInSpace > kLargeGap * glm::length(high - low)) {
        open_ = OpenJunction{loop, index};
      }
    }
  }
}

void FaceLoops::addPole(const Vec2& from, const Vec2& to) {
  const Vec2 gap = glm::abs(to - from) / (box_.high - box_.low);
  const Vec2 middle = 0.5 * (box_.low + box_.high);
  if (gap.x > gap.y) {
    (from.y < middle.y ? poles_.vLow : poles_.vHigh) = true;
  } else {
    (from.x < middle.x ? poles_.uLow : poles_.uHigh) = true;
  }
}

bool FaceLoops::isUsable() const {
  return !loops_.empty() && !open_ && !poles_.isMixed() && box_.high.x > box_.low.x &&
         box_.high.y > box_.low.y;
}

}  // namespace tetrafront
