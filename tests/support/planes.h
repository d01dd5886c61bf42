#pragma once

/// @file Polygons that are filled in the plane: stored ones, of which the engine and the package must make the same triangles, and
/// random ones.

#include <cstdint>
#include <string>
#include <vector>

#include "tetrafront/plane_fill.h"

namespace tetrafront::testing {

struct Plane {
  std::vector<double> points;
  std::vector<std::uint32_t> loops;
  BackgroundGrid grid{};
  PlaneOptions options{};
  FrontExperiment experiment{};
};

[[nodiscard]] PlaneFill fillOf(const Plane& plane);

/// Hash of the triangulation, as the package computes it: 16 hexadecimal digits.
[[nodiscard]] std::string fingerprintOf(const PlaneFill& fill);

struct StoredPlane {
  std::string line;  ///< all but the fingerprint
  std::string name;
  Plane plane;
  std::string fingerprint;
};

/// Returns the polygons of tests/fingerprints/planes.txt. One per line, words: name, order, seed, `divided` or `given`,
/// `improved` or `raw`, size; number of loops, per loop its number of corners and x y of each; number of sources, per
/// source x y, size, distance and growth; fingerprint. `npm run fingerprints` replaces the last word.
[[nodiscard]] std::vector<StoredPlane> storedPlanes();
void storePlanes(const std::vector<StoredPlane>& planes);

/// Returns a star-shaped polygon of random radii with `holes` small holes that keep clear of it and of each other.
[[nodiscard]] Plane randomPlane(std::uint64_t seed, int holes);

}  // namespace tetrafront::testing
