#pragma once

/// @file Remeshed bodies, and measures of them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "boundary/boundary.h"
#include "remesh/surface_complex.h"
#include "support/part_shapes.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront::testing {

inline SurfaceRemesh remesh(const SurfaceMesh& mesh, const RemeshOptions& options = {},
                            const std::vector<std::uint32_t>& groups = {},
                            std::uint32_t budget = 1U << 20U) {
  SurfaceRemesher remesher(mesh.points, mesh.triangles, groups, {}, options);
  while (!remesher.advance(budget)) {
  }
  return remesher.result();
}

inline SurfaceMesh surfaceOf(const SurfaceRemesh& result) {
  SurfaceMesh mesh;
  mesh.points = result.points;
  mesh.triangles = result.triangles;
  return mesh;
}

inline SurfaceMesh surfaceOf(const SurfaceComplex& complex) {
  SurfaceMesh mesh;
  for (const NodeId node : IdRange<NodeId>(complex.nodeCount())) {
    const Vec3& p = complex.pointOf(node);
    mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
  }
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    if (!complex.isAlive(t)) continue;
    for (const NodeId node : complex.nodesOf(t)) mesh.triangles.push_back(node.value);
  }
  return mesh;
}

inline double diagonalOf(const SurfaceMesh& mesh) {
  const Bounds bounds = boundsOf(mesh);
  return glm::length(bounds.high - bounds.low);
}

/// Returns the largest distance from samples of one surface to another: a lower bound of the
/// distance.
inline double sampledDistance(const SurfaceMesh& from, const SurfaceMesh& to, std::size_t samples) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::uint32_t> anyTriangle(0, countTriangles(from) - 1);
  std::uniform_real_distribution<double> anyPart(0.0, 1.0);
  double largest = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto [a, b, c] = cornersOf(from, TriangleId(anyTriangle(random)));
    const double root = std::sqrt(anyPart(random));
    const double part = anyPart(random);
    largest = std::max(
        largest, distanceTo(to, a * (1.0 - root) + b * (root * (1.0 - part)) + c * (root * part)));
  }
  return largest;
}

inline std::vector<Diagnostic> errorsOf(SurfaceMesh mesh, InnerShells innerShells) {
  std::vector<Diagnostic> found;
  closeBoundary(mesh, BoundarySource::kGivenSurface, found, innerShells);
  std::erase_if(found, [](const Diagnostic& d) { return d.severity != Severity::kError; });
  return found;
}

struct Body {
  std::string name;
  std::function<SurfaceMesh()> make;
  InnerShells innerShells = InnerShells::kCavities;
};

inline std::ostream& operator<<(std::ostream& out, const Body& body) { return out << body.name; }

/// A unit cube whose top and front have nodes this far from their common edge.
inline SurfaceMesh cubeWithCaps(double height) {
  SurfaceMesh cube;
  for (const Vec3& p :
       {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(1.0, 1.0, 0.0), Vec3(0.0, 1.0, 0.0),
        Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 1.0), Vec3(1.0, 1.0, 1.0), Vec3(0.0, 1.0, 1.0),
        Vec3(0.4, height, 1.0), Vec3(0.7, 0.0, 1.0 - height)}) {
    cube.points.insert(cube.points.end(), {p.x, p.y, p.z});
  }
  cube.triangles = {0, 2, 1, 0, 3, 2, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7,
                    0, 1, 9, 1, 5, 9, 5, 4, 9, 4, 0, 9, 4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8};
  return cube;
}

}  // namespace tetrafront::testing
