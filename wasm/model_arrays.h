#pragma once

/// @file A drawn model as arrays of JavaScript, and its conversion to the engine's types.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/model.h"
#include "typed_arrays.h"

namespace tetrafront::border {

/// Doubles per background node: x y z, size, stretching, direction x y z.
inline constexpr std::size_t kNodeStride = 8;

/// Doubles per source: x y z of three positions, size, distance, growth.
inline constexpr std::size_t kSourceStride = 12;

/// Background grid as sent by JavaScript; see GridArrays in src/project/grid-arrays.ts.
struct GridArrays {
  Float64Array nodes{emscripten::val::undefined()};
  Uint32Array tetrahedra{emscripten::val::undefined()};
  Uint8Array sourceTypes{emscripten::val::undefined()};
  Float64Array sourceValues{emscripten::val::undefined()};
  double coverageMargin = 0.0;
};

/// Drawn model as sent by JavaScript; see ModelArrays in src/project/arrays.ts.
struct ModelArrays {
  Float64Array points{emscripten::val::undefined()};
  Uint8Array lineTypes{emscripten::val::undefined()};
  Uint32Array lineOffsets{emscripten::val::undefined()};
  Uint32Array linePoints{emscripten::val::undefined()};
  Uint8Array patchTypes{emscripten::val::undefined()};
  Uint32Array patchOffsets{emscripten::val::undefined()};
  Uint32Array loopOffsets{emscripten::val::undefined()};
  Uint32Array loopLines{emscripten::val::undefined()};
  GridArrays grid;
};

inline std::vector<Vec3> toPoints(const std::vector<double>& xyz) {
  std::vector<Vec3> points(xyz.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
  }
  return points;
}

inline std::vector<Line> toLines(const ModelArrays& arrays) {
  const auto types = copyIn<std::uint8_t>(arrays.lineTypes);
  const auto offsets = copyIn<std::uint32_t>(arrays.lineOffsets);
  const auto points = copyIn<std::uint32_t>(arrays.linePoints);
  std::vector<Line> lines(types.size());
  for (std::size_t l = 0; l < lines.size(); ++l) {
    lines[l].type = static_cast<LineType>(types[l]);
    lines[l].points.assign(points.begin() + offsets[l], points.begin() + offsets[l + 1]);
  }
  return lines;
}

inline Loop toLoop(const std::vector<std::uint32_t>& coded, std::uint32_t begin,
                   std::uint32_t end) {
  Loop loop;
  for (std::uint32_t i = begin; i < end; ++i) {
    loop.push_back({.line = coded[i] / 2, .reversed = coded[i] % 2 == 1});
  }
  return loop;
}

inline std::vector<Patch> toPatches(const ModelArrays& arrays) {
  const auto types = copyIn<std::uint8_t>(arrays.patchTypes);
  const auto patchOffsets = copyIn<std::uint32_t>(arrays.patchOffsets);
  const auto loopOffsets = copyIn<std::uint32_t>(arrays.loopOffsets);
  const auto coded = copyIn<std::uint32_t>(arrays.loopLines);
  std::vector<Patch> patches(types.size());
  for (std::size_t p = 0; p < patches.size(); ++p) {
    patches[p].type = static_cast<PatchType>(types[p]);
    for (std::uint32_t k = patchOffsets[p]; k < patchOffsets[p + 1]; ++k) {
      patches[p].loops.push_back(toLoop(coded, loopOffsets[k], loopOffsets[k + 1]));
    }
  }
  return patches;
}

inline Model toModel(const ModelArrays& arrays) {
  return {.points = toPoints(copyIn<double>(arrays.points)),
          .lines = toLines(arrays),
          .patches = toPatches(arrays)};
}

inline std::vector<SizeSource> toSources(const GridArrays& arrays) {
  const auto types = copyIn<std::uint8_t>(arrays.sourceTypes);
  const auto values = copyIn<double>(arrays.sourceValues);
  std::vector<SizeSource> sources(types.size());
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const double* v = values.data() + kSourceStride * s;
    sources[s] = {
        .type = static_cast<SourceType>(types[s]),
        .points = {Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5]), Vec3(v[6], v[7], v[8])},
        .size = v[9],
        .distance = v[10],
        .growth = v[11]};
  }
  return sources;
}

inline BackgroundGrid toGrid(const GridArrays& arrays) {
  const auto values = copyIn<double>(arrays.nodes);
  const auto corners = copyIn<std::uint32_t>(arrays.tetrahedra);
  BackgroundGrid grid;
  for (std::size_t i = 0; i + kNodeStride <= values.size(); i += kNodeStride) {
    const double* v = values.data() + i;
    grid.nodes.push_back({.position = {v[0], v[1], v[2]},
                          .size = v[3],
                          .stretching = v[4],
                          .direction = {v[5], v[6], v[7]}});
  }
  for (std::size_t i = 0; i + 4 <= corners.size(); i += 4) {
    grid.tetrahedra.push_back({corners[i], corners[i + 1], corners[i + 2], corners[i + 3]});
  }
  grid.sources = toSources(arrays);
  grid.coverageMargin = arrays.coverageMargin;
  return grid;
}

}  // namespace tetrafront::border
