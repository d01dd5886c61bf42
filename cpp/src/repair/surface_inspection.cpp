#include "repair/surface_inspection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "boundary/boundary.h"
#include "geom/measure.h"
#include "quality/metrics.h"
#include "topology/corner_fans.h"
#include "topology/edge_table.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

constexpr std::size_t kMaxWorst = 10;

bool hasCode(const std::vector<Diagnostic>& diagnostics, DiagnosticCode code) {
  return std::ranges::any_of(diagnostics, [code](const Diagnostic& d) { return d.code == code; });
}

TriangleQuality qualityOf(const SurfaceMesh& mesh, TriangleId triangle, double radiusRatio) {
  const std::array<Vec3, 3> p = cornersOf(mesh, triangle);
  const double largestCosine =
      std::max({cosineBetween(p[1] - p[0], p[2] - p[0]), cosineBetween(p[2] - p[1], p[0] - p[1]),
                cosineBetween(p[0] - p[2], p[1] - p[2])});
  return {.triangle = triangle.value,
          .centroid = centroidOf(p),
          .area = areaOf(p),
          .smallestAngle = degreesOf(largestCosine),
          .radiusRatio = radiusRatio};
}

void measureNodes(const SurfaceMesh& mesh, SurfaceInspection& found) {
  std::vector<std::uint8_t> isUsed(countNodes(mesh), 0);
  for (const std::uint32_t node : mesh.triangles) isUsed[node] = 1;
  for (std::uint32_t i = 0; i < isUsed.size(); ++i) {
    if (isUsed[i] == 0) {
      ++found.unusedNodes;
      continue;
    }
    const Vec3 p = pointOf(mesh, NodeId(i));
    if (found.nodes++ == 0) found.low = found.high = p;
    found.low = glm::min(found.low, p);
    found.high = glm::max(found.high, p);
  }
}

void measureEdges(const SurfaceMesh& mesh, const EdgeTable& edges, SurfaceInspection& found) {
  double sum = 0.0;
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    if (halfEdges.size() == 1) ++found.openEdges;
    if (halfEdges.size() > 2) ++found.nonManifoldEdges;
    const HalfEdgeNodes nodes = nodesOf(mesh.triangles, halfEdges[0]);
    const double length = glm::length(pointOf(mesh, nodes.to) - pointOf(mesh, nodes.from));
    sum += length;
    found.shortestEdge = e == 0 ? length : std::min(found.shortestEdge, length);
    found.longestEdge = std::max(found.longestEdge, length);
  }
  found.edges = static_cast<std::uint32_t>(edges.edgeCount());
  if (found.edges > 0) found.meanEdge = sum / found.edges;
}

/// Counts the nodes with more than one fan of triangles. `withoutEdges`: flags of the triangles to ignore.
std::uint32_t countNonManifoldNodes(const SurfaceMesh& mesh, const EdgeTable& edges,
                                    std::span<const std::uint8_t> withoutEdges) {
  const std::vector<HalfEdgeId> fans = cornerFans(mesh.triangles, edges);
  std::vector<std::uint8_t> fansAt(countNodes(mesh), 0);
  std::uint32_t nonManifold = 0;
  for (std::uint32_t c = 0; c < fans.size(); ++c) {
    if (fans[c] != HalfEdgeId(c) || withoutEdges[c / 3] != 0) continue;
    std::uint8_t& count = fansAt[mesh.triangles[c]];
    if (count == 1) ++nonManifold;
    if (count < 2) ++count;
  }
  return nonManifold;
}

void measureTriangles(const SurfaceMesh& mesh, SurfaceInspection& found) {
  struct Ranked {
    double radiusRatio;
    TriangleId triangle;
    bool operator<(const Ranked& other) const {
      return radiusRatio != other.radiusRatio ? radiusRatio < other.radiusRatio
                                              : triangle < other.triangle;
    }
  };
  std::vector<Ranked> worst;
  found.triangles = countTriangles(mesh);
  for (std::uint32_t t = 0; t < found.triangles; ++t) {
    const std::array<Vec3, 3> p = cornersOf(mesh, TriangleId(t));
    found.area += areaOf(p);
    const Ranked ranked{triangleRadiusRatio(p[0], p[1], p[2]), TriangleId(t)};
    if (worst.size() == kMaxWorst && !(ranked < worst.back())) continue;
    worst.insert(std::upper_bound(worst.begin(), worst.end(), ranked), ranked);
    if (worst.size() > kMaxWorst) worst.pop_back();
  }
  for (const Ranked& ranked : worst) {
    found.worst.push_back(qualityOf(mesh, ranked.triangle, ranked.radiusRatio));
  }
}

/// Counts the triangles that the boundary check has flipped: none if it stopped at an earlier error.
std::uint32_t countFlippedTriangles(const SurfaceMesh& mesh,
                                    std::span<const std::uint32_t> givenTriangles) {
  std::uint32_t flipped = 0;
  for (std::size_t i = 1; i < givenTriangles.size(); i += 3) {
    if (givenTriangles[i] != mesh.triangles[i]) ++flipped;
  }
  return flipped;
}

void measureShells(const SurfaceMesh& mesh, const Boundary& boundary, SurfaceInspection& found) {
  found.regions = boundary.regionCount;
  for (const BoundaryShell& shell : boundary.shells) {
    const bool isInterface = mesh.isInterface(shell.firstTriangle.index());
    found.volume += shell.volume;
    found.shells.push_back({.firstTriangle = shell.firstTriangle.value,
                            .triangles = shell.triangleCount,
                            .region = shell.region.value,
                            .isCavity = shell.volume < 0.0 && !isInterface,
                            .area = shell.area,
                            .volume = std::fabs(shell.volume)});
  }
}

}  // namespace

Task<SurfaceInspection> inspectSurface(Work& work, SurfaceMesh& mesh, InspectionOptions options) {
  const std::vector<std::uint32_t> givenTriangles = mesh.triangles;
  BoundaryCheck check(mesh, BoundarySource::kGivenSurface, options.innerShells,
                      MixedOrientation::kRefuse, options.maxDiagnostics);
  work.beginPart(0.9);
  co_await work.finish(check);

  SurfaceInspection found;
  found.diagnostics = check.takeDiagnostics();
  found.isFillable = check.result().isValid;
  // If a number is invalid, nothing can be measured.
  const Boundary& boundary = check.result();
  if (!boundary.edges) co_return found;
  found.isEmbedded = !hasCode(found.diagnostics, DiagnosticCode::kSelfIntersection) &&
                     !hasCode(found.diagnostics, DiagnosticCode::kDuplicateTriangle);
  measureNodes(mesh, found);
  // Without the triangles that the check ignores; otherwise the counts would contradict its diagnostics.
  measureEdges(mesh, *boundary.edges, found);
  found.nonManifoldNodes = countNonManifoldNodes(mesh, *boundary.edges, boundary.withoutEdges);
  found.isClosed = found.edges > 0 && found.openEdges == 0;
  found.isManifold = found.nonManifoldEdges == 0 && found.nonManifoldNodes == 0;
  measureTriangles(mesh, found);
  found.flippedTriangles = countFlippedTriangles(mesh, givenTriangles);
  if (found.isFillable) measureShells(mesh, boundary, found);
  co_return found;
}

}  // namespace tetrafront
