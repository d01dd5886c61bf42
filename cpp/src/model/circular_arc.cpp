// Positions are relative to the start: from there, an arc of a huge circle is as exact as its own
// length permits. With half the angle, h, p - start = 2 sin h (cos h forward - sin h radius).

#include "model/circular_arc.h"

#include <numbers>

#include "geom/sine.h"

namespace tetrafront {

CircularArc::CircularArc(const Vec3& start, const Vec3& second, const Vec3& third) : start_(start) {
  const Vec3 a = second - start;
  const Vec3 b = third - start;
  const Vec3 normal = glm::cross(a, b);
  const double squared = glm::dot(normal, normal);
  const Vec3 toCentre =
      glm::cross(glm::dot(a, a) * b - glm::dot(b, b) * a, normal) / (2.0 * squared);
  radius_ = -toCentre;
  forward_ = glm::cross(normal, radius_) / glm::length(normal);
}

CircularArc CircularArc::through(const Vec3& start, const Vec3& middle, const Vec3& end) {
  CircularArc arc(start, middle, end);
  arc.angle_ = arc.angleAt(end);
  return arc;
}

CircularArc CircularArc::circleThrough(const Vec3& start, const Vec3& second, const Vec3& third) {
  CircularArc circle(start, second, third);
  circle.angle_ = 2.0 * std::numbers::pi;
  return circle;
}

double CircularArc::angleAt(const Vec3& position) const {
  const Vec3 fromCentre = radius_ + (position - start_);
  return angleOf({glm::dot(fromCentre, radius_), glm::dot(fromCentre, forward_)});
}

double CircularArc::parameterOf(const Vec3& position) const { return angleAt(position) / angle_; }

Vec3 CircularArc::position(double t) const {
  const auto [sine, cosine] = sineCosine(0.5 * t * angle_);
  return start_ + (2.0 * sine) * (cosine * forward_ - sine * radius_);
}

Vec3 CircularArc::derivative(double t) const {
  const auto [sine, cosine] = sineCosine(t * angle_);
  return angle_ * (cosine * forward_ - sine * radius_);
}

Vec3 CircularArc::secondDerivative(double t) const {
  const auto [sine, cosine] = sineCosine(t * angle_);
  return (-angle_ * angle_) * (sine * forward_ + cosine * radius_);
}

}  // namespace tetrafront
