#include "model/loft_surface.h"

#include <algorithm>
#include <utility>

namespace tetrafront {

std::optional<double> parameterOfPoint(const OrientedCurve& line, const Vec3& position) {
  const std::span<const Vec3> points = line.points();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    if (points[i] != position) continue;
    return line.parameterOfPoint(i);
  }
  return std::nullopt;
}

LoftSurface::LoftSurface(std::span<const OrientedCurve> loop,
                         std::span<const OrientedCurve> sections)
    : sides_{loop[3].reverse(), loop[1]} {
  rows_.push_back(loop[0]);
  rows_.insert(rows_.end(), sections.begin(), sections.end());
  rows_.push_back(loop[2].reverse());
  std::vector<Vec3> starts;
  std::vector<Vec3> ends;
  for (const OrientedCurve& row : rows_) {
    starts.push_back(row.start());
    ends.push_back(row.position(1.0));
  }
  const auto knotsOn = [&](const OrientedCurve& side, const std::vector<Vec3>& positions) {
    std::vector<double> knots(positions.size(), 0.0);
    for (std::size_t i = 1; i + 1 < knots.size(); ++i)
      knots[i] = parameterOfPoint(side, positions[i]).value_or(0.0);
    knots.back() = 1.0;
    return knots;
  };
  firstKnots_ = knotsOn(sides_[0], starts);
  secondKnots_ = knotsOn(sides_[1], ends);
  ends_ = {CubicSpline<Vec3>(firstKnots_, std::move(starts)),
           CubicSpline<Vec3>(secondKnots_, std::move(ends))};
}

LoftSurface::Across LoftSurface::splineAt(const Vec2& unit) const {
  const std::size_t count = rows_.size();
  const std::size_t last = count - 1;
  std::vector<double> knots(count);
  std::vector<double> knotsBy(count);  // derivatives with respect to xi
  std::vector<Vec3> values(count);
  std::vector<Vec3> valuesBy(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Curve::Sample sample = rows_[i].sample(unit.x);
    values[i] = sample.position;
    valuesBy[i] = sample.derivative;
    knots[i] = (1.0 - unit.x) * firstKnots_[i] + unit.x * secondKnots_[i];
    knotsBy[i] = secondKnots_[i] - firstKnots_[i];
  }
  // The second derivatives m solve A(knots) m = sides(knots, values); so A m' = sides' - A' m.
  std::vector<Vec3> chords(last);
  std::vector<Vec3> chordsBy(last);
  std::vector<double> stepsBy(last);
  for (std::size_t i = 0; i < last; ++i) {
    const double step = knots[i + 1] - knots[i];
    stepsBy[i] = knotsBy[i + 1] - knotsBy[i];
    chords[i] = (values[i + 1] - values[i]) / step;
    chordsBy[i] = (valuesBy[i + 1] - valuesBy[i] - stepsBy[i] * chords[i]) / step;
  }
  std::vector<Vec3> sides(count, Vec3(0.0));
  for (std::size_t i = 1; i < last; ++i) sides[i] = 6.0 * (chords[i] - chords[i - 1]);
  const SplineEquations equations(knots);
  const std::vector<Vec3> seconds = equations.solve(std::move(sides));
  std::vector<Vec3> sidesBy(count, Vec3(0.0));
  for (std::size_t i = 1; i < last; ++i) {
    sidesBy[i] = 6.0 * (chordsBy[i] - chordsBy[i - 1]) -
                 (stepsBy[i - 1] * seconds[i - 1] +
                  2.0 * (stepsBy[i - 1] + stepsBy[i]) * seconds[i] + stepsBy[i] * seconds[i + 1]);
  }
  const std::vector<Vec3> secondsBy = equations.solve(std::move(sidesBy));

  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, unit.y);
  const auto i = static_cast<std::size_t>(above - knots.begin()) - 1;
  const double step = knots[i + 1] - knots[i];
  const double b = (unit.y - knots[i]) / step;
  const double a = 1.0 - b;
  const double bBy = -(knotsBy[i] + b * stepsBy[i]) / step;
  const double weight = step * step / 6.0;
  const double weightBy = step * stepsBy[i] / 3.0;
  const auto cubic = [](double share) { return share * share * share - share; };
  const Vec3 bend = cubic(a) * seconds[i] + cubic(b) * seconds[i + 1];
  Across result;
  result.value = (a * values[i] + b * values[i + 1]) + weight * bend;
  const Vec3 byB = (values[i + 1] - values[i]) + weight * ((3.0 * b * b - 1.0) * seconds[i + 1] -
                                                           (3.0 * a * a - 1.0) * seconds[i]);
  result.byEta = byB / step;
  result.byXi = (a * valuesBy[i] + b * valuesBy[i + 1]) + weightBy * bend +
                weight * (cubic(a) * secondsBy[i] + cubic(b) * secondsBy[i + 1]) + bBy * byB;
  return result;
}

SurfacePoint LoftSurface::evaluate(const Vec2& unit) const {
  const Across spline = splineAt(unit);
  SurfacePoint result{spline.value, spline.byXi, spline.byEta};
  for (std::size_t side = 0; side < 2; ++side) {
    const Curve::Sample onSide = sides_[side].sample(unit.y);
    const CubicSpline<Vec3>::Sample end = ends_[side].sample(unit.y);
    const Vec3 deviation = onSide.position - end.value;
    const double share = side == 0 ? 1.0 - unit.x : unit.x;
    result.position += share * deviation;
    result.alongXi += side == 0 ? -deviation : deviation;
    result.alongEta += share * (onSide.derivative - end.first);
  }
  return result;
}

}  // namespace tetrafront
