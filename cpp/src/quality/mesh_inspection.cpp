#include "tetrafront/mesh_inspection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/resumable.h"
#include "base/sort.h"
#include "base/task.h"
#include "base/tool_job.h"
#include "field/size_field.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "quality/mesh_boundary.h"
#include "quality/quality_analysis.h"
#include "quality/verify_mesh.h"
#include "topology/mesh_access.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

bool isReadable(const VolumeMesh& mesh) {
  const std::size_t nodes = countNodes(mesh);
  const std::size_t elements = countTetrahedra(mesh);
  return elements > 0 && mesh.points.size() % 3 == 0 && mesh.tetrahedra.size() % 4 == 0 &&
         (mesh.regions.empty() || mesh.regions.size() == elements) &&
         std::all_of(mesh.points.begin(), mesh.points.end(),
                     [](double x) { return std::fabs(x) <= kLargestCoordinate; }) &&
         std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(),
                     [nodes](std::uint32_t node) { return node < nodes; });
}

void countUsedNodes(const VolumeMesh& mesh, MeshInspection& out) {
  std::vector<std::uint8_t> isUsed(countNodes(mesh), 0);
  for (const std::uint32_t node : mesh.tetrahedra) isUsed[node] = 1;
  const auto used = std::count(isUsed.begin(), isUsed.end(), std::uint8_t{1});
  out.nodes = static_cast<std::uint32_t>(used);
  out.unusedNodes = static_cast<std::uint32_t>(isUsed.size()) - out.nodes;
}

/// Reverses the orientation of an inverted element.
void orientElement(VolumeMesh& mesh, TetId element, MeshInspection& out) {
  const auto [a, b, c, d] = cornersOf(mesh, element);
  const int sign = orient3d(a, b, c, d);
  if (sign == 0) ++out.degenerateTetrahedra;
  if (sign >= 0) return;
  ++out.invertedTetrahedra;
  std::swap(mesh.tetrahedra[4 * element.index() + 2], mesh.tetrahedra[4 * element.index() + 3]);
}

std::uint32_t narrowed(std::uint64_t count) {
  constexpr std::uint64_t kMaxCount = 0xffffffffU;
  return static_cast<std::uint32_t>(std::min(count, kMaxCount));
}

/// Regions may have any tag, and statistics are stored by index. Replaces the tags by indices; returns the tags,
/// ascending.
std::vector<std::uint32_t> numberRegions(std::vector<std::uint32_t>& regions) {
  std::vector<std::uint32_t> tags;
  for (const std::uint32_t region : regions) {
    if (tags.empty() || tags.back() != region) tags.push_back(region);
  }
  sortUnique(tags);
  for (std::uint32_t& region : regions) {
    region = static_cast<std::uint32_t>(std::ranges::lower_bound(tags, region) - tags.begin());
  }
  return tags;
}

/// Adds the lengths of the element's edges to `sum`.
void measureEdges(const VolumeMesh& mesh, TetId element, double& sum, MeshInspection& out) {
  const std::array<Vec3, 4> corners = cornersOf(mesh, element);
  for (const TetEdge& edge : kTetEdges) {
    const double length = glm::length(corners[edge.to] - corners[edge.from]);
    out.shortestEdge = std::min(out.shortestEdge, length);
    out.longestEdge = std::max(out.longestEdge, length);
    sum += length;
  }
}

/// Moves the boundary to the inspection; returns it together with the interfaces, without positions.
SurfaceMesh takeSurface(MeshBoundary found, MeshInspection& out) {
  out.boundary = std::move(found.boundary);
  SurfaceMesh surface;
  surface.triangles = out.boundary.triangles;
  surface.triangles.insert(surface.triangles.end(), found.interfaces.begin(),
                           found.interfaces.end());
  return surface;
}

void takeDefects(const MeshDefects& defects, MeshInspection& out) {
  out.duplicateTetrahedra = narrowed(defects.duplicateTetrahedra);
  out.nonManifoldFaces = narrowed(defects.nonManifoldFaces);
  out.overlappingFaces = narrowed(defects.overlappingFaces);
  out.coincidentNodes = narrowed(defects.coincidentNodes);
}

Task<MeshInspection> inspect(Work& work, VolumeMesh& mesh) {
  MeshInspection out;
  out.isReadable = isReadable(mesh);
  if (!out.isReadable) co_return out;
  mesh.regions.resize(countTetrahedra(mesh), 0);
  const std::vector<std::uint32_t> regionTags = numberRegions(mesh.regions);
  countUsedNodes(mesh, out);
  co_await work.yield();

  work.beginPart(0.15);
  out.tetrahedra = countTetrahedra(mesh);
  out.shortestEdge = std::numeric_limits<double>::infinity();  // until the first edge
  double edgeSum = 0.0;
  co_await work.forEachId<TetId>(out.tetrahedra, [&](TetId element) {
    orientElement(mesh, element, out);
    measureEdges(mesh, element, edgeSum, out);
  });
  out.meanEdge = edgeSum / (6.0 * out.tetrahedra);

  work.beginPart(0.4);
  MeshBoundary found = co_await findMeshBoundary(work, mesh);
  const SurfaceMesh withInterfaces = takeSurface(std::move(found), out);
  work.beginPart(0.6);
  {
    SurfaceMesh surface = out.boundary;
    surface.points = mesh.points;
    MeshVerifier verifier(mesh, surface);
    co_await work.finish(verifier);
    takeDefects(verifier.defects(), out);
  }
  for (std::uint32_t& region : out.boundary.trianglePatch) region = regionTags[region];
  if (!(out.meanEdge > 0.0)) co_return out;

  work.beginPart(1.0);
  const SizeField field = SizeField::uniform(out.meanEdge);
  QualityAnalysis analysis(mesh, withInterfaces, field);
  co_await work.finish(analysis);
  out.quality = analysis.summary();
  out.statistics = analysis.statistics();
  for (RegionStatistics& own : out.statistics.regions) own.region = regionTags[own.region];
  co_return out;
}

VolumeMesh copyOf(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
                  std::span<const std::uint32_t> regions) {
  VolumeMesh mesh;
  mesh.points.assign(points.begin(), points.end());
  mesh.tetrahedra.assign(tetrahedra.begin(), tetrahedra.end());
  mesh.regions.assign(regions.begin(), regions.end());
  return mesh;
}

}  // namespace

MeshInspector::MeshInspector(std::span<const double> points,
                             std::span<const std::uint32_t> tetrahedra,
                             std::span<const std::uint32_t> regions)
    : SlicedTool(makeToolJob<MeshInspection>(copyOf(points, tetrahedra, regions), inspect)) {}

MeshInspection inspectMesh(std::span<const double> points,
                           std::span<const std::uint32_t> tetrahedra,
                           std::span<const std::uint32_t> regions) {
  MeshInspector inspector(points, tetrahedra, regions);
  finish(inspector);
  return inspector.result();
}

}  // namespace tetrafront
