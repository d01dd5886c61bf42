#include "model/cross_field.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/tolerance.h"

namespace tetrafront {

namespace {

/// Pieces of a smooth span of a line between which B is carried: on a circle of one span, 22.5 degrees apart.
constexpr std::size_t kStepsPerSpan = 16;
/// Pieces of a line of many spans: more would cost more than they show.
constexpr std::size_t kFewSteps = 4;
constexpr std::size_t kManySpans = 8;

Vec3 reflected(const Vec3& vector, const Vec3& normal) {
  const double squared = glm::dot(normal, normal);
  // Reflection at a plane without normal: both ends are the same up to rounding.
  if (!(squared > 0.0)) return vector;
  return vector - (2.0 * glm::dot(normal, vector) / squared) * normal;
}

struct Station {
  double t;
  Vec3 position;
  Vec3 tangent;
};

std::vector<Station> stationsOf(const OrientedCurve& line) {
  std::vector<Station> stations;
  const std::size_t spans = line.knotCount() - 1;
  const std::size_t steps = spans > kManySpans ? kFewSteps : kStepsPerSpan;
  for (std::size_t span = 0; span < spans; ++span) {
    const double from = line.knot(span);
    const double width = line.knot(span + 1) - from;
    for (std::size_t i = 0; i < steps; ++i) {
      const double t = from + width * (static_cast<double>(i) / static_cast<double>(steps));
      stations.push_back({t, line.position(t), unitTangent(line, t)});
    }
  }
  stations.push_back({1.0, line.position(1.0), unitTangent(line, 1.0)});
  return stations;
}

/// Carries a vector perpendicular to the line from one station to another without rotation about the line. The way back
/// undoes it.
Vec3 carried(const Vec3& vector, const Station& from, const Station& to) {
  const Vec3 chord = to.position - from.position;
  const Vec3 turn = to.tangent - reflected(from.tangent, chord);
  return reflected(reflected(vector, chord), turn);
}

CubicSpline<Vec3> directionAlong(const OrientedCurve& line, const Vec3& start, const Vec3& end) {
  const std::vector<Station> stations = stationsOf(line);
  const std::size_t last = stations.size() - 1;
  std::vector<double> knots(stations.size());
  std::vector<Vec3> forward(stations.size(), start);
  std::vector<Vec3> backward(stations.size(), end);
  for (std::size_t i = 0; i < last; ++i)
    forward[i + 1] = carried(forward[i], stations[i], stations[i + 1]);
  for (std::size_t i = last; i > 0; --i)
    backward[i - 1] = carried(backward[i], stations[i], stations[i - 1]);
  std::vector<Vec3> directions(stations.size());
  for (std::size_t i = 0; i <= last; ++i) {
    const double t = stations[i].t;
    knots[i] = t;
    const Vec3 blend = (1.0 - t) * forward[i] + t * backward[i];
    const double length = glm::length(blend);
    // Opposite directions have no blend; the forward one bends the surface where it has to bend anyway.
    directions[i] = length > Tolerance::kCoincidence ? blend / length : forward[i];
  }
  directions.front() = start;
  directions.back() = end;
  return {std::move(knots), std::move(directions)};
}

}  // namespace

Vec3 unitTangent(const OrientedCurve& line, double t) {
  const Vec3 derivative = line.sample(t).derivative;
  const double length = glm::length(derivative);
  if (length > 0.0) return derivative / length;
  const Vec3 chord = line.position(1.0) - line.position(0.0);
  const double span = glm::length(chord);
  return span > 0.0 ? chord / span : Vec3(1.0, 0.0, 0.0);
}

CrossField::CrossField(const OrientedCurve& line, const Vec3& startNormal, const Vec3& endNormal,
                       const Vec3& startDerivative, const Vec3& endDerivative)
    : line_(line) {
  const auto sharesOf = [&](double t, const Vec3& direction, const Vec3& across) -> Shares {
    const Vec3 along = line.sample(t).derivative;
    const double squared = glm::dot(along, along);
    return {squared > 0.0 ? glm::dot(across, along) / squared : 0.0, glm::dot(across, direction)};
  };
  const Vec3 start = glm::cross(startNormal, unitTangent(line, 0.0));
  const Vec3 end = glm::cross(endNormal, unitTangent(line, 1.0));
  direction_ = directionAlong(line, start, end);
  start_ = sharesOf(0.0, start, startDerivative);
  end_ = sharesOf(1.0, end, endDerivative);
}

CrossField::Blend CrossField::tangentShare(double t) const {
  if (line_.type() != LineType::kHermite || line_.knotCount() == 2) {
    return {(1.0 - t) * start_.ofTangent + t * end_.ofTangent, end_.ofTangent - start_.ofTangent};
  }
  // The second derivative of a Hermite line jumps at its inner knots. There the share of the tangent must be zero, and so
  // its slope, or the patch would have a kink across the line.
  Blend blend{0.0, 0.0};
  const double first = line_.knot(1);
  const double final = 1.0 - line_.knot(line_.knotCount() - 2);
  const double toFirst = std::max(0.0, 1.0 - t / first);
  const double fromFinal = std::max(0.0, 1.0 - (1.0 - t) / final);
  blend.value = start_.ofTangent * toFirst * toFirst + end_.ofTangent * fromFinal * fromFinal;
  blend.slope =
      -2.0 * start_.ofTangent * toFirst / first + 2.0 * end_.ofTangent * fromFinal / final;
  return blend;
}

CrossField::Sample CrossField::sample(double t, const Curve::Sample& onLine) const {
  const CubicSpline<Vec3>::Sample direction = direction_.sample(t);
  const Blend along = tangentShare(t);
  const double share = (1.0 - t) * start_.ofDirection + t * end_.ofDirection;
  const double shareSlope = end_.ofDirection - start_.ofDirection;
  Sample result;
  result.across = along.value * onLine.derivative + share * direction.value;
  result.change = along.slope * onLine.derivative + along.value * line_.secondDerivative(t) +
                  shareSlope * direction.value + share * direction.first;
  return result;
}

}  // namespace tetrafront
