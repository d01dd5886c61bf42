#include "model/planar_surface.h"

namespace tetrafront {

PlanarSurface::PlanarSurface(const Vec3& origin, const Vec3& normal, const Vec3& firstDirection)
    : origin_(origin), normal_(glm::normalize(normal)) {
  first_ = glm::normalize(firstDirection - glm::dot(firstDirection, normal_) * normal_);
  second_ = glm::cross(normal_, first_);
}

SurfacePoint PlanarSurface::evaluate(const Vec2& plane) const {
  return {origin_ + (plane.x * first_ + plane.y * second_), first_, second_};
}

Vec2 PlanarSurface::project(const Vec3& position) const {
  const Vec3 offset = position - origin_;
  return {glm::dot(first_, offset), glm::dot(second_, offset)};
}

double PlanarSurface::distance(const Vec3& position) const {
  return glm::dot(normal_, position - origin_);
}

}  // namespace tetrafront
