#include "fill/fill_result.h"

#include <algorithm>

namespace tetrafront {
namespace {

class ResultCollector {
 public:
  ResultCollector(const FillMesh& mesh, std::size_t givenNodes,
                  std::span<const NodeId> interiorPoints)
      : mesh_(mesh), nodeOf_(mesh.points.size()), isVisited_(mesh.slotCount(), 0) {
    for (std::size_t i = 0; i < givenNodes; ++i) nodeOf_[i] = NodeId(i);
    for (const NodeId node : interiorPoints) {
      if (!mesh.points.isDouble(node)) continue;
      nodeOf_[node.index()] = NodeId(givenNodes + result_.newPositions.size());
      result_.newPositions.push_back(mesh.points.position(node));
    }
  }

  FillResult collect() {
    for (std::size_t i = 0; i < mesh_.slotCount(); ++i) {
      if (mesh_.isLive(TetId(i)) && isVisited_[i] == 0) collectPocketAround(TetId(i));
    }
    return std::move(result_);
  }

 private:
  /// Tetrahedra connected over faces belong to one pocket.
  void collectPocketAround(TetId first) {
    std::vector<TetId> pocket{first};
    isVisited_[first.index()] = 1;
    FacetId facet;
    for (std::size_t i = 0; i < pocket.size(); ++i) {
      const FillTet& t = mesh_.tet(pocket[i]);
      for (std::size_t k = 0; k < 4; ++k) {
        facet = std::min(facet, t.facet[k]);
        const TetId beyond = t.across[k].tet;
        if (beyond.isNone() || isVisited_[beyond.index()] != 0) continue;
        isVisited_[beyond.index()] = 1;
        pocket.push_back(beyond);
      }
    }
    for (const TetId tet : pocket) {
      if (isOpen(tet)) {
        collectOpenFaces(tet, facet);
      } else {
        collectTetrahedron(tet, facet);
      }
    }
  }

  void collectTetrahedron(TetId tet, FacetId facet) {
    const NodeQuad& n = mesh_.tet(tet).nodes;
    result_.tetrahedra.push_back({nodeOf_[n[0].index()], nodeOf_[n[1].index()],
                                  nodeOf_[n[2].index()], nodeOf_[n[3].index()]});
    result_.facetOfTetrahedron.push_back(facet);
  }

  /// A tetrahedron with a point that doubles cannot hold stays open.
  [[nodiscard]] bool isOpen(TetId tet) const {
    const NodeQuad& n = mesh_.tet(tet).nodes;
    return std::ranges::any_of(n, [&](NodeId node) { return !mesh_.points.isDouble(node); });
  }

  void collectOpenFaces(TetId tet, FacetId facet) {
    const FillTet& t = mesh_.tet(tet);
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (t.across[k].isNone()) {
        result_.openTriangles.push_back(t.facet[k]);
      } else if (!isOpen(t.across[k].tet)) {
        const NodeTriple n = mesh_.innerFace(tet, k);
        result_.openFaces.push_back(
            {nodeOf_[n[0].index()], nodeOf_[n[1].index()], nodeOf_[n[2].index()]});
        result_.facetOfOpenFace.push_back(facet);
      }
    }
  }

  const FillMesh& mesh_;
  std::vector<NodeId> nodeOf_;  ///< per point of the mesh: its node in the result
  std::vector<std::uint8_t> isVisited_;
  FillResult result_;
};

}  // namespace

FillResult collectResult(const FillMesh& mesh, std::size_t givenNodes,
                         std::span<const NodeId> interiorPoints) {
  return ResultCollector(mesh, givenNodes, interiorPoints).collect();
}

}  // namespace tetrafront
