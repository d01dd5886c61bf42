#include "model/check_loops.h"

#include <algorithm>
#include <iterator>

#include "base/sort.h"
#include "search/quadtree.h"

namespace tetrafront {

namespace {

/// Samples per curved line.
constexpr std::uint32_t kLoopSamples = 32;

/// One side of one loop.
struct Side {
  Vec2 from;
  Vec2 to;
  std::uint32_t loop;
  std::uint32_t index;  ///< in the loop
  LineId line;
};

double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

double squaredDistance(const Vec2& position, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const double squared = glm::dot(along, along);
  const double t =
      squared > 0.0 ? std::clamp(glm::dot(position - from, along) / squared, 0.0, 1.0) : 0.0;
  const Vec2 gap = position - (from + t * along);
  return glm::dot(gap, gap);
}

bool sidesCross(const Side& a, const Side& b) {
  const double fromB = cross(a.to - a.from, b.from - a.from);
  const double toB = cross(a.to - a.from, b.to - a.from);
  const double fromA = cross(b.to - b.from, a.from - b.from);
  const double toA = cross(b.to - b.from, a.to - b.from);
  return ((fromB > 0.0) != (toB > 0.0)) && ((fromA > 0.0) != (toA > 0.0));
}

bool sidesTouch(const Side& a, const Side& b, double reach) {
  const double squared = reach * reach;
  return sidesCross(a, b) || squaredDistance(a.from, b.from, b.to) <= squared ||
         squaredDistance(a.to, b.from, b.to) <= squared ||
         squaredDistance(b.from, a.from, a.to) <= squared ||
         squaredDistance(b.to, a.from, a.to) <= squared;
}

/// Consecutive sides overlap if the second one reverses the first.
bool turnsBack(const Side& first, const Side& second, double reach) {
  const Vec2 a = first.from - first.to;
  const Vec2 b = second.to - second.from;
  if (!(glm::dot(a, b) > 0.0)) return false;
  return squaredDistance(first.from, second.from, second.to) <= reach * reach ||
         squaredDistance(second.to, first.from, first.to) <= reach * reach;
}

std::vector<Side> sidesOf(std::span<const PlaneLoop> loops) {
  std::vector<Side> sides;
  for (std::uint32_t loop = 0; loop < loops.size(); ++loop) {
    const std::vector<Vec2>& points = loops[loop].points;
    for (std::uint32_t i = 0; i < points.size(); ++i)
      sides.push_back({points[i], points[(i + 1) % points.size()], loop, i, loops[loop].lines[i]});
  }
  return sides;
}

/// Even-odd rule.
bool isInside(const Vec2& position, const PlaneLoop& loop) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec2& a = loop.points[i];
    const Vec2& b = loop.points[(i + 1) % loop.points.size()];
    if ((a.y > position.y) == (b.y > position.y)) continue;
    const bool below = cross(b - a, position - a) > 0.0;
    if (below == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

}  // namespace

PlaneLoop layOutLoop(const ResolvedModel& model, const Loop& loop, const PlanarSurface& surface) {
  PlaneLoop result;
  for (const OrientedLine& line : loop) {
    const OrientedCurve curve = model.curve(line);
    const std::uint32_t count = curve.isStraight() ? 1 : kLoopSamples;
    for (std::uint32_t i = 0; i < count; ++i) {
      result.points.push_back(surface.project(curve.position(static_cast<double>(i) / count)));
      result.lines.push_back(LineId(line.line));
    }
  }
  return result;
}

void appendStarts(const ResolvedModel& model, const Loop& loop, std::vector<LineStart>& starts) {
  for (const OrientedLine& line : loop)
    starts.push_back({model.startPoint(line), LineId(line.line)});
}

std::optional<RepeatedPoint> findRepeatedPoint(std::vector<LineStart> starts) {
  stableSort(starts);
  const auto twice = std::ranges::adjacent_find(starts, {}, &LineStart::point);
  if (twice == starts.end()) return std::nullopt;
  return RepeatedPoint{twice->point, twice->line, std::next(twice)->line};
}

std::optional<LoopContact> findContact(std::span<const PlaneLoop> loops,
                                       const Tolerance& tolerance) {
  const std::vector<Side> sides = sidesOf(loops);
  PlaneBox region = PlaneBox::of(sides.front().from, sides.front().to);
  for (const Side& side : sides) region.include(side.from);
  const double reach = tolerance.coincidence();
  Quadtree tree(region);
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    PlaneBox box = PlaneBox::of(side.from, side.to);
    box.low -= Vec2(reach);
    box.high += Vec2(reach);
    near.clear();
    tree.query(box, near);
    for (const std::uint32_t k : near) {
      const Side& other = sides[k];
      const bool sameLoop = other.loop == side.loop;
      const auto count = static_cast<std::uint32_t>(loops[side.loop].points.size());
      const bool follows = sameLoop && (other.index + 1) % count == side.index;
      const bool precedes = sameLoop && (side.index + 1) % count == other.index;
      const bool touch = follows    ? turnsBack(other, side, reach)
                         : precedes ? turnsBack(side, other, reach)
                                    : sidesTouch(other, side, reach);
      if (touch) return LoopContact{other.line, side.line, side.from};
    }
    tree.insert(i, box);
  }
  return std::nullopt;
}

std::optional<std::size_t> findMisplacedHole(std::span<const PlaneLoop> loops) {
  for (std::size_t hole = 1; hole < loops.size(); ++hole) {
    const Vec2& position = loops[hole].points.front();
    if (!isInside(position, loops.front())) return hole;
    for (std::size_t other = 1; other < loops.size(); ++other)
      if (other != hole && isInside(position, loops[other])) return hole;
  }
  return std::nullopt;
}

}  // namespace tetrafront
