#pragma once

/// @file Trims the tetrahedra of a lattice until their hull is a boundary for a front: no tetrahedron that sticks out, no edge or
/// node where the hull touches itself, and no island that is too small to be worth its hull.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "lattice/lattice_elements.h"
#include "lattice/lattice_nodes.h"

namespace tetrafront {

class IslandTrimmer {
 public:
  /// An island with fewer tetrahedra goes: its hull would have about as many faces.
  static constexpr std::size_t kMinTetrahedra = 48;

  /// Begins with all tetrahedra whose nodes are among `nodes`, which must outlive this.
  explicit IslandTrimmer(const LatticeNodes& nodes);

  /// O(n), and O(h log n) for a hull of h faces each time that the hull has changed.
  Task<> run(Work& work);

  /// Returns the faces of the hull, which face into the islands. O(n).
  [[nodiscard]] std::vector<NodeTriple> hull() const;
  /// Returns the tetrahedra that remain, per node; once, as the last call.
  [[nodiscard]] std::vector<ElementBits> take();

 private:
  struct Element {
    NodeId centre;
    std::uint8_t number = 0;  ///< among those of the centre
    friend bool operator==(const Element&, const Element&) = default;
  };
  /// The element behind a face: the offset of its centre, and its number there.
  struct Neighbour {
    LatticeOffset offset{};
    std::uint8_t number = 0;
  };
  using Neighbours = std::array<std::array<Neighbour, 4>, kElementsPerCentre>;
  struct HullFace {
    Element element;
    NodeTriple nodes;  ///< counter-clockwise as seen from outside the element
  };

  /// Marks centres that are not in the middle of 27 with all their tetrahedra: only their tetrahedra can be at the hull.
  static constexpr ElementBits kNearHull = 1U << 15U;

  static Neighbours findNeighbours();
  void markNearHull(std::size_t first, std::size_t last);
  void remove(const Element& element);
  void removeSpikes();
  bool removeContacts();
  Task<> removeSmallIslands(Work& work);
  [[nodiscard]] std::vector<Element> smallIslandOf(const Element& element);
  [[nodiscard]] bool isNearHull(NodeId centre) const {
    return (bits_[centre.index()] & kNearHull) != 0;
  }
  [[nodiscard]] bool isLive(const Element& element) const {
    return !element.centre.isNone() && isIn(bits_, element);
  }
  [[nodiscard]] static bool isIn(const std::vector<ElementBits>& bits, const Element& element) {
    return (bits[element.centre.index()] >> element.number & 1U) != 0;
  }
  [[nodiscard]] Element neighbourOf(const Element& element, std::size_t corner) const;
  [[nodiscard]] bool isSpike(const Element& element) const;
  [[nodiscard]] NodeId nodeAt(NodeId centre, const LatticeOffset& offset) const;
  [[nodiscard]] std::vector<HullFace> hullFaces() const;
  /// Calls visit(Element) for the tetrahedra of the marked centres among the nodes [first, last), in their order.
  template <class Visit>
  void forEachNearHull(std::size_t first, std::size_t last, Visit visit) const;

  const LatticeNodes& nodes_;
  Neighbours neighbours_ = findNeighbours();
  std::vector<ElementBits> bits_;  ///< per node, none for those that are no centres
  std::vector<ElementBits>
      isInLarge_;  ///< per node, while small islands are removed: tetrahedra known to be in a large one
  std::vector<Element> spikes_;  ///< tetrahedra that may have two or more faces on the hull
};

}  // namespace tetrafront
