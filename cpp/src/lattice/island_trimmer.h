#pragma once

/// @file Trims the tetrahedra of a lattice until their hull is a boundary for a front: no tetrahedron that sticks out, no edge or
/// node where the hull touches itself, and no island that is too small to be worth its hull.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "topology/tetrahedron.h"

namespace tetrafront {

class IslandTrimmer {
 public:
  /// An island with fewer tetrahedra goes: its hull would have about as many faces.
  static constexpr std::size_t kMinTetrahedra = 48;

  IslandTrimmer(std::size_t nodeCount, std::vector<NodeQuad> tetrahedra);

  /// O(n), and O(h log h) for a hull of h faces each time that the hull has changed.
  Task<> run(Work& work);

  /// Returns the faces of the hull, which face into the islands. O(n).
  [[nodiscard]] std::vector<NodeTriple> hull() const;
  /// Returns the tetrahedra that remain, in their order; once, as the last call.
  [[nodiscard]] std::vector<NodeQuad> take();

 private:
  Task<> findNeighbours(Work& work);
  void remove(TetId tet);
  void removeSpikes();
  bool removeContacts();
  Task<> removeSmallIslands(Work& work);
  [[nodiscard]] bool isLive(TetId tet) const { return isRemoved_[tet.index()] == 0; }
  [[nodiscard]] NodeTriple nodesOf(ElementFace face) const;
  [[nodiscard]] std::vector<ElementFace> hullFaces() const;

  std::size_t nodeCount_;
  std::vector<NodeQuad> tetrahedra_;
  std::vector<ElementFace> neighbours_;  ///< four per tetrahedron, none on the hull
  std::vector<std::uint8_t> exposed_;    ///< number of faces on the hull, per tetrahedron
  std::vector<std::uint8_t> isRemoved_;
  std::vector<TetId> spikes_;  ///< tetrahedra that may have two or more faces on the hull
};

}  // namespace tetrafront
