#include "boundary/surface_checks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/sort.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "boundary/surface_access.h"

namespace tetrafront {
namespace {

/// Single coordinates may be smaller than the model by far, as rounded zeros are.
constexpr double kSmallestCoordinate = 0x1p-250;

}  // namespace

void checkNumbers(const SurfaceMesh& mesh, BoundaryReport& report) {
  const std::size_t nodes = mesh.points.size() / 3;
  const std::size_t triangles = mesh.triangles.size() / 3;
  if (mesh.points.size() % 3 != 0) report.addIncomplete(EntityKind::kSurfaceNode, nodes);
  if (mesh.triangles.size() % 3 != 0) report.addIncomplete(EntityKind::kTriangle, triangles);
  if (report.hasErrors()) return;
  if (mesh.triangles.empty()) report.addEmpty();
  double largest = 0.0;
  bool isKnown = nodes > 0;
  for (std::uint32_t i = 0; i < nodes; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double x = mesh.points[3 * std::size_t{i} + a];
      const double magnitude = std::fabs(x);
      const bool isExact =
          magnitude == 0.0 || (magnitude >= kSmallestCoordinate && magnitude <= kLargestCoordinate);
      if (!isExact) {
        report.addNode(DiagnosticCode::kNotFinite, i, {x});
        isKnown = false;
        break;
      }
      largest = std::max(largest, magnitude);
    }
  }
  // How large a surface with coordinates out of all bounds is nobody can say.
  if (isKnown && largest < kSmallestExtent)
    report.addNode(DiagnosticCode::kNotFinite, 0, {largest});
  for (std::size_t h = 0; h < mesh.triangles.size(); ++h) {
    if (mesh.triangles[h] < nodes) continue;
    report.addTriangle(DiagnosticCode::kIndexOutOfRange, static_cast<std::uint32_t>(h / 3),
                       {static_cast<double>(mesh.triangles[h])});
  }
}

InvalidTriangles checkTriangles(const SurfaceMesh& mesh, BoundaryReport& report) {
  struct Entry {
    std::array<std::uint32_t, 3> nodes;
    std::uint32_t triangle;
  };
  const std::size_t count = mesh.triangles.size() / 3;
  InvalidTriangles invalid{std::vector<std::uint8_t>(count, 0),
                           std::vector<std::uint8_t>(count, 0)};
  // A counting sort by the lowest node, as in EdgeTable.
  std::vector<std::uint32_t> bucket(mesh.points.size() / 3 + 1, 0);
  std::vector<Entry> entries(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::array n = sorted(std::array{mesh.triangles[3 * std::size_t{t}],
                                           mesh.triangles[3 * std::size_t{t} + 1],
                                           mesh.triangles[3 * std::size_t{t} + 2]});
    const bool repeats = n[0] == n[1] || n[1] == n[2];
    if (repeats || collinear(pointOf(mesh, n[0]), pointOf(mesh, n[1]), pointOf(mesh, n[2]))) {
      report.addTriangle(DiagnosticCode::kDegenerateTriangle, t);
      invalid.inTopology[t] = repeats ? 1 : 0;
      invalid.inGeometry[t] = 1;
    }
    entries[t] = {n, t};
    ++bucket[n[0] + 1];
  }
  for (std::size_t i = 1; i < bucket.size(); ++i) bucket[i] += bucket[i - 1];
  std::vector<Entry> byLowest(count);
  std::vector<std::uint32_t> next(bucket.begin(), bucket.end() - 1);
  for (const Entry& entry : entries) byLowest[next[entry.nodes[0]]++] = entry;
  for (std::size_t node = 0; node + 1 < bucket.size(); ++node) {
    const auto first = byLowest.begin() + bucket[node];
    const auto last = byLowest.begin() + bucket[node + 1];
    sortFew(std::span(first, last), [](const Entry& a, const Entry& b) {
      return a.nodes != b.nodes ? a.nodes < b.nodes : a.triangle < b.triangle;
    });
    for (auto at = first; at != last; ++at) {
      if (at == first || at->nodes != (at - 1)->nodes) continue;
      if (invalid.inTopology[at->triangle] != 0) continue;
      report.addTrianglePair(DiagnosticCode::kDuplicateTriangle, (at - 1)->triangle, at->triangle,
                             report.centroidOf(at->triangle));
      invalid.inTopology[at->triangle] = 1;
      invalid.inGeometry[at->triangle] = 1;
    }
  }
  return invalid;
}

void checkCoincidentNodes(const SurfaceMesh& mesh, BoundaryReport& report) {
  std::vector<std::uint8_t> isUsed(mesh.points.size() / 3, 0);
  for (const std::uint32_t node : mesh.triangles) isUsed[node] = 1;
  struct Entry {
    std::array<double, 3> place;
    std::uint32_t node;
  };
  std::vector<Entry> entries;
  entries.reserve(isUsed.size());
  for (std::uint32_t i = 0; i < isUsed.size(); ++i) {
    if (isUsed[i] == 0) continue;
    const Vec3 p = pointOf(mesh, i);
    entries.push_back({{p.x, p.y, p.z}, i});
  }
  stableSort(entries, [](const Entry& a, const Entry& b) {
    return a.place != b.place ? a.place < b.place : a.node < b.node;
  });
  for (std::size_t i = 1; i < entries.size(); ++i) {
    if (entries[i].place != entries[i - 1].place) continue;
    report.addNodePair(DiagnosticCode::kCoincidentNodes, entries[i - 1].node, entries[i].node);
  }
}

void checkEdges(const SurfaceMesh& mesh, const EdgeTable& edges, BoundaryReport& report) {
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    if (halfEdges.size() > 1) continue;
    const HalfEdgeNodes nodes = nodesOf(mesh.triangles, halfEdges[0]);
    const std::uint32_t triangle = halfEdges[0] / 3;
    report.addEdge(DiagnosticCode::kOpenEdge, nodes.from, nodes.to, {&triangle, 1});
  }
}

}  // namespace tetrafront
