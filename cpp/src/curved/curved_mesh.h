#pragma once

/// @file A mesh with the middles of its edges, and the scaled Jacobian of each element.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "curved/edge_middles.h"
#include "curved/jacobian.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/mesh_access.h"
#include "topology/tetrahedron.h"

namespace tetrafront {

/// The ends of edge `edge` of a tetrahedron, in the order of kTetEdges.
inline EdgeEnds endsOf(const NodeQuad& nodes, std::size_t edge) {
  return edgeBetween(nodes[kTetEdges[edge].from], nodes[kTetEdges[edge].to]);
}

class CurvedMesh {
 public:
  explicit CurvedMesh(VolumeMesh& mesh)
      : middles(countNodes(mesh)),
        scaled(countTetrahedra(mesh), 1.0),
        isInverted(countTetrahedra(mesh), 0),
        mesh_(mesh) {}

  [[nodiscard]] const VolumeMesh& mesh() const { return mesh_; }
  [[nodiscard]] Vec3 pointAt(NodeId node) const { return pointOf(mesh_, node); }
  void movePoint(NodeId node, const Vec3& position) {
    for (int k = 0; k < 3; ++k) mesh_.points[3 * node.index() + k] = position[k];
  }

  [[nodiscard]] Vec3 halfway(const EdgeEnds& ends) const {
    return 0.5 * pointAt(ends.low) + 0.5 * pointAt(ends.high);
  }
  [[nodiscard]] Vec3 middleOf(const EdgeEnds& ends) const {
    const MiddleNode* middle = middles.find(ends.low, ends.high);
    return middle == nullptr || middle->isStraight ? halfway(ends) : middle->position;
  }

  [[nodiscard]] QuadraticTet tetAt(TetId tet) const {
    const NodeQuad nodes = nodesOf(mesh_, tet);
    QuadraticTet result;
    for (std::size_t i = 0; i < 4; ++i) result.corners[i] = pointAt(nodes[i]);
    for (std::size_t e = 0; e < 6; ++e) result.middles[e] = middleOf(endsOf(nodes, e));
    return result;
  }

  /// True if an edge of the element is not straight.
  [[nodiscard]] bool isCurved(TetId tet) const {
    const NodeQuad nodes = nodesOf(mesh_, tet);
    for (std::size_t e = 0; e < 6; ++e) {
      const EdgeEnds ends = endsOf(nodes, e);
      const MiddleNode* middle = middles.find(ends.low, ends.high);
      if (middle != nullptr && !middle->isStraight) return true;
    }
    return false;
  }

  /// Returns the scaled Jacobian of an element; 1 if it is inverted.
  [[nodiscard]] double measured(TetId tet) const {
    return isInverted[tet.index()] == 0 && isCurved(tet) ? scaledJacobian(tetAt(tet)) : 1.0;
  }

  EdgeMiddles middles;
  std::vector<double> scaled;            ///< per element: its scaled Jacobian
  std::vector<std::uint8_t> isInverted;  ///< per element: has no volume with straight edges

 private:
  VolumeMesh& mesh_;
};

}  // namespace tetrafront
