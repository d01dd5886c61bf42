#pragma once

/// @file The boundary around a point that was added on it: the parts of each given triangle there,
/// and their triangulation without the point.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "fill/fill_mesh.h"

namespace tetrafront {

class BoundaryFans {
 public:
  /// `triangles` gives the planes of the facets. Both must outlive this object.
  BoundaryFans(const FillMesh& mesh, const std::vector<NodeTriple>& triangles)
      : mesh_(mesh), triangles_(triangles) {}

  /// Describes the boundary around `point`. `star` must be all tetrahedra there, connected over
  /// faces. Returns false if the faces form no fans, or if a fan cannot be triangulated without the
  /// point; neither occurs in a valid mesh.
  bool describe(NodeId point, std::span<const TetId> star);

  /// Returns true if `apex` sees every fan from inside, or is a node of it. Uses exact signs.
  [[nodiscard]] bool areVisibleFrom(NodeId apex) const;
  /// The faces of the boundary without the point.
  [[nodiscard]] std::vector<BoundaryFace> faces() const;
  /// The same for a cone with this apex: in a fan that contains the apex, all triangles meet at it.
  [[nodiscard]] std::vector<BoundaryFace> facesFor(NodeId apex) const;
  /// The given triangles around the point: one if it is inside a triangle, two if it is on an edge.
  [[nodiscard]] std::vector<NodeTriple> planes() const;

 private:
  /// The boundary faces around the point that are part of one given triangle.
  struct Fan {
    FacetId facet;
    std::vector<NodeId> polygon;  ///< nodes around the point, counter-clockwise seen from inside
    NodeId above;                 ///< an interior node off the plane, for signs in the plane
    std::vector<BoundaryFace> triangles;  ///< triangulation without the point
  };
  using Link = std::array<NodeId, 2>;  ///< two consecutive nodes of a polygon

  static bool chain(const std::vector<Link>& links, Fan& fan);
  bool triangulate(Fan& fan) const;
  [[nodiscard]] bool isEar(const std::vector<NodeId>& rest, std::size_t i, NodeId above) const;
  [[nodiscard]] double shapeOfEar(const NodeTriple& ear) const;

  const FillMesh& mesh_;
  const std::vector<NodeTriple>& triangles_;
  std::vector<Fan> fans_;  ///< ascending by facet
};

}  // namespace tetrafront
