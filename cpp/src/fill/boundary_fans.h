#pragma once

/// @file The boundary around a point that had to be put on it: the pieces of each given triangle there,
/// and how they are triangulated anew without the point.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "fill/fill_mesh.h"

namespace tetrafront {

class BoundaryFans {
 public:
  /// `triangles` gives the planes of facets. Both must outlive this.
  BoundaryFans(const FillMesh& mesh, const std::vector<NodeTriple>& triangles)
      : mesh_(mesh), triangles_(triangles) {}

  /// Looks at what is around the point. `star`: all tetrahedra there, in one piece. False if the faces are
  /// no fans or cannot be triangulated without the point, which does not happen in a valid mesh.
  bool describe(NodeId point, std::span<const TetId> star);

  /// Does the node see all faces without the point, or is it one of theirs? By exact signs.
  [[nodiscard]] bool areVisibleFrom(NodeId apex) const;
  /// The boundary without the point.
  [[nodiscard]] std::vector<BoundaryFace> faces() const;
  /// The same; where the apex is on a fan, all triangles of it meet at the apex.
  [[nodiscard]] std::vector<BoundaryFace> facesFor(NodeId apex) const;
  /// The given triangles around the point: one, or the two at an edge.
  [[nodiscard]] std::vector<NodeTriple> planes() const;

 private:
  /// The faces of one given triangle.
  struct Fan {
    FacetId facet;
    std::vector<NodeId> polygon;          ///< around the point, counter-clockwise seen from inside
    NodeId above;                         ///< off the plane, inside
    std::vector<BoundaryFace> triangles;  ///< without the point
  };
  using Link = std::array<NodeId, 2>;  ///< two nodes of a polygon, one after the other

  static bool chain(const std::vector<Link>& links, Fan& fan);
  bool triangulate(Fan& fan) const;
  [[nodiscard]] bool isEar(const std::vector<NodeId>& rest, std::size_t i, NodeId above) const;
  [[nodiscard]] double shapeOfEar(const NodeTriple& ear) const;

  const FillMesh& mesh_;
  const std::vector<NodeTriple>& triangles_;
  std::vector<Fan> fans_;  ///< by their facets
};

}  // namespace tetrafront
