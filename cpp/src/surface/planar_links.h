#pragma once

/// @file Neighbours of the triangles of one patch, and the changes that keep the triangulation valid: edge
/// flip, collapse of an interior node, split of an edge, split of a triangle. The caller checks by exact
/// orientations that the new triangles are counter-clockwise.

#include <array>
#include <cstdint>
#include <vector>

#include "surface/planar_mesh.h"

namespace tetrafront {

class PlanarLinks {
 public:
  /// `mesh` must outlive this.
  explicit PlanarLinks(PlanarMesh& mesh) : mesh_(&mesh) {}

  /// Finds all neighbours of a complete triangulation. O(triangles).
  void build();

  /// Number of triangles, including removed ones.
  [[nodiscard]] std::uint32_t triangleCount() const {
    return static_cast<std::uint32_t>(neighbours_.size());
  }
  /// False if a collapse removed the triangle.
  [[nodiscard]] bool isAlive(PlanarTriangleId triangle) const {
    return !node(triangle, 0).isNone();
  }
  [[nodiscard]] PlanarNodeId node(PlanarTriangleId triangle, std::uint32_t corner) const {
    return mesh_->triangles[triangle.index()][corner];
  }
  /// The triangle across the edge opposite `corner`; none at the boundary.
  [[nodiscard]] PlanarTriangleId neighbour(PlanarTriangleId triangle, std::uint32_t corner) const {
    return neighbours_[triangle.index()][corner];
  }
  /// The corner, 0 to 2, at which the triangle has the node.
  [[nodiscard]] std::uint32_t cornerOf(PlanarTriangleId triangle, PlanarNodeId node) const;
  /// One of the node's triangles; none if the node was removed.
  [[nodiscard]] PlanarTriangleId triangleOf(PlanarNodeId node) const {
    return triangleOf_[node.index()];
  }

  /// The triangles around an interior node and the nodes around it, both counter-clockwise. Triangle i has
  /// the nodes ring[i] and ring[i + 1].
  struct Star {
    std::vector<PlanarNodeId> ring;
    std::vector<PlanarTriangleId> triangles;
  };
  /// Returns false if the node lies on the boundary or was removed; the star is then unspecified.
  [[nodiscard]] bool collectStar(PlanarNodeId centre, Star& star) const;

  /// The nodes of two neighbouring triangles: t = (c a b), and `other` = (d b a).
  struct Diamond {
    PlanarTriangleId other;
    PlanarNodeId a;
    PlanarNodeId b;
    PlanarNodeId c;
    PlanarNodeId d;
  };
  /// The diamond around the edge opposite corner k of t, which must have a neighbour.
  [[nodiscard]] Diamond diamond(PlanarTriangleId t, std::uint32_t k) const;

  /// Replaces the edge a b by c d; t becomes (c a d), the other triangle (c d b).
  void flip(PlanarTriangleId t, std::uint32_t k);
  /// Replaces the star of `centre` by the fan from ring[target].
  void collapse(PlanarNodeId centre, const Star& star, std::size_t target);
  /// Splits the edge opposite corner k of t at `middle`, a node without triangles.
  void split(PlanarTriangleId t, std::uint32_t k, PlanarNodeId middle);
  /// Splits t into three triangles around `centre`, a node without triangles.
  void insert(PlanarTriangleId t, PlanarNodeId centre);

  /// Removes dead triangles and nodes from the mesh and keeps the order of the others. The links are invalid
  /// afterwards.
  void compact();

 private:
  using Neighbours = std::array<PlanarTriangleId, 3>;
  void put(PlanarTriangleId triangle, const PlanarMesh::Triangle& nodes, const Neighbours& around);
  void replaceNeighbour(PlanarTriangleId triangle, PlanarTriangleId old, PlanarTriangleId now);
  PlanarTriangleId addTriangle();

  PlanarMesh* mesh_;
  std::vector<Neighbours> neighbours_;
  std::vector<PlanarTriangleId> triangleOf_;
};

}  // namespace tetrafront
