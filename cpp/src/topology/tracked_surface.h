#pragma once

/// @file A surface that is made from a given one in several steps: each of its triangles knows the given one that it comes from.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "topology/mesh_access.h"

namespace tetrafront {

struct TrackedSurface {
  SurfaceMesh mesh;                ///< with the patches and regions of the triangles, if known
  std::vector<TriangleId> origin;  ///< per triangle: the given one, or none if it closes a hole
};

/// Returns a given surface.
[[nodiscard]] inline TrackedSurface trackedFrom(SurfaceMesh mesh) {
  TrackedSurface surface{std::move(mesh), {}};
  const IdRange<TriangleId> triangles(countTriangles(surface.mesh));
  for (const TriangleId t : triangles) surface.origin.push_back(t);
  return surface;
}

/// Returns the values of triangles that come from others, `perTriangle` values each; nothing if there are none. `parents`: per
/// triangle, the one before.
template <class Value>
[[nodiscard]] std::vector<Value> inherited(const std::vector<Value>& before,
                                           std::span<const TriangleId> parents,
                                           std::size_t perTriangle = 1) {
  std::vector<Value> values;
  if (before.empty()) return values;
  values.reserve(perTriangle * parents.size());
  for (const TriangleId parent : parents) {
    const auto first = before.begin() + static_cast<std::ptrdiff_t>(perTriangle * parent.index());
    values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(perTriangle));
  }
  return values;
}

/// Gives new triangles what was known about those before. `parents`: per triangle, the one before.
inline void inherit(TrackedSurface& surface, std::span<const TriangleId> parents) {
  const auto replace = [&](auto& values, std::size_t perTriangle) {
    values = inherited(values, parents, perTriangle);
  };
  replace(surface.mesh.trianglePatch, 1);
  replace(surface.mesh.triangleRegions, 2);
  replace(surface.origin, 1);
}

/// Removes the triangles for which the condition holds, and returns those that are left. The condition is asked in ascending
/// order; it may read the triangle, and all origins.
template <class Condition>
std::vector<TriangleId> removeTriangles(TrackedSurface& surface, const Condition& isRemoved) {
  std::vector<std::uint32_t>& triangles = surface.mesh.triangles;
  std::vector<TriangleId> kept;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(surface.mesh))) {
    if (isRemoved(t)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      triangles[3 * kept.size() + k] = triangles[3 * t.index() + k];
    kept.push_back(t);
  }
  triangles.resize(3 * kept.size());
  inherit(surface, kept);
  return kept;
}

/// Moves the arrays to the result of a public call; its triangles that close a hole get kNoIndex.
template <class Result>
void moveTo(TrackedSurface& surface, Result& result) {
  result.points = std::move(surface.mesh.points);
  result.triangles = std::move(surface.mesh.triangles);
  result.origin.reserve(surface.origin.size());
  for (const TriangleId given : surface.origin) result.origin.push_back(given.value);
}

}  // namespace tetrafront
