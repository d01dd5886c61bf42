#pragma once

/// @file A mesh in tiles: parts of a bounded number of elements, of which each is optimized alone. Where a mesh is cut depends on
/// nothing but the mesh, so the result is the same however many tiles are worked on at once.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "topology/tet_mesh.h"

namespace tetrafront {

/// A part of a mesh. Nodes that it shares with elements outside are fixed.
struct Tile {
  TetMesh mesh;
  /// Per fixed node of the mesh, in their order: its node in TiledMesh::rest.
  std::vector<NodeId> nodeOf;
};

/// A mesh taken apart. Every node belongs to one tile, if all its elements do and it is not fixed, else to the rest.
class TiledMesh {
 public:
  /// Cuts the whole mesh.
  static Task<TiledMesh> cut(Work& work, const TetMesh& mesh);
  /// Joins tiles and cuts what is near their seams, at other places than before; the other elements are the rest.
  static Task<TiledMesh> cutSeams(Work& work, const TiledMesh& tiled);

  [[nodiscard]] std::vector<Tile>& tiles() { return tiles_; }
  [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }
  /// Returns the mesh of all tiles as they are now: the nodes of the rest come first, in the order of the given mesh. O(n).
  [[nodiscard]] TetMesh joined() const;
  [[nodiscard]] std::size_t nodeCount() const;
  [[nodiscard]] std::size_t tetrahedronCount() const;

 private:
  static Task<TiledMesh> make(Work& work, const TetMesh& mesh, std::vector<std::uint32_t> tileOf);
  [[nodiscard]] std::vector<std::uint8_t> seamsOfJoined() const;

  TetMesh rest_;
  std::vector<Tile> tiles_;
};

}  // namespace tetrafront
