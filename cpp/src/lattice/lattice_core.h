#pragma once

/// @file Tetrahedra of lattices that nothing changes any more: made row by row when they are asked for. A node takes ten bytes, and a
/// tetrahedron none.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lattice/lattice_elements.h"
#include "lattice/lattice_nodes.h"
#include "topology/element_source.h"

namespace tetrafront {

/// Nodes of a lattice in two sets, each with ids of its own: those that the tetrahedra share with others, and their own ones.
class CoreNodes {
 public:
  class Row;

  LatticeNodes shared;
  LatticeNodes own;
  /// Ids of the first shared node, and of the first own one.
  std::uint32_t firstShared = 0;
  std::uint32_t firstOwn = 0;

  /// Where a row begins in each set.
  struct RowStart {
    std::uint32_t shared = 0;
    std::uint32_t own = 0;
  };
  [[nodiscard]] RowStart startOf(std::uint32_t y, std::uint32_t z) const;
};

/// The tetrahedra of one lattice.
class LatticeCore {
 public:
  /// The bits are those of the nodes of each set. Nodes must be in the order of space.
  LatticeCore(const Lattice& lattice, CoreNodes nodes, std::vector<ElementBits> ofShared,
              std::vector<ElementBits> ofOwn);

  [[nodiscard]] const CoreNodes& nodes() const { return nodes_; }
  [[nodiscard]] std::uint32_t elementCount() const { return elementCount_; }
  /// Returns the position of an own node, counted from 0.
  [[nodiscard]] Vec3 positionOf(std::uint32_t node) const {
    return lattice_.positionOf(nodes_.own.placeOf(NodeId(node)));
  }
  void copyElements(std::uint32_t first, std::span<ElementSource::Element> to) const;

 private:
  /// Centres of one row along x.
  struct Row {
    std::uint32_t y;
    std::uint32_t z;
    std::uint32_t firstElement;
    /// Nodes of each set.
    std::uint32_t shared;
    std::uint32_t own;
    std::uint32_t sharedEnd;
    std::uint32_t ownEnd;
    /// Those of the rows that its tetrahedra have nodes in, by indexOf(): to look for them takes longer than to make a row.
    std::array<CoreNodes::RowStart, 7> starts;
  };
  class RowsAround;
  struct Centre {
    NodeId node;
    LatticePlace place;
    ElementBits bits;
  };

  void listRows();
  template <class Visit>
  void forEachCentre(const Row& row, Visit visit) const;
  [[nodiscard]] ElementSource::Element elementOf(const CentreNodes& around,
                                                 const LatticePlace& place,
                                                 std::size_t number) const;

  Lattice lattice_;
  CoreNodes nodes_;
  std::vector<ElementBits> ofShared_;
  std::vector<ElementBits> ofOwn_;
  std::vector<Row> rows_;
  std::uint32_t elementCount_ = 0;
};

/// The cores of all lattices of a region, one after the other.
class LatticeCores final : public ElementSource {
 public:
  /// `shared`: number of nodes that other elements have too.
  LatticeCores(std::vector<LatticeCore> cores, std::uint32_t shared);

  [[nodiscard]] std::uint32_t nodeCount() const override { return nodeCount_; }
  [[nodiscard]] std::uint32_t sharedCount() const override { return shared_; }
  [[nodiscard]] std::uint32_t elementCount() const override { return elementCount_; }
  [[nodiscard]] Vec3 positionOf(std::uint32_t node) const override;
  void copyElements(std::uint32_t first, std::span<Element> to) const override;

 private:
  std::vector<LatticeCore> cores_;
  std::uint32_t shared_;
  std::uint32_t nodeCount_ = 0;
  std::uint32_t elementCount_ = 0;
};

}  // namespace tetrafront
