#pragma once

/// @file Faces of a model that cannot be triangulated on their surfaces keep the triangles of the given surface. They are joined
/// to the triangulated faces along the edges of the model: these have a node at each given one.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.h"
#include "remesh/reference_surface.h"
#include "surface/divided_lines.h"
#include "tetrafront/mesh.h"
#include "tetrafront/trimmed_model.h"

namespace tetrafront {

/// Given nodes on an edge of the model, from its start to its end.
struct EdgeStations {
  std::vector<double> parameters;  ///< ascending, from 0 to 1; empty if the edge has none
  std::vector<NodeId> nodes;       ///< in the given surface; in a closed edge the last is the first
};

/// Returns the stations per edge of the model on the boundary of a part of the given surface. None if the boundary is not a union of
/// edges that faces use. `isKept`: per given triangle, whether it is in the part. `reach`: largest distance of nodes from edges.
[[nodiscard]] std::optional<std::vector<EdgeStations>> stationsAround(
    std::span<const std::uint8_t> isKept, const SurfaceMesh& given, const TrimmedModel& model,
    double reach);

/// Appends the kept triangles to the triangulated faces. Sides on edges that have further nodes there divide them. Returns the given
/// triangle per appended one. `lines`: of the triangulated faces, with a node at each station.
[[nodiscard]] std::vector<TriangleId> appendGiven(std::span<const std::uint8_t> isKept,
                                                  const SurfaceMesh& given,
                                                  std::span<const EdgeStations> stations,
                                                  const DividedLines& lines, SurfaceMesh& mesh);

}  // namespace tetrafront
