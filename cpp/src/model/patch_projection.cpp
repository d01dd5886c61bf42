#include "model/patch_projection.h"

#include <algorithm>
#include <cmath>

namespace tetrafront {

namespace {

/// Cells per direction of the lattice of starting points: finer than the bends of drawn patches.
constexpr int kLattice = 24;
/// Largest number of steps. Newton's method takes about five; near singular corners it is slower.
constexpr int kMaxSteps = 40;
/// Halvings of a step that increases the distance.
constexpr int kMaxHalvings = 8;
/// Steps shorter than this, relative to the patch's extent, only change rounding.
constexpr double kSettled = 1e-15;
/// Keeps the system solvable where the surface is singular.
constexpr double kMinPivot = 1e-12;

}  // namespace

PatchProjection::PatchProjection(const PatchSurface& surface) : surface_(&surface) {
  const MappedSurface& mapped = *surface.mapped();
  const bool isTriangle = mapped.unitSurface().shape() == UnitShape::kTriangle;
  for (int j = 0; j <= kLattice; ++j) {
    for (int i = 0; i <= (isTriangle ? kLattice - j : kLattice); ++i) {
      const Vec2 unit(static_cast<double>(i) / kLattice, static_cast<double>(j) / kLattice);
      const Vec2 plane = surface.clamped(mapped.stretchedPlane().toPlane(unit));
      samples_.push_back({plane, surface.evaluate(plane).position});
    }
  }
  for (const Sample& sample : samples_)
    extent_ = std::max(extent_, glm::length(sample.position - samples_.front().position));
}

/// Step in the plane whose image approaches the target best: (J^T J) step = J^T offset.
Vec2 PatchProjection::step(const Vec2& from, const Vec3& target) const {
  const SurfacePoint point = surface_->evaluate(from);
  const Vec3 offset = target - point.position;
  double xx = glm::dot(point.alongXi, point.alongXi);
  const double xy = glm::dot(point.alongXi, point.alongEta);
  double yy = glm::dot(point.alongEta, point.alongEta);
  const double least = kMinPivot * (xx + yy);
  xx += least;
  yy += least;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0.0)) return Vec2(0.0);
  const Vec2 right(glm::dot(point.alongXi, offset), glm::dot(point.alongEta, offset));
  return {(yy * right.x - xy * right.y) / determinant, (xx * right.y - xy * right.x) / determinant};
}

PatchProjection::Foot PatchProjection::project(const Vec3& target) const {
  const auto distanceFrom = [&](const Vec3& position) { return glm::length(target - position); };
  Foot foot{samples_.front().plane, distanceFrom(samples_.front().position)};
  for (const Sample& sample : samples_) {
    const double distance = distanceFrom(sample.position);
    if (distance < foot.distance) foot = {sample.plane, distance};
  }
  Vec3 position = surface_->evaluate(foot.plane).position;
  for (int round = 0; round < kMaxSteps; ++round) {
    Vec2 along = step(foot.plane, target);
    Foot next = foot;
    Vec3 nextPosition = position;
    for (int halving = 0; halving <= kMaxHalvings; ++halving, along *= 0.5) {
      next.plane = surface_->clamped(foot.plane + along);
      nextPosition = surface_->evaluate(next.plane).position;
      next.distance = distanceFrom(nextPosition);
      if (next.distance < foot.distance) break;
    }
    if (!(next.distance < foot.distance)) break;
    const bool settled = glm::length(nextPosition - position) <= kSettled * extent_;
    foot = next;
    position = nextPosition;
    if (settled) break;
  }
  return foot;
}

}  // namespace tetrafront
