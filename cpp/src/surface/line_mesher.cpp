// Sides on a line. The walk S1-S4 of the paper steps along the line, each side as long as the
// field asks at its middle. It rarely ends at the line's end, so its steps only serve as the grid
// on which the metric length lambda(t) = integral of |x'| / size is tabulated; the sides are then
// equal increments of lambda, a whole number of which make up the line. Every side is stretched
// or shrunk by the same factor this way, rather than the last one alone.

#include "surface/line_mesher.h"

#include <algorithm>
#include <cmath>

namespace tetrafront {

namespace {

/// Step S3: two steps are "about equal" below this relative difference.
constexpr double kStepTolerance = 1e-3;
/// The averaging of S3 halves the error each time on a smooth field; if it has not settled after
/// this many rounds it is cycling across a steep change of size, and bisection takes over.
constexpr int kMaxAverages = 20;
constexpr int kMaxBisections = 40;
/// No step passes more than this much of the parameter, so that a coarse field still sees a
/// line's bends.
constexpr double kLongestStep = 1.0 / 16.0;
/// Simpson's rule and its halves must agree to this, in sides.
constexpr double kLengthTolerance = 1e-5;
constexpr int kMaxHalvings = 10;

/// A walk that has become so long looks ahead once, at so many places: whether the rest alone asks for
/// so many times the most sides there may be.
constexpr std::size_t kLongTable = 1U << 14U;
constexpr int kPlacesAhead = 1024;
constexpr double kCertainlyTooMany = 4.0;

/// One entry of the table of metric length: at t, lambda so far and its rate.
struct Station {
  double t;
  double lambda;
  double rate;
};

class LineWalker {
 public:
  LineWalker(const Curve& curve, const SizeField& field) : curve_(&curve), field_(&field) {}

  /// Wanted length of a side along the line.
  [[nodiscard]] double sizeAt(double t) {
    if (!field_->isStretched()) return field_->sizeAt(curve_->position(t), hint_);
    const Curve::Sample at = curve_->sample(t);
    const double sides =
        glm::length(field_->tensorAt(at.position, hint_).inverse() * at.derivative);
    return sides > 0.0 ? glm::length(at.derivative) / sides : field_->sizeAt(at.position, hint_);
  }
  [[nodiscard]] bool covers(const Vec3& place) { return field_->covers(place, hint_); }

  /// d lambda / dt: sides per unit of the parameter.
  [[nodiscard]] double rateAt(double t) { return glm::length(curve_->derivative(t)) / sizeAt(t); }

  /// S1-S3: the parameter at which the side begun at t ends.
  double step(double t) {
    const double speed = glm::length(curve_->derivative(t));
    const double start = sizeAt(t);
    if (start >= kLongestStep * speed) return t + kLongestStep;
    const double length = settleLength(t, speed, start);
    const double middleSpeed =
        glm::length(curve_->derivative(std::min(1.0, t + 0.5 * length / speed)));
    if (length >= kLongestStep * middleSpeed) return t + kLongestStep;
    return t + length / middleSpeed;
  }

 private:
  /// Size asked for at the middle of a tentative side of `length` (S2).
  double corrected(double t, double speed, double length) {
    return sizeAt(std::min(1.0, t + 0.5 * length / speed));
  }

  double settleLength(double t, double speed, double length) {
    double tooShort = 0.0;
    double tooLong = kLongestStep * speed;
    for (int round = 0; round < kMaxAverages + kMaxBisections; ++round) {
      const double wanted = corrected(t, speed, length);
      if (std::fabs(wanted - length) <= kStepTolerance * length) break;
      if (wanted > length)
        tooShort = std::max(tooShort, length);
      else
        tooLong = std::min(tooLong, length);
      length = 0.5 * (round < kMaxAverages ? length + wanted : tooShort + tooLong);
    }
    return length;
  }

  const Curve* curve_;
  const SizeField* field_;
  FieldHint hint_;
};

/// Adds stations up to `to`, halving until Simpson's rule is accurate.
void integrate(LineWalker& walker, double to, double rateTo, int depth,
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
  if (depth >= kMaxHalvings || std::fabs(fine - coarse) <= kLengthTolerance) {
    table.push_back({to, from.lambda + fine, rateTo});
    return;
  }
  integrate(walker, middle, rateMiddle, depth + 1, table);
  integrate(walker, to, rateTo, depth + 1, table);
}

/// Of the sides from t to the end, at least about so many. The lesser of neighbouring rates counts, as a
/// place may lie on a source of a size that nothing around it has.
double leastSidesFrom(LineWalker& walker, double t) {
  const double width = (1.0 - t) / kPlacesAhead;
  double before = walker.rateAt(t);
  double sides = 0.0;
  for (int i = 1; i <= kPlacesAhead; ++i) {
    const double rate = walker.rateAt(std::min(1.0, t + i * width));
    sides += width * std::min(before, rate);
    before = rate;
  }
  return sides;
}

/// The table of metric length over the walk's steps; false if there are too many, or one is too
/// short to move the parameter at all.
bool tabulate(LineWalker& walker, const Curve& curve, std::vector<Station>& table) {
  table.push_back({0.0, 0.0, walker.rateAt(0.0)});
  std::size_t nextKnot = 1;
  bool hasLooked = false;
  while (table.back().t < 1.0) {
    if (!hasLooked && table.size() > kLongTable) {
      hasLooked = true;
      if (leastSidesFrom(walker, table.back().t) > kCertainlyTooMany * kMaxSidesPerLine)
        return false;
    }
    const double knot = curve.knots()[nextKnot];
    double to = walker.step(table.back().t);
    // A step that would leave a sliver before the knot takes it in.
    if (to >= knot - 1e-3 * (knot - table.back().t)) {
      to = knot;
      nextKnot = std::min(nextKnot + 1, curve.knots().size() - 1);
    }
    if (!(to > table.back().t)) return false;
    integrate(walker, to, walker.rateAt(to), 0, table);
    if (!(table.back().lambda <= kMaxSidesPerLine)) return false;
  }
  return true;
}

/// Of a table that was given up: the sides of the whole line if it went on as it did up to there,
/// or as it is just there, whichever are more.
double sidesAsked(const Station& last) {
  const double soFar = last.t > 0.0 ? last.lambda / last.t : 0.0;
  return std::max({soFar, last.rate, static_cast<double>(kMaxSidesPerLine)});
}

/// The first station that the background grid does not cover; stations are never farther apart
/// than sides. Null if all are covered.
const Station* firstOutside(LineWalker& walker, const Curve& curve,
                            const std::vector<Station>& table) {
  for (const Station& station : table)
    if (!walker.covers(curve.position(station.t))) return &station;
  return nullptr;
}

/// The parameter at which lambda reaches `target` between two stations: the rate is taken as
/// linear between them, so lambda is a monotone parabola.
double invert(const Station& from, const Station& to, double target) {
  const double share = (target - from.lambda) / (to.lambda - from.lambda);
  const double area = share * 0.5 * (from.rate + to.rate);
  const double root =
      std::sqrt(std::max(0.0, from.rate * from.rate + 2.0 * (to.rate - from.rate) * area));
  const double sum = from.rate + root;
  const double u = sum > 0.0 ? 2.0 * area / sum : share;
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

LineDivision divideLine(const Curve& curve, const SizeField& field, std::uint32_t minimumSides) {
  LineDivision division;
  LineWalker walker(curve, field);
  std::vector<Station> table;
  if (!tabulate(walker, curve, table)) {
    division.status = LineDivisionStatus::kTooManySides;
    division.place = curve.position(table.back().t);
    division.wantedSides = sidesAsked(table.back());
    return division;
  }
  division.length = table.back().lambda;
  const auto wanted = static_cast<std::uint32_t>(division.length + 0.5);
  division.parameters = equalIncrements(table, std::max({wanted, minimumSides, 1U}));
  division.nodes.reserve(division.parameters.size());
  for (const double t : division.parameters) division.nodes.push_back(curve.position(t));
  if (const Station* outside = firstOutside(walker, curve, table)) {
    division.status = LineDivisionStatus::kOutsideGrid;
    division.place = curve.position(outside->t);
  }
  return division;
}

void halveSide(const Curve& curve, std::size_t side, LineDivision& division) {
  const double from = division.parameters[side];
  const double to = division.parameters[side + 1];
  const double half = 0.5 * curve.length(from, to);
  // A few bisections suffice: the middle need not be exact, only the same for everybody.
  double low = from;
  double high = to;
  for (int round = 0; round < 20; ++round) {
    const double middle = 0.5 * (low + high);
    (curve.length(from, middle) < half ? low : high) = middle;
  }
  const double t = 0.5 * (low + high);
  const auto place = static_cast<std::ptrdiff_t>(side) + 1;
  division.parameters.insert(division.parameters.begin() + place, t);
  division.nodes.insert(division.nodes.begin() + place, curve.position(t));
}

}  // namespace tetrafront
