#include "model/duplicates.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/sort.h"
#include "geom/coordinates.h"
#include "search/box_tree.h"
#include "topology/disjoint_sets.h"

namespace tetrafront {
namespace {

/// Parameters, as fractions of the line, at which courses are compared.
constexpr int kCourseParts = 8;

template <class AnyId>
std::vector<AnyId> idsUpTo(std::size_t count) {
  std::vector<AnyId> ids;
  ids.reserve(count);
  for (const AnyId id : IdRange<AnyId>(count)) ids.push_back(id);
  return ids;
}

/// Finds equal positions by sorting, then those that differ by rounding, by their boxes.
std::vector<PointId> findSamePositions(const std::vector<Vec3>& points, double reach) {
  std::vector<PointId> result = idsUpTo<PointId>(points.size());
  std::vector<PointId> sorted;
  for (const PointId point : result) {
    if (isFinite(points[point.index()])) sorted.push_back(point);
  }
  const auto key = [&](PointId point) {
    const Vec3& position = points[point.index()];
    return std::array<double, 3>{position.x, position.y, position.z};
  };
  stableSort(sorted,
             [&](PointId a, PointId b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<PointId> distinct;
  for (const PointId point : sorted) {
    if (!distinct.empty() && points[distinct.back().index()] == points[point.index()]) {
      result[point.index()] = distinct.back();
    } else {
      distinct.push_back(point);
    }
  }
  stableSort(distinct);
  if (distinct.empty()) return result;
  // Relative to one of them, so that the rounding of the boxes is small compared with the model.
  const Vec3 origin = points[distinct.front().index()];
  std::vector<Box> boxes;
  for (const PointId point : distinct) {
    const Vec3 position = points[point.index()] - origin;
    boxes.push_back(Box::of(position - reach, position + reach, position));
  }
  const BoxTree tree(boxes);
  for (std::uint32_t i = 0; i < distinct.size(); ++i) {
    const Vec3& position = points[distinct[i].index()];
    PointId& lowest = result[distinct[i].index()];
    tree.visitOverlaps(boxes[i], [&](std::uint32_t k) {
      if (k < i && glm::length(points[distinct[k].index()] - position) <= reach)
        lowest = std::min(lowest, result[distinct[k].index()]);
    });
  }
  for (PointId& lowest : result) lowest = result[lowest.index()];
  return result;
}

bool haveSameCourse(const Curve& a, const Curve& b) {
  if (a.isStraight() && b.isStraight()) return true;
  const double reach = Tolerance(std::max(a.length(), b.length())).coincidence();
  bool along = true;
  bool against = true;
  for (int i = 1; i < kCourseParts && (along || against); ++i) {
    const double t = static_cast<double>(i) / kCourseParts;
    const Vec3 position = a.position(t);
    along = along && glm::length(position - b.position(t)) <= reach;
    against = against && glm::length(position - b.position(1.0 - t)) <= reach;
  }
  return along || against;
}

/// Compares lines with the same ends, in ascending order. Lines with the same course have the same
/// midpoint, so only lines with midpoints at the same coordinate along an arbitrary direction are
/// compared.
void findSameCourses(const ResolvedModel& model, std::span<const LineId> lines,
                     const Tolerance& tolerance, std::vector<LineId>& lowest) {
  struct Entry {
    double along;
    std::uint32_t index;  // in `lines`
  };
  const Vec3 direction(0.61, 0.53, 0.59);
  std::vector<Entry> entries;
  double longest = 0.0;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    const Curve& curve = model.curve(lines[i]);
    entries.push_back({glm::dot(direction, curve.position(0.5)), i});
    longest = std::max(longest, curve.length());
  }
  // Twice the largest difference of midpoints: for curves by their course, for straight lines by
  // their ends.
  const double reach = 2.0 * std::max(Tolerance(longest).coincidence(), tolerance.rounding());
  stableSort(entries, [](const Entry& a, const Entry& b) {
    return a.along != b.along ? a.along < b.along : a.index < b.index;
  });
  DisjointSets sets(lines.size());
  std::vector<Entry> distinct;  // distinct lines within reach
  for (const Entry& entry : entries) {
    std::erase_if(distinct, [&](const Entry& other) { return other.along < entry.along - reach; });
    const Curve& curve = model.curve(lines[entry.index]);
    const auto same = std::ranges::find_if(distinct, [&](const Entry& other) {
      return haveSameCourse(model.curve(lines[other.index]), curve);
    });
    if (same == distinct.end()) {
      distinct.push_back(entry);
    } else {
      sets.join(same->index, entry.index);
    }
  }
  for (std::uint32_t i = 0; i < lines.size(); ++i) lowest[lines[i].index()] = lines[sets.find(i)];
}

}  // namespace

Duplicates findDuplicates(const ResolvedModel& model, std::span<const std::uint8_t> usableLines,
                          const Tolerance& tolerance) {
  const Model& drawn = model.model();
  Duplicates result{findSamePositions(drawn.points, tolerance.rounding()),
                    idsUpTo<LineId>(drawn.lines.size())};
  struct Entry {
    std::pair<PointId, PointId> ends;
    LineId line;
  };
  std::vector<Entry> entries;
  for (const LineId line : IdRange<LineId>(drawn.lines.size())) {
    if (usableLines[line.index()] == 0) continue;
    const std::vector<std::uint32_t>& points = drawn.lines[line.index()].points;
    const auto [low, high] =
        std::minmax(result.points[points.front()], result.points[points.back()]);
    entries.push_back({{low, high}, line});
  }
  stableSort(entries, [](const Entry& a, const Entry& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.line < b.line;
  });
  std::vector<LineId> sameEnds;
  for (std::size_t i = 0, j = 0; i < entries.size(); i = j) {
    sameEnds.clear();
    for (; j < entries.size() && entries[j].ends == entries[i].ends; ++j)
      sameEnds.push_back(entries[j].line);
    if (sameEnds.size() > 1) findSameCourses(model, sameEnds, tolerance, result.lines);
  }
  return result;
}

}  // namespace tetrafront
