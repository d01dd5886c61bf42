#pragma once

/// @file Which triangles of a patch's triangulation are neighbours, and the changes that keep
/// it a triangulation: a side flipped, an inner node drawn into one of its neighbours, a side or a
/// triangle divided. Who calls for a change has made sure, by exact turns, that the triangles it
/// makes turn counter-clockwise.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

class PlanarLinks {
 public:
  /// `mesh` must outlive this.
  explicit PlanarLinks(PlanarMesh& mesh) : mesh_(&mesh) {}

  /// Finds all neighbours of a complete triangulation. O(triangles).
  void build();

  /// Triangles there are or were; those that collapses removed are not alive.
  [[nodiscard]] std::uint32_t triangleCount() const {
    return static_cast<std::uint32_t>(neighbours_.size());
  }
  [[nodiscard]] bool isAlive(std::uint32_t triangle) const { return node(triangle, 0) != kNoIndex; }
  [[nodiscard]] std::uint32_t node(std::uint32_t triangle, std::uint32_t corner) const {
    return mesh_->triangles[3 * std::size_t{triangle} + corner];
  }
  /// The triangle across from corner `corner`; kNoIndex at the boundary.
  [[nodiscard]] std::uint32_t neighbour(std::uint32_t triangle, std::uint32_t corner) const {
    return neighbours_[triangle][corner];
  }
  /// Which corner of the triangle the node `wanted` is.
  [[nodiscard]] std::uint32_t corner(std::uint32_t triangle, std::uint32_t wanted) const;
  /// One of the node's triangles; kNoIndex if it was drawn into another.
  [[nodiscard]] std::uint32_t triangleOf(std::uint32_t node) const { return triangleOf_[node]; }

  /// The triangles around an inner node, counter-clockwise, and the nodes around it: triangle i
  /// has ring[i] and ring[i + 1].
  struct Star {
    std::vector<std::uint32_t> ring;
    std::vector<std::uint32_t> triangles;
  };
  /// False if the node lies on the boundary or is gone; the star is then unspecified.
  [[nodiscard]] bool collectStar(std::uint32_t centre, Star& star) const;

  /// The four nodes at a side a b between t = (c a b) and its neighbour (d b a).
  struct Diamond {
    std::uint32_t other;
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t c;
    std::uint32_t d;
  };
  /// Of the side across from corner k of t, which must have a neighbour.
  [[nodiscard]] Diamond diamond(std::uint32_t t, std::uint32_t k) const;

  /// Replaces the side a b by c d; t becomes (c a d), the other (c d b).
  void flip(std::uint32_t t, std::uint32_t k);
  /// Replaces the star of `centre` by the fan from ring[into].
  void collapse(std::uint32_t centre, const Star& star, std::size_t into);
  /// Divides the side across from corner k of t by `middle`, a node without triangles.
  void split(std::uint32_t t, std::uint32_t k, std::uint32_t middle);
  /// Divides t into three by `centre`, a node without triangles.
  void insert(std::uint32_t t, std::uint32_t centre);

  /// Takes dead triangles and nodes out of the mesh; the rest keeps its order. The links are
  /// spent after that.
  void compact();

 private:
  using Neighbours = std::array<std::uint32_t, 3>;
  void put(std::uint32_t triangle, const std::array<std::uint32_t, 3>& nodes,
           const Neighbours& around);
  void replaceNeighbour(std::uint32_t triangle, std::uint32_t old, std::uint32_t now);
  std::uint32_t addTriangle();

  PlanarMesh* mesh_;
  std::vector<Neighbours> neighbours_;
  std::vector<std::uint32_t> triangleOf_;
};

}  // namespace tetrafront
