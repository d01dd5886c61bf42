#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "field/size_field.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "quality/check_mesh.h"
#include "quality/mesh_boundary.h"
#include "quality/survey.h"
#include "tetrafront/mesh_tools.h"

namespace tetrafront {
namespace {

Vec3 pointOf(const VolumeMesh& mesh, std::uint32_t node) {
  const std::size_t i = 3 * std::size_t{node};
  return {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
}

std::array<Vec3, 4> cornersOf(const VolumeMesh& mesh, std::size_t element) {
  const std::uint32_t* nodes = &mesh.tetrahedra[4 * element];
  return {pointOf(mesh, nodes[0]), pointOf(mesh, nodes[1]), pointOf(mesh, nodes[2]),
          pointOf(mesh, nodes[3])};
}

bool isReadable(const VolumeMesh& mesh) {
  const std::size_t nodes = mesh.points.size() / 3;
  const std::size_t elements = mesh.tetrahedra.size() / 4;
  return elements > 0 && mesh.points.size() % 3 == 0 && mesh.tetrahedra.size() % 4 == 0 &&
         (mesh.regions.empty() || mesh.regions.size() == elements) &&
         std::all_of(mesh.points.begin(), mesh.points.end(),
                     [](double x) { return std::fabs(x) <= kLargestCoordinate; }) &&
         std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(),
                     [nodes](std::uint32_t node) { return node < nodes; });
}

void countNodes(const VolumeMesh& mesh, MeshInspection& out) {
  std::vector<std::uint8_t> isUsed(mesh.points.size() / 3, 0);
  for (const std::uint32_t node : mesh.tetrahedra) isUsed[node] = 1;
  const auto used = std::count(isUsed.begin(), isUsed.end(), std::uint8_t{1});
  out.nodes = static_cast<std::uint32_t>(used);
  out.unusedNodes = static_cast<std::uint32_t>(isUsed.size()) - out.nodes;
}

/// Leaves no element with a negative volume.
void turnElements(VolumeMesh& mesh, MeshInspection& out) {
  out.tetrahedra = static_cast<std::uint32_t>(mesh.tetrahedra.size() / 4);
  for (std::size_t e = 0; e < out.tetrahedra; ++e) {
    const auto [a, b, c, d] = cornersOf(mesh, e);
    const int sign = orient3d(a, b, c, d);
    if (sign == 0) ++out.flatTetrahedra;
    if (sign >= 0) continue;
    ++out.turnedTetrahedra;
    std::swap(mesh.tetrahedra[4 * e + 2], mesh.tetrahedra[4 * e + 3]);
  }
}

void measureEdges(const VolumeMesh& mesh, MeshInspection& out) {
  double sum = 0.0;
  for (std::size_t e = 0; e < out.tetrahedra; ++e) {
    const std::array<Vec3, 4> p = cornersOf(mesh, e);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double length = glm::length(p[j] - p[i]);
        sum += length;
        const bool isFirst = e == 0 && i == 0 && j == 1;
        out.shortestEdge = isFirst ? length : std::min(out.shortestEdge, length);
        out.longestEdge = std::max(out.longestEdge, length);
      }
    }
  }
  out.meanEdge = sum / (6.0 * out.tetrahedra);
}

std::uint32_t narrowed(std::uint64_t count) {
  constexpr std::uint64_t kMost = 0xffffffffU;
  return static_cast<std::uint32_t>(std::min(count, kMost));
}

void verify(const VolumeMesh& mesh, MeshInspection& out) {
  SurfaceMesh surface = out.boundary;
  surface.points = mesh.points;
  const MeshDefects defects = verifyMesh(mesh, surface);
  out.repeatedTetrahedra = narrowed(defects.repeatedTetrahedra);
  out.crowdedFaces = narrowed(defects.overfullFaces);
  out.overlaps = narrowed(defects.onesidedFaces);
  out.coincidentNodes = narrowed(defects.coincidentNodes);
}

void survey(const VolumeMesh& mesh, MeshInspection& out) {
  constexpr std::uint32_t kSlice = 1U << 16U;
  if (!(out.meanEdge > 0.0)) return;
  const SizeField field = SizeField::uniform(out.meanEdge);
  QualitySurvey survey(mesh, out.boundary, field);
  while (!survey.advance(kSlice)) {
  }
  out.quality = survey.summary();
  out.statistics = survey.statistics();
}

}  // namespace

MeshInspection inspectMesh(std::span<const double> points,
                           std::span<const std::uint32_t> tetrahedra,
                           std::span<const std::uint32_t> regions) {
  VolumeMesh mesh;
  mesh.points.assign(points.begin(), points.end());
  mesh.tetrahedra.assign(tetrahedra.begin(), tetrahedra.end());
  mesh.regions.assign(regions.begin(), regions.end());
  MeshInspection out;
  out.isReadable = isReadable(mesh);
  if (!out.isReadable) return out;
  mesh.regions.resize(mesh.tetrahedra.size() / 4, 0);
  countNodes(mesh, out);
  turnElements(mesh, out);
  measureEdges(mesh, out);
  out.boundary = boundaryOf(mesh);
  verify(mesh, out);
  survey(mesh, out);
  return out;
}

}  // namespace tetrafront
