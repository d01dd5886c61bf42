#pragma once

/// @file The tetrahedra of a body-centred cubic lattice, without a list of them. Each has two centres, next to each other along an
/// axis, and two of the four corners around the line between them, which are next to each other too. It belongs to the centre that
/// comes first, so that each centre has twelve, and a set of tetrahedra is a number of twelve bits per centre.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/ids.h"
#include "lattice/lattice_nodes.h"

namespace tetrafront {

inline constexpr std::size_t kElementsPerCentre = 12;
/// Which of the tetrahedra of a centre are in a set: bit 4 · axis + k, where k counts the pairs of corners.
using ElementBits = std::uint16_t;
inline constexpr ElementBits kAllElements = (1U << kElementsPerCentre) - 1U;

/// Where a node lies, in half lattice constants from a centre.
using LatticeOffset = std::array<std::int8_t, 3>;

/// The nodes of the tetrahedra of a centre, positively oriented: the centre, the next one, and the corners.
inline constexpr std::array<std::array<LatticeOffset, 4>, kElementsPerCentre> kElementNodes = [] {
  constexpr std::array<std::array<LatticeOffset, 4>, 3> kAround{
      {{{{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}}},
       {{{-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}}},
       {{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}}}};
  std::array<std::array<LatticeOffset, 4>, kElementsPerCentre> nodes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < 4; ++k) {
      auto& own = nodes[4 * axis + k];
      own[1][axis] = 2;
      own[2] = kAround[axis][k];
      own[3] = kAround[axis][(k + 1) % 4];
    }
  }
  return nodes;
}();

/// Returns the place of a node by its offset. Below the lowest corner of the lattice, it is one that no node has: numbers wrap.
[[nodiscard]] constexpr LatticePlace placeAt(const LatticePlace& centre,
                                             const LatticeOffset& offset) {
  const auto moved = [](std::uint32_t from, std::int8_t by) {
    return from + static_cast<std::uint32_t>(static_cast<std::int32_t>(by));
  };
  return {moved(centre.x, offset[0]), moved(centre.y, offset[1]), moved(centre.z, offset[2])};
}

/// The nodes around a centre that its tetrahedra have: the next centre along each axis, and the corners of its cube, by below or above
/// along x, y and z. None where there is no node.
struct CentreNodes {
  NodeId centre;
  std::array<NodeId, 3> next;
  std::array<std::array<std::array<NodeId, 2>, 2>, 2> corners;

  [[nodiscard]] NodeQuad nodesOf(std::size_t element) const {
    const auto& [own, other, a, b] = kElementNodes[element];
    return {centre, next[element / 4], cornerAt(a), cornerAt(b)};
  }
  [[nodiscard]] NodeId cornerAt(const LatticeOffset& offset) const {
    const auto side = [](std::int8_t value) { return static_cast<std::size_t>((value + 1) / 2); };
    return corners[side(offset[0])][side(offset[1])][side(offset[2])];
  }
  /// Returns the tetrahedra whose nodes are all there.
  [[nodiscard]] ElementBits complete() const {
    unsigned bits = 0;
    for (std::size_t element = 0; element < kElementsPerCentre; ++element) {
      const auto [a, b, c, d] = nodesOf(element);
      if (!b.isNone() && !c.isNone() && !d.isNone()) bits |= 1U << element;
    }
    return static_cast<ElementBits>(bits);
  }
};

/// Finds the nodes around the centres of a row along x, which must ascend. `Row`: as LatticeNodes::Row.
template <class Row>
class CentreRow {
 public:
  /// `nodes`: has rowAt(y, z). `y` and `z`: of the centres.
  template <class Nodes>
  CentreRow(const Nodes& nodes, std::uint32_t y, std::uint32_t z)
      : own_(nodes.rowAt(y, z)),
        alongY_(nodes.rowAt(y + 2, z)),
        alongZ_(nodes.rowAt(y, z + 2)),
        corners_{{{nodes.rowAt(y - 1, z - 1), nodes.rowAt(y - 1, z + 1)},
                  {nodes.rowAt(y + 1, z - 1), nodes.rowAt(y + 1, z + 1)}}} {}

  /// Leaves out the centres before x.
  void skipTo(std::uint32_t x) {
    for (Row* row : {&own_, &alongY_, &alongZ_}) row->skipTo(x);
    for (auto& rows : corners_) {
      for (Row& row : rows) row.skipTo(x - 1);
    }
  }

  [[nodiscard]] CentreNodes at(NodeId centre, std::uint32_t x) {
    CentreNodes around{centre, {own_.at(x + 2), alongY_.at(x), alongZ_.at(x)}, {}};
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        around.corners[0][i][j] = corners_[i][j].at(x - 1);
        around.corners[1][i][j] = corners_[i][j].at(x + 1);
      }
    }
    return around;
  }

 private:
  Row own_;
  Row alongY_;
  Row alongZ_;
  std::array<std::array<Row, 2>, 2> corners_;
};

/// Calls visit(CentreNodes) for the centres among the nodes [first, last), in their order.
template <class Visit>
void forEachCentre(const LatticeNodes& nodes, std::size_t first, std::size_t last, Visit visit) {
  while (first < last) {
    const auto [x0, y, z] = nodes.placeOf(NodeId(first));
    const std::size_t end = std::min(last, nodes.firstFrom({0, y + 1, z}));
    if (y % 2 != 0) {
      CentreRow<LatticeNodes::Row> row(nodes, y, z);
      for (; first < end; ++first) {
        visit(row.at(NodeId(first), nodes.placeOf(NodeId(first)).x));
      }
    }
    first = end;
  }
}

}  // namespace tetrafront
