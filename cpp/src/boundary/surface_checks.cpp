#include "boundary/surface_checks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/diagnostics.h"
#include "base/sort.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "topology/face_table.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

bool isExact(double coordinate) {
  const double magnitude = std::fabs(coordinate);
  return magnitude == 0.0 || (magnitude >= kSmallestCoordinate && magnitude <= kLargestCoordinate);
}

void checkCoordinates(const SurfaceMesh& mesh, BoundaryReport& report) {
  double largest = 0.0;
  bool isExtentKnown = countNodes(mesh) > 0;
  for (std::uint32_t i = 0; i < countNodes(mesh); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = mesh.points[3 * std::size_t{i} + k];
      if (!isExact(x)) {
        report.addNode(diagnoseCounted<DiagnosticCode::kNotFinite>(x), NodeId(i));
        isExtentKnown = false;
        break;
      }
      largest = std::max(largest, std::fabs(x));
    }
  }
  if (isExtentKnown && largest < kSmallestExtent) {
    report.addNode(diagnoseCounted<DiagnosticCode::kNotFinite>(largest), NodeId(0U));
  }
}

}  // namespace

void checkNumbers(const SurfaceMesh& mesh, BoundaryReport& report) {
  if (mesh.points.size() % 3 != 0) {
    report.addIncomplete(EntityKind::kSurfaceNode, countNodes(mesh));
  }
  if (mesh.triangles.size() % 3 != 0) {
    report.addIncomplete(EntityKind::kTriangle, countTriangles(mesh));
  }
  if (report.hasErrors()) return;
  if (mesh.triangles.empty()) report.addEmpty();
  checkCoordinates(mesh, report);
  for (std::size_t h = 0; h < mesh.triangles.size(); ++h) {
    if (mesh.triangles[h] < countNodes(mesh)) continue;
    report.addTriangle(diagnoseCounted<DiagnosticCode::kIndexOutOfRange>(mesh.triangles[h]),
                       triangleOf(HalfEdgeId(h)));
  }
}

InvalidTriangles checkTriangles(const SurfaceMesh& mesh, BoundaryReport& report) {
  const std::uint32_t count = countTriangles(mesh);
  InvalidTriangles invalid{std::vector<std::uint8_t>(count, 0),
                           std::vector<std::uint8_t>(count, 0)};
  FaceTable<TriangleId> faces(countNodes(mesh));
  for (const TriangleId t : IdRange<TriangleId>(count)) {
    const NodeTriple n = sorted(nodesOf(mesh, t));
    const bool isRepeated = n[0] == n[1] || n[1] == n[2];
    if (isRepeated || collinear(pointOf(mesh, n[0]), pointOf(mesh, n[1]), pointOf(mesh, n[2]))) {
      report.addTriangle(diagnoseCounted<DiagnosticCode::kDegenerateTriangle>(), t);
      invalid.inTopology[t.index()] = isRepeated ? 1 : 0;
      invalid.inGeometry[t.index()] = 1;
    }
    faces.count(n);
  }
  faces.endCounting();
  for (const TriangleId t : IdRange<TriangleId>(count)) faces.add(nodesOf(mesh, t), t);
  for (const NodeId node : IdRange<NodeId>(countNodes(mesh))) {
    faces.forEachGroup(node, [&](const auto& same) {
      for (std::size_t i = 1; i < same.size(); ++i) {
        const TriangleId triangle = same[i].owner;
        if (invalid.inTopology[triangle.index()] != 0) continue;
        report.addTrianglePair(diagnoseCounted<DiagnosticCode::kDuplicateTriangle>(),
                               same[i - 1].owner, triangle, centroidOf(cornersOf(mesh, triangle)));
        invalid.inTopology[triangle.index()] = 1;
        invalid.inGeometry[triangle.index()] = 1;
      }
    });
  }
  return invalid;
}

void checkCoincidentNodes(const SurfaceMesh& mesh, BoundaryReport& report) {
  struct Entry {
    std::array<double, 3> position;
    NodeId node;
  };
  std::vector<std::uint8_t> isUsed(countNodes(mesh), 0);
  for (const std::uint32_t node : mesh.triangles) isUsed[node] = 1;
  std::vector<Entry> entries;
  entries.reserve(isUsed.size());
  for (std::uint32_t i = 0; i < isUsed.size(); ++i) {
    if (isUsed[i] == 0) continue;
    const Vec3 p = pointOf(mesh, NodeId(i));
    entries.push_back({{p.x, p.y, p.z}, NodeId(i)});
  }
  stableSort(entries, [](const Entry& a, const Entry& b) {
    return a.position != b.position ? a.position < b.position : a.node < b.node;
  });
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].position != entries[i - 1].position) continue;
    report.addNodePair(diagnoseCounted<DiagnosticCode::kCoincidentNodes>(), entries[i - 1].node,
                       entries[i].node);
  }
}

void checkEdges(const SurfaceMesh& mesh, const EdgeTable& edges, BoundaryReport& report) {
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    if (halfEdges.size() > 1) continue;
    const HalfEdgeNodes nodes = nodesOf(mesh.triangles, halfEdges[0]);
    report.addEdge(diagnoseCounted<DiagnosticCode::kOpenEdge>(), nodes.from, nodes.to,
                   std::array{triangleOf(halfEdges[0])});
  }
}

}  // namespace tetrafront
