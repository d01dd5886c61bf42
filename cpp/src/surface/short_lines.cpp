#include "surface/short_lines.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace tetrafront {

namespace {

/// Length of a side / length of the next line's side, below which triangles at both would have angles of less than
/// about 20 degrees.
constexpr double kMuchShorter = 0.35;
/// Growth of the size per unit of distance from a short line.
constexpr double kGrowth = 0.5;

std::array<std::uint32_t, 2> endsOf(const Line& line) {
  return {line.points.front(), line.points.back()};
}

/// Length of a side in target sizes; 0 if the line is not divided.
double sideLength(const LineDivision& division) {
  return division.nodes.empty() ? 0.0 : division.length / static_cast<double>(division.sideCount());
}

}  // namespace

std::vector<SizeSource> sourcesAtShortLines(const ResolvedModel& model,
                                            std::span<const LineDivision> divisions) {
  const std::vector<Line>& lines = model.model().lines;
  std::vector<double> longest(model.model().points.size(), 0.0);
  for (std::size_t line = 0; line < lines.size(); ++line)
    for (const std::uint32_t point : endsOf(lines[line]))
      longest[point] = std::max(longest[point], sideLength(divisions[line]));
  std::vector<SizeSource> sources;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    const LineDivision& division = divisions[line];
    const auto [from, to] = endsOf(lines[line]);
    if (division.nodes.empty() ||
        sideLength(division) >= kMuchShorter * std::max(longest[from], longest[to]))
      continue;
    SizeSource& source = sources.emplace_back();
    source.type = SourceType::kSegment;
    source.points = {division.nodes.front(), division.nodes.back(), Vec3(0.0)};
    source.size = model.curve(LineId(line)).length() / static_cast<double>(division.sideCount());
    source.growth = kGrowth;
  }
  return sources;
}

}  // namespace tetrafront
