#include "tetrafront/second_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/ids.h"
#include "base/sort.h"
#include "base/task.h"
#include "base/tool_job.h"
#include "curved/curved_mesh.h"
#include "curved/untangling.h"
#include "geom/coordinates.h"
#include "geom/predicates.h"
#include "topology/mesh_access.h"
#include "topology/node_lists.h"

namespace tetrafront {
namespace {

/// What SecondOrderBuilder was given.
struct BuilderInput {
  VolumeMesh mesh;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> curvedEdges;
  std::vector<double> curvedMiddles;
};

bool areReadable(std::span<const double> coordinates) {
  return coordinates.size() % 3 == 0 && std::ranges::all_of(coordinates, [](double x) {
           return std::fabs(x) <= kLargestCoordinate;
         });
}

bool areReadable(std::span<const std::uint32_t> indices, std::size_t perEntry, std::size_t nodes) {
  return indices.size() % perEntry == 0 &&
         std::ranges::all_of(indices, [nodes](std::uint32_t node) { return node < nodes; });
}

bool isReadable(const BuilderInput& input) {
  const std::size_t nodes = countNodes(input.mesh);
  return !input.mesh.tetrahedra.empty() && areReadable(input.mesh.points) &&
         areReadable(input.curvedMiddles) && areReadable(input.mesh.tetrahedra, 4, nodes) &&
         areReadable(input.triangles, 3, nodes) && areReadable(input.curvedEdges, 2, nodes) &&
         3 * input.curvedEdges.size() == 2 * input.curvedMiddles.size();
}

/// True if the position is halfway between the ends, up to rounding.
bool isHalfway(const Vec3& position, const Vec3& a, const Vec3& b) {
  // Shares of the edge's length, for middles that were computed from curves, and of the coordinates, for their rounding.
  constexpr double kOfLength = 1e-12;
  constexpr double kOfCoordinates = 4.0 * std::numeric_limits<double>::epsilon();
  const double tolerance =
      kOfLength * magnitudeOf(b - a) + kOfCoordinates * std::max(magnitudeOf(a), magnitudeOf(b));
  return magnitudeOf(position - 0.5 * (a + b)) <= tolerance;
}

void addGivenEdge(const BuilderInput& input, std::size_t edge, CurvedMesh& curved) {
  const NodeId a{input.curvedEdges[2 * edge]};
  const NodeId b{input.curvedEdges[2 * edge + 1]};
  if (a == b) return;
  MiddleNode& middle = curved.middles.at(a, b);
  if (middle.isFixed) return;
  middle.position = {input.curvedMiddles[3 * edge], input.curvedMiddles[3 * edge + 1],
                     input.curvedMiddles[3 * edge + 2]};
  middle.isFixed = true;
  middle.isStraight = isHalfway(middle.position, curved.pointAt(a), curved.pointAt(b));
}

void addStraightEdges(std::span<const std::uint32_t> triangles, std::size_t triangle,
                      CurvedMesh& curved) {
  for (std::size_t k = 0; k < 3; ++k) {
    const NodeId a{triangles[3 * triangle + k]};
    const NodeId b{triangles[3 * triangle + (k + 1) % 3]};
    if (a == b) continue;
    MiddleNode& middle = curved.middles.at(a, b);
    if (!middle.isFixed) middle.isStraight = true;
    middle.isFixed = true;
  }
}

/// Classifies an element with straight edges, and measures it with its own edges.
void measure(TetId tet, CurvedMesh& curved) {
  const auto [a, b, c, d] = cornersOf(curved.mesh(), tet);
  curved.isInverted[tet.index()] = orient3d(a, b, c, d) <= 0 ? 1 : 0;
  curved.scaled[tet.index()] = curved.measured(tet);
}

/// Improves the elements that need it; returns the nodes that were moved.
Task<std::vector<NodeId>> untangle(Work& work, const BuilderInput& input, CurvedMesh& curved) {
  const std::size_t nodes = countNodes(input.mesh);
  const std::size_t triangles = input.triangles.size() / 3;
  const std::size_t elements = countTetrahedra(input.mesh);
  work.beginPart(0.2);
  co_await work.forEachBlock(triangles, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) addStraightEdges(input.triangles, t, curved);
  });
  // All edges that are known now belong to the boundary.
  std::vector<std::uint8_t> isFixed(nodes, 0);
  for (std::size_t n = 0; n < nodes; ++n) isFixed[n] = curved.middles.touches(NodeId(n)) ? 1 : 0;
  NodeLists<TetId> atNodes(nodes);
  co_await work.forEachId<TetId>(elements, [&](TetId tet) {
    for (const NodeId node : nodesOf(input.mesh, tet)) atNodes.count(node);
  });
  atNodes.endCounting();
  co_await work.forEachId<TetId>(elements, [&](TetId tet) {
    for (const NodeId node : nodesOf(input.mesh, tet)) atNodes.add(node, tet);
  });
  work.beginPart(1.0);
  Untangling untangling(curved, atNodes, isFixed);
  co_await untangling.run(work);
  const std::span<const NodeId> moved = untangling.movedNodes();
  co_return std::vector<NodeId>(moved.begin(), moved.end());
}

void takeEdges(const CurvedMesh& curved, SecondOrderMesh& out) {
  std::vector<MiddleNode> entries;
  for (const MiddleNode& middle : curved.middles.entries()) {
    if (!middle.isStraight || middle.isStraightened) entries.push_back(middle);
  }
  stableSort(entries, [](const MiddleNode& a, const MiddleNode& b) { return a.ends < b.ends; });
  for (const MiddleNode& middle : entries) {
    std::vector<std::uint32_t>& edges = middle.isStraight ? out.straightened : out.edges;
    edges.insert(edges.end(), {middle.ends.low.value, middle.ends.high.value});
    if (middle.isStraight) continue;
    const Vec3& at = middle.position;
    out.middles.insert(out.middles.end(), {at.x, at.y, at.z});
  }
}

void takeNodes(const CurvedMesh& curved, std::vector<NodeId> moved, SecondOrderMesh& out) {
  sortUnique(moved);
  for (const NodeId node : moved) {
    const Vec3 at = curved.pointAt(node);
    out.movedNodes.push_back(node.value);
    out.movedPoints.insert(out.movedPoints.end(), {at.x, at.y, at.z});
  }
}

/// Counts the elements, and lists those that are curved.
void takeElement(TetId tet, const CurvedMesh& curved, double& sum, SecondOrderMesh& out) {
  double scaled = curved.scaled[tet.index()];
  if (curved.isInverted[tet.index()] != 0) {
    const auto [a, b, c, d] = cornersOf(curved.mesh(), tet);
    scaled = orient3d(a, b, c, d);
    out.invertedTetrahedra.push_back(tet.value);
  }
  if (scaled != 1.0) {
    out.curvedTetrahedra.push_back(tet.value);
    out.scaledJacobians.push_back(scaled);
  }
  constexpr double kBins = kScaledJacobianBins;
  const double bin = std::clamp(scaled * kBins, 0.0, kBins - 1.0);
  ++out.histogram[static_cast<std::size_t>(bin)];
  out.minScaledJacobian = std::min(out.minScaledJacobian, scaled);
  sum += scaled;
}

/// Lists the worst elements, by one pass over all curved ones.
void takeWorst(SecondOrderMesh& out) {
  std::vector<std::uint32_t> worst;  // indices in curvedTetrahedra
  const auto isWorse = [&out](std::uint32_t a, std::uint32_t b) {
    return out.scaledJacobians[a] < out.scaledJacobians[b];
  };
  for (std::uint32_t i = 0; i < out.curvedTetrahedra.size(); ++i) {
    if (worst.size() == kWorstCurvedElements) {
      if (!isWorse(i, worst.back())) continue;
      worst.pop_back();
    }
    worst.insert(std::ranges::upper_bound(worst, i, isWorse), i);
  }
  for (const std::uint32_t i : worst) out.worst.push_back(out.curvedTetrahedra[i]);
}

Task<SecondOrderMesh> build(Work& work, BuilderInput& input) {
  SecondOrderMesh out;
  out.isReadable = isReadable(input);
  if (!out.isReadable) co_return out;
  const std::size_t elements = countTetrahedra(input.mesh);
  CurvedMesh curved(input.mesh);
  work.beginPart(0.1);
  co_await work.forEachBlock(input.curvedEdges.size() / 2,
                             [&](std::size_t first, std::size_t last) {
                               for (std::size_t edge = first; edge < last; ++edge)
                                 addGivenEdge(input, edge, curved);
                             });
  work.beginPart(0.5);
  co_await work.forEachId<TetId>(elements, [&](TetId tet) { measure(tet, curved); });
  work.beginPart(0.9);
  std::vector<NodeId> moved;
  const bool isAnyPoor = std::ranges::any_of(
      curved.scaled, [](double scaled) { return scaled < kGoodScaledJacobian; });
  if (isAnyPoor) {
    std::vector<NodeId> found = co_await untangle(work, input, curved);
    moved = std::move(found);
  }
  work.beginPart(1.0);
  takeEdges(curved, out);
  takeNodes(curved, std::move(moved), out);
  out.minScaledJacobian = 1.0;
  double sum = 0.0;
  co_await work.forEachId<TetId>(elements, [&](TetId tet) { takeElement(tet, curved, sum, out); });
  out.meanScaledJacobian = sum / static_cast<double>(elements);
  takeWorst(out);
  co_return out;
}

BuilderInput copyOf(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
                    std::span<const std::uint32_t> triangles,
                    std::span<const std::uint32_t> curvedEdges,
                    std::span<const double> curvedMiddles) {
  BuilderInput input;
  input.mesh.points.assign(points.begin(), points.end());
  input.mesh.tetrahedra.assign(tetrahedra.begin(), tetrahedra.end());
  input.triangles.assign(triangles.begin(), triangles.end());
  input.curvedEdges.assign(curvedEdges.begin(), curvedEdges.end());
  input.curvedMiddles.assign(curvedMiddles.begin(), curvedMiddles.end());
  return input;
}

}  // namespace

SecondOrderBuilder::SecondOrderBuilder(std::span<const double> points,
                                       std::span<const std::uint32_t> tetrahedra,
                                       std::span<const std::uint32_t> triangles,
                                       std::span<const std::uint32_t> curvedEdges,
                                       std::span<const double> curvedMiddles)
    : SlicedTool(makeToolJob<SecondOrderMesh>(
          copyOf(points, tetrahedra, triangles, curvedEdges, curvedMiddles), build)) {}

}  // namespace tetrafront
