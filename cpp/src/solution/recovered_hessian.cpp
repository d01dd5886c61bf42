#include "solution/recovered_hessian.h"

#include <cstddef>

#include "base/ids.h"
#include "solution/quadratic_fit.h"
#include "topology/mesh_access.h"
#include "topology/node_lists.h"

namespace tetrafront {
namespace {

/// Samples with which the first neighbourhood is tried.
constexpr std::size_t kEnoughSamples = 12;
/// Conditioning from which a fit is accepted; below, the neighbourhood grows by the neighbours of its nodes.
constexpr double kGoodConditioning = 0.02;
constexpr int kLargestNeighbourhood = 6;

/// A fit costs about as much as this many steps of the front.
constexpr std::size_t kUnitsPerFit = 2;

/// Nodes and elements around each node.
struct Neighbours {
  NodeLists<NodeId> nodes;
  NodeLists<TetId> elements;

  Neighbours(const VolumeMesh& mesh, const MeshEdges& edges)
      : nodes(countNodes(mesh)), elements(countNodes(mesh)) {
    for (const auto& [a, b] : edges) {
      nodes.count(NodeId(a));
      nodes.count(NodeId(b));
    }
    nodes.endCounting();
    for (const auto& [a, b] : edges) {
      nodes.add(NodeId(a), NodeId(b));
      nodes.add(NodeId(b), NodeId(a));
    }
    const auto forEachCorner = [&](const auto& use) {
      for (std::uint32_t t = 0; t < countTetrahedra(mesh); ++t)
        for (const NodeId node : nodesOf(mesh, TetId(t))) use(node, TetId(t));
    };
    forEachCorner([&](NodeId node, TetId) { elements.count(node); });
    elements.endCounting();
    forEachCorner([&](NodeId node, TetId tet) { elements.add(node, tet); });
  }
};

class HessianRecovery {
 public:
  HessianRecovery(const VolumeMesh& mesh, const MeshEdges& edges, SampledValues samples)
      : mesh_(mesh),
        samples_(samples),
        neighbours_(mesh, edges),
        nodeStamps_(countNodes(mesh), kNoIndex),
        elementStamps_(samples.isPerElement ? countTetrahedra(mesh) : 0, kNoIndex),
        hessians_(kTensorNumbers * countNodes(mesh) * samples.components, 0.0) {}

  void recoverAt(NodeId node) {
    if (neighbours_.nodes.at(node).empty()) return;
    gather(node);
    gathered_.resize(found_.size());
    for (std::uint32_t component = 0; component < samples_.components; ++component) {
      for (std::size_t i = 0; i < found_.size(); ++i) {
        const std::size_t first = std::size_t{samples_.components} * found_[i];
        gathered_[i] = samples_.values[first + component];
      }
      const std::size_t slot = std::size_t{countNodes(mesh_)} * component + node.index();
      putTensor(hessians_, slot, fit_.hessianOf(gathered_));
    }
  }

  [[nodiscard]] std::vector<double> take() { return std::move(hessians_); }

 private:
  /// Collects samples around a node and factors their fit.
  void gather(NodeId centre) {
    found_.clear();
    offsets_.clear();
    around_.assign(1, centre);
    nodeStamps_[centre.index()] = centre.value;
    addSamples(centre, centre);
    std::size_t first = 0;
    for (int ring = 1; ring <= kLargestNeighbourhood; ++ring) {
      const std::size_t last = around_.size();
      for (; first < last; ++first) addNeighbours(centre, around_[first]);
      const bool isComplete = around_.size() == last || ring == kLargestNeighbourhood;
      if (found_.size() < kEnoughSamples && !isComplete) continue;
      fit_.factor(offsets_);
      if (isComplete || fit_.conditioning() >= kGoodConditioning) return;
    }
  }

  void addNeighbours(NodeId centre, NodeId node) {
    for (const NodeId other : neighbours_.nodes.at(node)) {
      if (nodeStamps_[other.index()] == centre.value) continue;
      nodeStamps_[other.index()] = centre.value;
      around_.push_back(other);
      addSamples(centre, other);
    }
  }

  void addSamples(NodeId centre, NodeId node) {
    const Vec3 origin = pointOf(mesh_, centre);
    if (!samples_.isPerElement) {
      found_.push_back(node.value);
      offsets_.push_back(pointOf(mesh_, node) - origin);
      return;
    }
    for (const TetId tet : neighbours_.elements.at(node)) {
      if (elementStamps_[tet.index()] == centre.value) continue;
      elementStamps_[tet.index()] = centre.value;
      const auto [a, b, c, d] = cornersOf(mesh_, tet);
      found_.push_back(tet.value);
      offsets_.push_back(0.25 * ((a - origin) + (b - origin) + (c - origin) + (d - origin)));
    }
  }

  const VolumeMesh& mesh_;
  SampledValues samples_;
  Neighbours neighbours_;
  std::vector<std::uint32_t> nodeStamps_;
  std::vector<std::uint32_t> elementStamps_;
  std::vector<double> hessians_;
  QuadraticFit fit_;
  std::vector<NodeId> around_;
  std::vector<std::uint32_t> found_;  ///< samples
  std::vector<Vec3> offsets_;         ///< per sample found
  std::vector<double> gathered_;      ///< per sample found
};

}  // namespace

Task<std::vector<double>> recoverHessians(Work& work, const VolumeMesh& mesh,
                                          const MeshEdges& edges, SampledValues samples) {
  HessianRecovery recovery(mesh, edges, samples);
  for (std::uint32_t node = 0; node < countNodes(mesh); ++node) {
    recovery.recoverAt(NodeId(node));
    work.setFraction(static_cast<double>(node) / countNodes(mesh));
    co_await work.spend(kUnitsPerFit);
  }
  co_return recovery.take();
}

}  // namespace tetrafront
