// The walk S1-S4 of the paper steps along a line; each step is as long as the target size at its middle. The last
// step rarely ends at the end of the line. The steps therefore only serve as stations at which the metric length
// lambda(t) = integral of |x'| / size is tabulated. The sides are equal increments of lambda, so that all of them are
// stretched or shrunk by the same factor, and not the last one alone.

#include "surface/line_mesher.h"

#include <algorithm>
#include <cmath>

#include "model/edge_curve.h"
#include "surface/rules.h"
#include "surface/surface_trace.h"

namespace tetrafront {

namespace {

/// An entry of the table of metric lengths: lambda at t, and its derivative.
struct Station {
  double t;
  double lambda;
  double rate;
};

template <class Line>
class LineWalker {
 public:
  LineWalker(const Line& curve, const SizeField& field) : curve_(&curve), field_(&field) {}

  /// Target length of a side at t.
  [[nodiscard]] double sizeAt(double t) {
    if (!field_->isStretched()) return field_->sizeAt(curve_->position(t), hint_);
    const auto at = curve_->sample(t);
    const double sides =
        glm::length(field_->tensorAt(at.position, hint_).inverse() * at.derivative);
    return sides > 0.0 ? glm::length(at.derivative) / sides : field_->sizeAt(at.position, hint_);
  }
  [[nodiscard]] bool covers(const Vec3& position) { return field_->covers(position, hint_); }

  /// d lambda / dt: sides per unit of the parameter.
  [[nodiscard]] double rateAt(double t) { return glm::length(curve_->derivative(t)) / sizeAt(t); }

  /// Returns the side that begins at t (S1-S3).
  SideStep step(double t) {
    const double speed = glm::length(curve_->derivative(t));
    const double start = sizeAt(t);
    SideStep capped{t + kMaxStep, start, start, 0, SideStep::End::kCapped};
    if (start >= kMaxStep * speed) return capped;
    const Settled settled = settleLength(t, speed, start);
    const double length = settled.length;
    const double middleSpeed =
        glm::length(curve_->derivative(std::min(1.0, t + 0.5 * length / speed)));
    capped.length = length;
    capped.rounds = settled.rounds;
    if (length >= kMaxStep * middleSpeed) return capped;
    return {t + length / middleSpeed, start, length, settled.rounds, SideStep::End::kSettled};
  }

 private:
  /// Target size at the middle of a tentative side of `length` (S2).
  double sizeAtMiddle(double t, double speed, double length) {
    return sizeAt(std::min(1.0, t + 0.5 * length / speed));
  }

  struct Settled {
    double length;
    int rounds;
  };
  Settled settleLength(double t, double speed, double length) {
    double tooShort = 0.0;
    double tooLong = kMaxStep * speed;
    int round = 0;
    for (; round < kMaxAverages + kMaxBisections; ++round) {
      const double target = sizeAtMiddle(t, speed, length);
      if (std::fabs(target - length) <= kStepTolerance * length) break;
      if (target > length)
        tooShort = std::max(tooShort, length);
      else
        tooLong = std::min(tooLong, length);
      length = 0.5 * (round < kMaxAverages ? length + target : tooShort + tooLong);
    }
    return {length, round};
  }

  const Line* curve_;
  const SizeField* field_;
  FieldHint hint_;
};

/// Adds stations up to `to`. Halves the interval until Simpson's rule is accurate.
template <class Line>
void integrate(LineWalker<Line>& walker, double to, double rateTo, int depth,
               std::vector<Station>& table) {
  const Station from = table.back();
  const double middle = 0.5 * (from.t + to);
  const double width = to - from.t;
  const double rateMiddle = walker.rateAt(middle);
  const double rateFirst = walker.rateAt(0.5 * (from.t + middle));
  const double rateSecond = walker.rateAt(0.5 * (middle + to));
  const double coarse = width / 6.0 * (from.rate + 4.0 * rateMiddle + rateTo);
  const double fine =
      width / 12.0 * (from.rate + 4.0 * rateFirst + 2.0 * rateMiddle + 4.0 * rateSecond + rateTo);
  if (depth >= kMaxStepHalvings || std::fabs(fine - coarse) <= kLengthTolerance) {
    table.push_back({to, from.lambda + fine, rateTo});
    return;
  }
  integrate(walker, middle, rateMiddle, depth + 1, table);
  integrate(walker, to, rateTo, depth + 1, table);
}

/// Returns a lower estimate of the number of sides from t to the end. Uses the lower rate of two neighbouring samples:
/// a single sample may lie on a source whose size occurs nowhere around it.
template <class Line>
double minSidesFrom(LineWalker<Line>& walker, double t) {
  const double width = (1.0 - t) / kSamplesAhead;
  double before = walker.rateAt(t);
  double sides = 0.0;
  for (int i = 1; i <= kSamplesAhead; ++i) {
    const double rate = walker.rateAt(std::min(1.0, t + i * width));
    sides += width * std::min(before, rate);
    before = rate;
  }
  return sides;
}

/// Tabulates the metric length over the steps of the walk. Returns false if there are too many steps, or if one is too
/// short to change the parameter.
template <class Line, class Trace>
bool tabulate(LineWalker<Line>& walker, const Line& curve, std::vector<Station>& table,
              Trace trace) {
  table.push_back({0.0, 0.0, walker.rateAt(0.0)});
  std::size_t nextKnot = 1;
  bool hasSampledAhead = false;
  while (table.back().t < 1.0) {
    if (!hasSampledAhead && table.size() > kLongTable) {
      hasSampledAhead = true;
      if (minSidesFrom(walker, table.back().t) > kCertainlyTooMany * kMaxSidesPerLine) return false;
    }
    const double knot = curve.knots()[nextKnot];
    SideStep step = walker.step(table.back().t);
    double to = step.to;
    // Extend a step that would leave a tiny interval before the knot.
    if (to >= knot - 1e-3 * (knot - table.back().t)) {
      to = knot;
      step.end = SideStep::End::kKnot;
      nextKnot = std::min(nextKnot + 1, curve.knots().size() - 1);
    }
    if (!(to > table.back().t)) return false;
    integrate(walker, to, walker.rateAt(to), 0, table);
    trace->station(step, to, table.back().lambda, curve);
    if (!(table.back().lambda <= kMaxSidesPerLine)) return false;
  }
  return true;
}

/// Estimates the sides of the whole line from the last station of an incomplete table: by the mean rate up to there,
/// or by the rate there, whichever gives more.
double estimateSides(const Station& last) {
  const double soFar = last.t > 0.0 ? last.lambda / last.t : 0.0;
  return std::max({soFar, last.rate, static_cast<double>(kMaxSidesPerLine)});
}

/// Returns the first station that the background grid does not cover; null if it covers all of them. The distance
/// between stations is at most the length of a side.
template <class Line>
const Station* firstOutside(LineWalker<Line>& walker, const Line& curve,
                            const std::vector<Station>& table) {
  for (const Station& station : table)
    if (!walker.covers(curve.position(station.t))) return &station;
  return nullptr;
}

/// Returns the parameter at which lambda reaches `target` between two stations. The rate is taken as linear between
/// them, so lambda is a monotone parabola.
double invert(const Station& from, const Station& to, double target) {
  const double fraction = (target - from.lambda) / (to.lambda - from.lambda);
  const double area = fraction * 0.5 * (from.rate + to.rate);
  const double root =
      std::sqrt(std::max(0.0, from.rate * from.rate + 2.0 * (to.rate - from.rate) * area));
  const double sum = from.rate + root;
  const double u = sum > 0.0 ? 2.0 * area / sum : fraction;
  return from.t + std::clamp(u, 0.0, 1.0) * (to.t - from.t);
}

std::vector<double> equalIncrements(const std::vector<Station>& table, std::uint32_t sides) {
  std::vector<double> parameters{0.0};
  parameters.reserve(sides + 1);
  std::size_t station = 1;
  for (std::uint32_t i = 1; i < sides; ++i) {
    const double target = table.back().lambda * (static_cast<double>(i) / sides);
    while (station + 1 < table.size() && table[station].lambda < target) ++station;
    parameters.push_back(invert(table[station - 1], table[station], target));
  }
  parameters.push_back(1.0);
  return parameters;
}

}  // namespace

template <class Line, class Trace>
LineDivision divideLine(const Line& curve, const SizeField& field, std::uint32_t minSides,
                        Trace trace) {
  LineDivision division;
  LineWalker<Line> walker(curve, field);
  std::vector<Station> table;
  if (!tabulate(walker, curve, table, trace)) {
    division.status = LineDivisionStatus::kTooManySides;
    division.position = curve.position(table.back().t);
    division.requiredSides = estimateSides(table.back());
    return division;
  }
  division.length = table.back().lambda;
  const auto targetSides = static_cast<std::uint32_t>(division.length + 0.5);
  division.parameters = equalIncrements(table, std::max({targetSides, minSides, 1U}));
  division.nodes.reserve(division.parameters.size());
  for (const double t : division.parameters) division.nodes.push_back(curve.position(t));
  if (const Station* outside = firstOutside(walker, curve, table)) {
    division.status = LineDivisionStatus::kOutsideGrid;
    division.position = curve.position(outside->t);
  }
  return division;
}

template LineDivision divideLine(const Curve&, const SizeField&, std::uint32_t, NullSurfaceTrace);
template LineDivision divideLine(const Curve&, const SizeField&, std::uint32_t,
                                 RecordingSurfaceTrace);

template LineDivision divideLine(const EdgeCurve&, const SizeField&, std::uint32_t,
                                 NullSurfaceTrace);

LineDivision divideLine(const Curve& curve, const SizeField& field, std::uint32_t minSides) {
  return divideLine(curve, field, minSides, NullSurfaceTrace{});
}

template <class Line>
void halveSide(const Line& curve, std::size_t side, LineDivision& division) {
  const double from = division.parameters[side];
  const double to = division.parameters[side + 1];
  const double half = 0.5 * curve.length(from, to);
  // A few bisections suffice. The midpoint need not be exact, but every patch on this line must get the same one.
  double low = from;
  double high = to;
  for (int round = 0; round < 20; ++round) {
    const double middle = 0.5 * (low + high);
    (curve.length(from, middle) < half ? low : high) = middle;
  }
  const double t = 0.5 * (low + high);
  const auto index = static_cast<std::ptrdiff_t>(side) + 1;
  division.parameters.insert(division.parameters.begin() + index, t);
  division.nodes.insert(division.nodes.begin() + index, curve.position(t));
}

template void halveSide(const Curve&, std::size_t, LineDivision&);
template void halveSide(const EdgeCurve&, std::size_t, LineDivision&);

}  // namespace tetrafront
