#include "model/duplicates.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "base/sort.h"
#include "geom/coordinates.h"
#include "search/box_tree.h"
#include "search/disjoint_sets.h"

namespace tetrafront {
namespace {

/// Parameters, as fractions of the line, at which courses are compared.
constexpr int kCourseParts = 8;

std::vector<std::uint32_t> numbersUpTo(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// Finds equal positions by sorting, then those that differ by rounding, by their boxes.
std::vector<std::uint32_t> samePlaces(const std::vector<Vec3>& points, double samePlace) {
  std::vector<std::uint32_t> result = numbersUpTo(points.size());
  std::vector<std::uint32_t> sorted;
  for (const std::uint32_t point : result) {
    if (isFinite(points[point])) sorted.push_back(point);
  }
  const auto key = [&](std::uint32_t i) {
    return std::array<double, 3>{points[i].x, points[i].y, points[i].z};
  };
  stableSort(sorted, [&](std::uint32_t a, std::uint32_t b) {
    return key(a) != key(b) ? key(a) < key(b) : a < b;
  });
  std::vector<std::uint32_t> distinct;
  for (const std::uint32_t point : sorted) {
    if (!distinct.empty() && points[distinct.back()] == points[point]) {
      result[point] = distinct.back();
    } else {
      distinct.push_back(point);
    }
  }
  stableSort(distinct);
  if (distinct.empty()) return result;
  // Relative to one of them, so that the rounding of the boxes is small compared with the model.
  const Vec3 origin = points[distinct.front()];
  std::vector<Box> boxes;
  for (const std::uint32_t point : distinct) {
    const Vec3 place = points[point] - origin;
    boxes.push_back(Box::of(place - samePlace, place + samePlace, place));
  }
  const BoxTree tree(boxes);
  for (std::uint32_t i = 0; i < distinct.size(); ++i) {
    std::uint32_t& lowest = result[distinct[i]];
    tree.visitOverlaps(boxes[i], [&](std::uint32_t k) {
      if (k < i && glm::length(points[distinct[k]] - points[distinct[i]]) <= samePlace)
        lowest = std::min(lowest, result[distinct[k]]);
    });
  }
  for (std::uint32_t& lowest : result) lowest = result[lowest];
  return result;
}

bool runAlike(const Curve& a, const Curve& b) {
  if (a.isStraight() && b.isStraight()) return true;
  const double reach = Tolerance(std::max(a.length(), b.length())).coincidence();
  bool along = true;
  bool against = true;
  for (int i = 1; i < kCourseParts && (along || against); ++i) {
    const double t = static_cast<double>(i) / kCourseParts;
    const Vec3 place = a.position(t);
    along = along && glm::length(place - b.position(t)) <= reach;
    against = against && glm::length(place - b.position(1.0 - t)) <= reach;
  }
  return along || against;
}

/// Compares lines with the same ends, in ascending order. Lines with the same course have the same
/// midpoint, so only lines with midpoints at the same coordinate along an arbitrary direction are
/// compared.
void findAlike(const ResolvedModel& model, std::span<const std::uint32_t> lines, double samePlace,
               std::vector<std::uint32_t>& lowest) {
  struct Entry {
    double along;
    std::uint32_t position;  // in `lines`
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
  const double reach = 2.0 * std::max(Tolerance(longest).coincidence(), samePlace);
  stableSort(entries, [](const Entry& a, const Entry& b) {
    return a.along != b.along ? a.along < b.along : a.position < b.position;
  });
  DisjointSets sets(lines.size());
  std::vector<Entry> distinct;  // distinct lines within reach
  for (const Entry& entry : entries) {
    std::erase_if(distinct, [&](const Entry& other) { return other.along < entry.along - reach; });
    const Curve& curve = model.curve(lines[entry.position]);
    const auto same = std::ranges::find_if(distinct, [&](const Entry& other) {
      return runAlike(model.curve(lines[other.position]), curve);
    });
    if (same == distinct.end()) {
      distinct.push_back(entry);
    } else {
      sets.join(same->position, entry.position);
    }
  }
  for (std::uint32_t i = 0; i < lines.size(); ++i) lowest[lines[i]] = lines[sets.find(i)];
}

}  // namespace

Duplicates findDuplicates(const ResolvedModel& model, std::span<const std::uint8_t> usableLines,
                          const Tolerance& tolerance) {
  const double samePlace = tolerance.rounding();
  const Model& drawn = model.model();
  Duplicates result{samePlaces(drawn.points, samePlace), numbersUpTo(drawn.lines.size())};
  struct Entry {
    std::pair<std::uint32_t, std::uint32_t> ends;
    std::uint32_t line;
  };
  std::vector<Entry> entries;
  for (std::uint32_t line = 0; line < drawn.lines.size(); ++line) {
    if (usableLines[line] == 0) continue;
    const std::vector<std::uint32_t>& points = drawn.lines[line].points;
    const auto [low, high] =
        std::minmax(result.points[points.front()], result.points[points.back()]);
    entries.push_back({{low, high}, line});
  }
  stableSort(entries, [](const Entry& a, const Entry& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.line < b.line;
  });
  std::vector<std::uint32_t> sameEnds;
  for (std::size_t i = 0, j = 0; i < entries.size(); i = j) {
    sameEnds.clear();
    for (; j < entries.size() && entries[j].ends == entries[i].ends; ++j)
      sameEnds.push_back(entries[j].line);
    if (sameEnds.size() > 1) findAlike(model, sameEnds, samePlace, result.lines);
  }
  return result;
}

}  // namespace tetrafront
