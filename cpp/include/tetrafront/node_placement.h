#pragma once

/// @file Moves the nodes of a surface mesh onto the faces and edges of the TrimmedModel that it approximates.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/sliced_tool.h"
#include "tetrafront/trimmed_model.h"

namespace tetrafront {

/// Triangles near the faces of a model, such as those of a CAD kernel. The nearest triangle gives the face near a position.
struct ModelTriangles {
  std::vector<double> points;      ///< x y z per node
  std::vector<double> parameters;  ///< u v per node, on the surface of the face of its triangles
  std::vector<std::uint32_t> triangles;  ///< three nodes each, counter-clockwise seen from outside
  std::vector<std::uint32_t> faces;      ///< per triangle: index of its face in the model
};

struct NodePlacement {
  std::vector<double> points;  ///< x y z per node of the mesh, in its order
  std::uint32_t placed = 0;    ///< nodes on a face, an edge or a vertex of the model
  /// Nodes that stayed where they were: no face is near, or triangles beside them would have folded over.
  std::vector<std::uint32_t> unplaced;
  double largestMove = 0.0;
  /// The edges of the mesh that the model bends, two nodes each, the lower one first, ascending; and x y z of the place on the
  /// model that is nearest to the middle of each.
  std::vector<std::uint32_t> curvedEdges;
  std::vector<double> middles;
};

/// Places nodes, in slices of about one node per unit. Nodes on lines between groups are moved to edges of the model,
/// ends of such lines to its vertices, and all others to its faces. A node moves to the nearest place whose normal or direction
/// is similar. O(n log m) for n nodes and m triangles of the model.
class NodePlacer : public SlicedTool<NodePlacement> {
 public:
  /// The arrays of the mesh are as for MeshRun; `groups`: a number per triangle,
  /// such as its face; if it is empty, sharp edges are the lines. `model`: numbers of a TrimmedModel
  /// (see model/model_numbers.h). If they cannot be read, all nodes are unplaced; faces and edges whose surface or curve is
  /// invalid attract no node. `reach`: largest move of a node, such as the deviation of the mesh from the model; the model's
  /// triangles must not be farther than this from its faces, or they are not found for all nodes.
  NodePlacer(std::span<const double> points, std::span<const std::uint32_t> triangles,
             std::span<const std::uint32_t> groups, std::span<const double> model,
             const ModelTriangles& modelTriangles, double reach);
};

}  // namespace tetrafront
