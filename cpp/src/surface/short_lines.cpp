#include "surface/short_lines.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "surface/rules.h"

namespace tetrafront {

namespace {

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
    source.growth = kShortLineGrowth;
  }
  return sources;
}

}  // namespace tetrafront
