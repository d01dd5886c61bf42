#include "tetrafront/grid_from_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "topology/mesh_access.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

/// Target size / mean edge length of the mesh that it leads to.
constexpr double kSizePerEdge = 0.9;

/// Coverage margin: on a curved patch, another mesh has nodes outside the triangles of this one.
/// Allows for the bulge over an edge that spans 100 degrees of a circle.
constexpr double kMeshCoverageMargin = 0.25;

/// Visits the elements to average the edge lengths at each node, then the nodes, then the elements
/// again to add them to the grid. Leaves out nodes without elements.
class GridMaker final : public ToolWork<BackgroundGrid> {
 public:
  GridMaker(VolumeMesh mesh, std::vector<double> sizes)
      : mesh_(std::move(mesh)),
        sizes_(std::move(sizes)),
        isUsed_(countNodes(mesh_), 0),
        gridNodes_(countNodes(mesh_)),
        elements_(countTetrahedra(mesh_)) {
    if (sizes_.empty()) {
      edgeSums_.assign(countNodes(mesh_), 0.0);
      edgeCounts_.assign(countNodes(mesh_), 0);
    }
    grid_.coverageMargin = kMeshCoverageMargin;
    grid_.nodes.reserve(countNodes(mesh_));
    grid_.tetrahedra.reserve(elements_);
  }

  bool advance(std::uint32_t budget) override {
    const std::size_t last = next_ + std::min<std::size_t>(budget, steps() - next_);
    for (; next_ < last; ++next_) step(next_);
    return next_ == steps();
  }
  [[nodiscard]] double fraction() const override {
    return steps() == 0 ? 1.0 : static_cast<double>(next_) / static_cast<double>(steps());
  }
  [[nodiscard]] const BackgroundGrid& result() const override { return grid_; }

 private:
  [[nodiscard]] std::size_t steps() const { return 2 * elements_ + countNodes(mesh_); }

  void step(std::size_t number) {
    if (number < elements_) return readElement(TetId(number));
    const std::size_t after = number - elements_;
    if (after < countNodes(mesh_)) return addNode(NodeId(after));
    addElement(TetId(after - countNodes(mesh_)));
  }

  /// An edge counts once per element, so interior edges, which have more elements, have more
  /// weight.
  void readElement(TetId element) {
    const NodeQuad nodes = nodesOf(mesh_, element);
    for (const NodeId node : nodes) isUsed_[node.index()] = 1;
    if (!sizes_.empty()) return;
    for (const TetEdge& edge : kTetEdges) {
      const NodeId a = nodes[edge.from];
      const NodeId b = nodes[edge.to];
      const double length = glm::length(pointOf(mesh_, a) - pointOf(mesh_, b));
      edgeSums_[a.index()] += length;
      edgeSums_[b.index()] += length;
      ++edgeCounts_[a.index()];
      ++edgeCounts_[b.index()];
    }
  }

  void addNode(NodeId id) {
    const std::size_t i = id.index();
    if (isUsed_[i] == 0) return;
    gridNodes_[i] = GridNodeId(grid_.nodes.size());
    BackgroundNode node;
    node.position = pointOf(mesh_, id);
    node.size = sizes_.empty() ? kSizePerEdge * (edgeSums_[i] / edgeCounts_[i]) : sizes_[i];
    grid_.nodes.push_back(node);
  }

  void addElement(TetId element) {
    const auto [a, b, c, d] = nodesOf(mesh_, element);
    const auto indexOf = [&](NodeId node) { return gridNodes_[node.index()].value; };
    grid_.tetrahedra.push_back({indexOf(a), indexOf(b), indexOf(c), indexOf(d)});
  }

  VolumeMesh mesh_;
  std::vector<double> sizes_;
  std::vector<std::uint8_t> isUsed_;       ///< per node of the mesh: 1 if an element uses it
  std::vector<GridNodeId> gridNodes_;      ///< per node of the mesh: its node of the grid
  std::vector<double> edgeSums_;           ///< per node: sum of its edge lengths
  std::vector<std::uint32_t> edgeCounts_;  ///< per node: number of its edges
  std::size_t elements_;
  std::size_t next_ = 0;
  BackgroundGrid grid_;
};

}  // namespace

MeshGridBuilder::MeshGridBuilder(VolumeMesh mesh, std::vector<double> sizes)
    : SlicedTool(std::make_unique<GridMaker>(std::move(mesh), std::move(sizes))) {}

BackgroundGrid gridFromMesh(const VolumeMesh& mesh, std::span<const double> sizes) {
  MeshGridBuilder builder(mesh, {sizes.begin(), sizes.end()});
  while (!builder.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return builder.result();
}

}  // namespace tetrafront
