#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "tetrafront/grid_tools.h"

namespace tetrafront {
namespace {

/// Wanted size per mean edge length of the mesh it leads to.
constexpr double kSizePerEdge = 0.9;

/// A facet of a curved patch is not covered by the grid where another mesh has a node: the bulge
/// over an edge that spans 100 degrees of a circle.
constexpr double kOverhang = 0.25;

constexpr std::uint32_t kUnused = 0xffffffffU;
constexpr std::array<std::pair<std::size_t, std::size_t>, 6> kEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

Vec3 placeOf(const VolumeMesh& mesh, std::uint32_t node) {
  const std::size_t i = 3 * std::size_t{node};
  return {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
}

/// Per node, the mean length of the edges there, each counted once per element: those inside, with
/// more elements around them, count more.
std::vector<double> meanEdges(const VolumeMesh& mesh) {
  std::vector<double> sums(mesh.points.size() / 3, 0.0);
  std::vector<std::uint32_t> counts(sums.size(), 0);
  for (std::size_t t = 0; t + 3 < mesh.tetrahedra.size(); t += 4) {
    for (const auto& [i, j] : kEdges) {
      const std::uint32_t a = mesh.tetrahedra[t + i];
      const std::uint32_t b = mesh.tetrahedra[t + j];
      const double length = glm::length(placeOf(mesh, a) - placeOf(mesh, b));
      sums[a] += length;
      sums[b] += length;
      ++counts[a];
      ++counts[b];
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (counts[i] > 0) sums[i] /= counts[i];
  }
  return sums;
}

}  // namespace

BackgroundGrid gridFromMesh(const VolumeMesh& mesh, std::span<const double> sizes) {
  const std::vector<double> edges = sizes.empty() ? meanEdges(mesh) : std::vector<double>{};
  std::vector<std::uint32_t> numbers(mesh.points.size() / 3, kUnused);
  for (const std::uint32_t node : mesh.tetrahedra) numbers[node] = 0;
  BackgroundGrid grid;
  grid.overhang = kOverhang;
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == kUnused) continue;
    numbers[i] = static_cast<std::uint32_t>(grid.nodes.size());
    BackgroundNode node;
    node.position = placeOf(mesh, i);
    node.size = sizes.empty() ? kSizePerEdge * edges[i] : sizes[i];
    grid.nodes.push_back(node);
  }
  grid.tetrahedra.reserve(mesh.tetrahedra.size() / 4);
  for (std::size_t t = 0; t + 3 < mesh.tetrahedra.size(); t += 4) {
    const auto n = [&](std::size_t i) { return numbers[mesh.tetrahedra[t + i]]; };
    grid.tetrahedra.push_back({n(0), n(1), n(2), n(3)});
  }
  return grid;
}

}  // namespace tetrafront
