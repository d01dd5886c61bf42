#include "model/smooth_surface.h"

#include <algorithm>
#include <cmath>

#include "model/hermite_cubics.h"

namespace tetrafront {

namespace {

/// Sine of the angle of two lines below which a corner has no tangent plane of its own: rounding of unit tangents, about 1e-16, would
/// turn the plane by more than 1e-7.
constexpr double kMinCornerSine = 1e-9;

/// Cosine of the angle of two lines above which the mean of their slopes has no clear direction: 170 degrees.
constexpr double kMinCornerCosine = -0.984807753012208;

/// Returns the normal at the corner between a line and the one before it; `fallback` where both have one direction.
Vec3 cornerNormal(const OrientedCurve& before, const OrientedCurve& line, const Vec3& fallback) {
  const Vec3 along = unitTangent(line, 0.0);
  const Vec3 normal = glm::cross(unitTangent(before, 1.0), along);
  const double sine = glm::length(normal);
  if (sine > kMinCornerSine) return normal / sine;
  const Vec3 across = fallback - glm::dot(fallback, along) * along;
  const double length = glm::length(across);
  if (length > 0.0) return across / length;
  // Any normal will do: the patch has no area here.
  const Vec3 axis = std::fabs(along.x) < 0.5 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
  return glm::normalize(glm::cross(along, axis));
}

/// Normals at the starts of the lines of a loop.
template <std::size_t N>
std::array<Vec3, N> cornerNormals(std::span<const OrientedCurve> loop) {
  Vec3 area(0.0);
  const Vec3& origin = loop[0].start();
  for (const OrientedCurve& line : loop)
    area += glm::cross(line.start() - origin, line.position(0.5) - origin) +
            glm::cross(line.position(0.5) - origin, line.position(1.0) - origin);
  const double length = glm::length(area);
  const Vec3 fallback = length > 0.0 ? area / length : Vec3(0.0, 0.0, 1.0);
  std::array<Vec3, N> normals;
  for (std::size_t i = 0; i < N; ++i)
    normals[i] = cornerNormal(loop[(i + N - 1) % N], loop[i], fallback);
  return normals;
}

Vec3 slopeAt(const OrientedCurve& line, double t) { return line.sample(t).derivative; }

}  // namespace

// ---- Gregory -------------------------------------------------------------------------------------

namespace {

std::array<CrossField, 4> squareFields(std::span<const OrientedCurve> loop) {
  const std::array<Vec3, 4> normals = cornerNormals<4>(loop);
  const std::array<OrientedCurve, 4> lines{loop[0], loop[1], loop[2].reverse(), loop[3].reverse()};
  // F1 and F3 are crossed along F4 and F2, in the direction of eta; F4 and F2 along F1 and F3. The normals at the ends of a
  // line are on the same side, whichever its direction.
  const auto& [f1, f2, f3, f4] = lines;
  const auto& [a, b, c, d] = normals;
  return {CrossField(f1, a, b, slopeAt(f4, 0.0), slopeAt(f2, 0.0)),
          CrossField(f2, b, c, slopeAt(f1, 1.0), slopeAt(f3, 1.0)),
          CrossField(f3, d, c, slopeAt(f4, 1.0), slopeAt(f2, 1.0)),
          CrossField(f4, a, d, slopeAt(f1, 0.0), slopeAt(f3, 0.0))};
}

}  // namespace

GregorySurface::GregorySurface(std::span<const OrientedCurve> loop)
    : lines_{loop[0], loop[1], loop[2].reverse(), loop[3].reverse()}, across_(squareFields(loop)) {
  const auto twist = [&](std::size_t line, double t) {
    return across_[line].sample(t, lines_[line].sample(t)).change;
  };
  for (std::size_t end = 0; end < 2; ++end) {
    const auto t = static_cast<double>(end);
    twistAlongXi_[end] = {twist(0, t), twist(2, t)};
    twistAlongEta_[0][end] = twist(3, t);
    twistAlongEta_[1][end] = twist(1, t);
  }
}

SurfacePoint GregorySurface::evaluate(const Vec2& unit) const {
  const double xi = unit.x;
  const double eta = unit.y;
  const HermiteBasis hx = HermiteBasis::at(xi);
  const HermiteBasis dx = HermiteBasis::derivativeAt(xi);
  const HermiteBasis hy = HermiteBasis::at(eta);
  const HermiteBasis dy = HermiteBasis::derivativeAt(eta);
  const Curve::Sample f1 = lines_[0].sample(xi);
  const Curve::Sample f2 = lines_[1].sample(eta);
  const Curve::Sample f3 = lines_[2].sample(xi);
  const Curve::Sample f4 = lines_[3].sample(eta);
  const CrossField::Sample d1 = across_[0].sample(xi, f1);
  const CrossField::Sample d2 = across_[1].sample(eta, f2);
  const CrossField::Sample d3 = across_[2].sample(xi, f3);
  const CrossField::Sample d4 = across_[3].sample(eta, f4);

  const auto blend = [](const HermiteBasis& h, const Vec3& start, const Vec3& end,
                        const Vec3& startSlope, const Vec3& endSlope) {
    return (h.start * start + h.end * end) + (h.startSlope * startSlope + h.endSlope * endSlope);
  };
  SurfacePoint result;
  result.position = blend(hy, f1.position, f3.position, d1.across, d3.across) +
                    blend(hx, f4.position, f2.position, d4.across, d2.across);
  result.alongXi = blend(hy, f1.derivative, f3.derivative, d1.change, d3.change) +
                   blend(dx, f4.position, f2.position, d4.across, d2.across);
  result.alongEta = blend(dy, f1.position, f3.position, d1.across, d3.across) +
                    blend(hx, f4.derivative, f2.derivative, d4.change, d2.change);

  // What both blends contain: the corners, their slopes and twists.
  const std::array<double, 2> fromXi{xi, 1.0 - xi};
  const std::array<double, 2> fromEta{eta, 1.0 - eta};
  const std::array<double, 2> sign{1.0, -1.0};
  const std::array<std::array<double, 2>, 2> atX{
      {{hx.start, hx.startSlope}, {hx.end, hx.endSlope}}};
  const std::array<std::array<double, 2>, 2> byX{
      {{dx.start, dx.startSlope}, {dx.end, dx.endSlope}}};
  const std::array<std::array<double, 2>, 2> atY{
      {{hy.start, hy.startSlope}, {hy.end, hy.endSlope}}};
  const std::array<std::array<double, 2>, 2> byY{
      {{dy.start, dy.startSlope}, {dy.end, dy.endSlope}}};
  for (std::size_t i = 0; i < 2; ++i) {
    const OrientedCurve& column = lines_[i == 0 ? 3 : 1];
    for (std::size_t j = 0; j < 2; ++j) {
      const auto t = static_cast<double>(j);
      const auto s = static_cast<double>(i);
      const OrientedCurve& row = lines_[j == 0 ? 0 : 2];
      const Curve::Sample up = column.sample(t);
      const Vec3 along = slopeAt(row, s);
      // Near the line at this eta (distance 0 in eta), the twist is the one of the line at this xi, and vice versa.
      const double total = fromXi[i] + fromEta[j];
      const double share = total > 0.0 ? fromXi[i] / total : 0.5;
      const Vec3 difference = twistAlongEta_[i][j] - twistAlongXi_[i][j];
      const Vec3 twist = twistAlongXi_[i][j] + share * difference;
      const double byFromXi = total > 0.0 ? fromEta[j] / (total * total) : 0.0;
      const double byFromEta = total > 0.0 ? -fromXi[i] / (total * total) : 0.0;
      const auto& [px, sx] = atX[i];
      const auto& [py, sy] = atY[j];
      const auto& [pxBy, sxBy] = byX[i];
      const auto& [pyBy, syBy] = byY[j];
      result.position -=
          px * (py * up.position + sy * up.derivative) + sx * (py * along + sy * twist);
      result.alongXi -= pxBy * (py * up.position + sy * up.derivative) +
                        sxBy * (py * along + sy * twist) +
                        (sx * sy * sign[i] * byFromXi) * difference;
      result.alongEta -= px * (pyBy * up.position + syBy * up.derivative) +
                         sx * (pyBy * along + syBy * twist) +
                         (sx * sy * sign[j] * byFromEta) * difference;
    }
  }
  return result;
}

// ---- Nielson -------------------------------------------------------------------------------------

namespace {

std::array<CrossField, 3> triangleFields(std::span<const OrientedCurve> loop) {
  const std::array<Vec3, 3> normals = cornerNormals<3>(loop);
  const auto field = [&](std::size_t i) {
    const std::size_t next = (i + 1) % 3;
    const std::size_t last = (i + 2) % 3;
    // From the corner opposite of line i, a cubic ends along `last` at the start of line i, and against `next` at its end.
    return CrossField(loop[i], normals[i], normals[next], slopeAt(loop[last], 1.0),
                      -slopeAt(loop[next], 0.0));
  };
  return {field(0), field(1), field(2)};
}

}  // namespace

NielsonSurface::NielsonSurface(std::span<const OrientedCurve> loop)
    : lines_{loop[0], loop[1], loop[2]}, across_(triangleFields(loop)) {}

NielsonSurface::Departure NielsonSurface::departureFrom(std::size_t corner, double s,
                                                        const CrossField::Sample& arrival) const {
  const OrientedCurve& leaving = lines_[corner];
  const OrientedCurve& arriving = lines_[(corner + 2) % 3];
  const Vec3 toNext = slopeAt(leaving, 0.0);
  const Vec3 toLast = -slopeAt(arriving, 1.0);
  Departure departure{(1.0 - s) * toNext + s * toLast, toLast - toNext};
  const double atNext = glm::length(slopeAt(leaving, 1.0));
  const double atLast = glm::length(slopeAt(arriving, 0.0));
  const double length = glm::length(departure.slope);
  const double arrivalLength = glm::length(arrival.across);
  const double cosine = glm::dot(toNext, toLast) / (glm::length(toNext) * glm::length(toLast));
  if (!(cosine > kMinCornerCosine) || !(atNext > 0.0) || !(atLast > 0.0) || !(arrivalLength > 0.0))
    return departure;
  // A cubic needs slopes of about its own length. The mean of two slopes is shorter, so only its direction is kept: the
  // length is in proportion to that of the slope at the opposite line, as it is on the lines beside.
  const double ratioNext = glm::length(toNext) / atNext;
  const double ratioLast = glm::length(toLast) / atLast;
  const double ratio = (1.0 - s) * ratioNext + s * ratioLast;
  const double size = ratio * arrivalLength;
  const double sizeBy = (ratioLast - ratioNext) * arrivalLength +
                        ratio * glm::dot(arrival.across, arrival.change) / arrivalLength;
  const Vec3 direction = departure.slope / length;
  departure.change =
      sizeBy * direction +
      (size / length) * (departure.change - glm::dot(direction, departure.change) * direction);
  departure.slope = size * direction;
  return departure;
}

NielsonSurface::Fan NielsonSurface::fanFrom(std::size_t corner, double next, double last) const {
  const OrientedCurve& leaving = lines_[corner];
  const std::size_t opposite = (corner + 1) % 3;
  const double r = next + last;
  const double s = r > 0.0 ? last / r : 0.5;
  const Curve::Sample onLine = lines_[opposite].sample(s);
  const CrossField::Sample across = across_[opposite].sample(s, onLine);
  const Departure departure = departureFrom(corner, s, across);
  const Vec3& apex = leaving.start();
  const HermiteBasis h = HermiteBasis::at(r);
  const HermiteBasis d = HermiteBasis::derivativeAt(r);
  Fan fan;
  fan.position = (h.start * apex + h.end * onLine.position) +
                 (h.startSlope * departure.slope + h.endSlope * across.across);
  const Vec3 byR = (d.start * apex + d.end * onLine.position) +
                   (d.startSlope * departure.slope + d.endSlope * across.across);
  // The derivative with respect to s, divided by r: both vanish at the corner.
  const Vec3 byS = (r * (3.0 - 2.0 * r)) * onLine.derivative +
                   ((1.0 - r) * (1.0 - r)) * departure.change - (r * (1.0 - r)) * across.change;
  fan.byNext = byR - s * byS;
  fan.byLast = byR + (1.0 - s) * byS;
  return fan;
}

SurfacePoint NielsonSurface::atCorner(std::size_t corner) const {
  const Vec3 toNext = slopeAt(lines_[corner], 0.0);
  const Vec3 toLast = -slopeAt(lines_[(corner + 2) % 3], 1.0);
  // By the barycentric coordinates of P1, P2 and P3, of which the first is 1 - xi - eta.
  std::array<Vec3, 3> by;
  by[corner] = Vec3(0.0);
  by[(corner + 1) % 3] = toNext;
  by[(corner + 2) % 3] = toLast;
  return {lines_[corner].start(), by[1] - by[0], by[2] - by[0]};
}

SurfacePoint NielsonSurface::evaluate(const Vec2& unit) const {
  const std::array<double, 3> b{(1.0 - unit.x) - unit.y, unit.x, unit.y};
  // The weight of the fan from corner i is (b_j b_k)^2, divided by their sum.
  std::array<double, 3> products;
  for (std::size_t i = 0; i < 3; ++i) products[i] = b[(i + 1) % 3] * b[(i + 2) % 3];
  double sum = 0.0;
  for (const double product : products) sum += product * product;
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(b) - b.begin());
  if (!(sum > 0.0)) return atCorner(largest);

  Vec3 position(0.0);
  std::array<Vec3, 3> by{};         // sums of weights times derivatives with respect to b
  std::array<Vec3, 3> byWeights{};  // sums of derivatives of the numerators times positions
  std::array<double, 3> sumBy{};    // derivatives of the sum
  const Vec3& origin = lines_[largest].start();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const Fan fan = fanFrom(i, b[j], b[k]);
    const double weight = products[i] * products[i] / sum;
    // Relative to the corner nearby, where the derivatives of the weights are large.
    const Vec3 relative = fan.position - origin;
    position += weight * relative;
    by[j] += weight * fan.byNext;
    by[k] += weight * fan.byLast;
    const double byJ = 2.0 * products[i] * b[k];
    const double byK = 2.0 * products[i] * b[j];
    byWeights[j] += byJ * relative;
    byWeights[k] += byK * relative;
    sumBy[j] += byJ;
    sumBy[k] += byK;
  }
  std::array<Vec3, 3> derivatives;
  for (std::size_t i = 0; i < 3; ++i)
    derivatives[i] = by[i] + (byWeights[i] - sumBy[i] * position) / sum;
  return {origin + position, derivatives[1] - derivatives[0], derivatives[2] - derivatives[0]};
}

}  // namespace tetrafront
