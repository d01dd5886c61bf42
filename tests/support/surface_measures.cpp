#include "support/surface_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geom/measure.h"
#include "support/shapes.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront::testing {

namespace {

double angleOpposite(double side, double second, double third) {
  const double cosine = (second * second + third * third - side * side) / (2.0 * second * third);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

void addTriangle(const std::array<Vec3, 3>& corners, SurfaceMeasures& measures) {
  std::array<double, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k)
    sides[k] = glm::length(corners[(k + 1) % 3] - corners[(k + 2) % 3]);
  measures.area += 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const double half = 0.5 * (sides[0] + sides[1] + sides[2]);
  measures.meanRadiusRatio += 8.0 * (half - sides[0]) * (half - sides[1]) * (half - sides[2]) /
                              (sides[0] * sides[1] * sides[2]);
  for (std::size_t k = 0; k < 3; ++k)
    measures.minAngle = std::min(measures.minAngle,
                                 angleOpposite(sides[k], sides[(k + 1) % 3], sides[(k + 2) % 3]));
}

}  // namespace

EdgeUse countEdges(const SurfaceMesh& mesh) {
  EdgeUse edges;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t from = mesh.triangles[i];
    const std::uint32_t to = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
    ++edges[std::minmax(from, to)];
  }
  return edges;
}

SurfaceMeasures measure(const SurfaceMesh& mesh, const SizeField& field) {
  SurfaceMeasures measures;
  measures.nodes = nodeCount(mesh);
  measures.triangles = triangleCount(mesh);
  for (std::size_t t = 0; t < measures.triangles; ++t) {
    const auto corner = [&](std::size_t k) { return pointOf(mesh, mesh.triangles[3 * t + k]); };
    addTriangle({corner(0), corner(1), corner(2)}, measures);
  }
  measures.meanRadiusRatio /= static_cast<double>(measures.triangles);
  FieldHint hint;
  const EdgeUse edges = countEdges(mesh);
  measures.edges = edges.size();
  for (const auto& [nodes, uses] : edges) {
    if (uses == 1) ++measures.borderEdges;
    if (uses > 2) ++measures.nonManifoldEdges;
    const Vec3 a = pointOf(mesh, nodes.first);
    const Vec3 b = pointOf(mesh, nodes.second);
    measures.meanEdgeRatio += glm::length(b - a) / field.sizeAt(0.5 * (a + b), hint);
  }
  measures.meanEdgeRatio /= static_cast<double>(measures.edges);
  return measures;
}

double distanceTo(const SurfaceMesh& mesh, const Vec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const auto [a, b, c] = cornersOf(mesh, t);
    // The box around a triangle is no farther away than the triangle, and its distance costs less.
    double toBox = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double below = std::min(std::min(a[k], b[k]), c[k]) - point[k];
      const double above = point[k] - std::max(std::max(a[k], b[k]), c[k]);
      const double outside = std::max(std::max(below, above), 0.0);
      toBox += outside * outside;
    }
    if (toBox < nearest) nearest = std::min(nearest, squaredDistanceToTriangle(point, a, b, c));
  }
  return std::sqrt(nearest);
}

}  // namespace tetrafront::testing
