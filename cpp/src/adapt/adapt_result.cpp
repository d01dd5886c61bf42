#include "adapt/adapt_result.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "adapt/badness.h"
#include "adapt/edge_list.h"
#include "geom/exponential.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Index of the class of MetricStatistics::lengths.
std::size_t lengthClass(double length) {
  constexpr double kClassesPerLn2 = 5.7707801635558536;  // 4 / ln 2
  const double index = std::floor(kClassesPerLn2 * logarithm(length)) + 0.5 * kLengthClasses;
  return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(kLengthClasses - 1)));
}

void measureEdges(std::span<const AdaptEdge> edges, MetricStatistics& out) {
  out.edges = static_cast<std::uint32_t>(edges.size());
  if (edges.empty()) return;
  out.shortest = edges[0].length;
  std::size_t units = 0;
  std::size_t peaked = 0;
  for (const AdaptEdge& edge : edges) {
    units += edge.length >= kLeastUnitLength && edge.length <= kLargestUnitLength ? 1 : 0;
    peaked += edge.length >= 0.8 && edge.length <= 1.25 ? 1 : 0;
    out.shortest = std::min(out.shortest, edge.length);
    out.longest = std::max(out.longest, edge.length);
    ++out.lengths[lengthClass(edge.length)];
  }
  const auto count = static_cast<double>(edges.size());
  out.unitEdges = static_cast<double>(units) / count;
  out.peakedEdges = static_cast<double>(peaked) / count;
}

/// Numbers the nodes of the result: nodes of the surface first.
class ResultNodes {
 public:
  ResultNodes(const AdaptStart& start, const GivenMesh& given, AdaptedMesh& out)
      : start_(start),
        out_(out),
        made_(start.mesh.nodes.size(), kNoIndex),
        ofOrigin_(given.nodeOrigin.size(), kNoIndex) {}

  std::uint32_t operator()(NodeId node) {
    std::uint32_t& made = made_[node.index()];
    if (made != kNoIndex) return made;
    const AdaptNode& own = start_.mesh.node(node);
    const bool isGiven = own.place.kind == PlaceKind::kFixed && node.index() < start_.origin.size();
    std::uint32_t* known = isGiven ? &ofOrigin_[start_.origin[node.index()].index()] : nullptr;
    if (known != nullptr && *known != kNoIndex) return made = *known;
    made = countNodes(out_.mesh);
    if (known != nullptr) *known = made;
    for (const double x : {own.point.x, own.point.y, own.point.z}) out_.mesh.points.push_back(x);
    out_.metrics.resize(out_.metrics.size() + kTensorNumbers);
    putTensor(out_.metrics, made, own.metric);
    return made;
  }
  /// Returns the node of a fixed given one.
  [[nodiscard]] std::uint32_t ofGiven(std::uint32_t origin) const { return ofOrigin_[origin]; }

 private:
  const AdaptStart& start_;
  AdaptedMesh& out_;
  std::vector<std::uint32_t> made_;
  std::vector<std::uint32_t> ofOrigin_;
};

}  // namespace

Task<MetricStatistics> measureInMetric(Work& work, const AdaptMesh& mesh) {
  MetricStatistics out;
  const std::vector<AdaptEdge> edges = co_await listEdges(work, mesh);
  measureEdges(edges, out);
  co_await work.yield();
  double sum = 0.0;
  out.leastQuality = 1.0;
  for (const AdaptElement& element : mesh.elements) {
    if (!element.isAlive()) continue;
    ++out.tetrahedra;
    sum += element.quality;
    out.leastQuality = std::min(out.leastQuality, element.quality);
  }
  out.meanQuality = sum / std::max(1U, out.tetrahedra);
  for (const AdaptNode& node : mesh.nodes) out.nodes += node.element.isNone() ? 0 : 1;
  co_return out;
}

AdaptedMesh takeAdapted(const AdaptStart& start, const GivenMesh& given, const BoundaryGuide& guide,
                        std::span<const std::uint32_t> keptPatches) {
  AdaptedMesh out;
  ResultNodes nodes(start, given, out);
  const AdaptMesh& mesh = start.mesh;
  SurfaceMesh& surface = out.surface;
  for (const AdaptElement& element : mesh.elements) {
    if (!element.isAlive()) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      if (element.beyond[k].isElement()) continue;
      // Nodes of kept faces get their numbers, too.
      const auto& [a, b, c] = kFaceCorners[k];
      const std::array face{nodes(element.nodes[a]), nodes(element.nodes[b]),
                            nodes(element.nodes[c])};
      if (!element.beyond[k].isPatch()) continue;
      surface.triangles.insert(surface.triangles.end(), face.begin(), face.end());
      surface.trianglePatch.push_back(guide.reference().patch(element.beyond[k].patch()).group);
      surface.triangleRegions.push_back(mesh.node(element.nodes[a]).part);
      surface.triangleRegions.push_back(SurfaceMesh::kNoRegion);
    }
  }
  for (std::size_t t = 0, kept = 0; 3 * t < given.surface.triangles.size(); ++t) {
    if (given.surface.triangleRegions[2 * t + 1] == SurfaceMesh::kNoRegion) continue;
    for (std::size_t k = 0; k < 3; ++k)
      surface.triangles.push_back(nodes.ofGiven(given.surface.triangles[3 * t + k]));
    surface.trianglePatch.push_back(keptPatches[kept++]);
    surface.triangleRegions.push_back(given.surface.triangleRegions[2 * t]);
    surface.triangleRegions.push_back(given.surface.triangleRegions[2 * t + 1]);
  }
  surface.points = out.mesh.points;
  for (const AdaptElement& element : mesh.elements) {
    if (!element.isAlive()) continue;
    for (const NodeId node : element.nodes) out.mesh.tetrahedra.push_back(nodes(node));
    out.mesh.regions.push_back(mesh.node(element.nodes[0]).part);
  }
  return out;
}

}  // namespace tetrafront
