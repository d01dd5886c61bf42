#include "optimize/narrow_gaps.h"

#include <algorithm>

#include "optimize/edge_removal.h"
#include "quality/boundary_limits.h"

namespace tetrafront {

template <class Space>
bool isInNarrowGap(const TetComplex& complex, TetId tet) {
  const Corners& nodes = complex.element(tet).nodes;
  if (!std::ranges::all_of(nodes, [&](NodeId node) { return complex.isFixed(node); })) return false;
  const auto wanted =
      Space::meanOf(complex.wanted<Space>(nodes[0]), complex.wanted<Space>(nodes[1]),
                    complex.wanted<Space>(nodes[2]), complex.wanted<Space>(nodes[3]));
  std::array<Vec3, 4> seen;
  for (std::size_t k = 0; k < 4; ++k) {
    seen[k] = Space::inWanted(wanted, complex.place(nodes[k]) - complex.place(nodes[0]));
  }
  std::array<bool, 6> joined{};
  for (std::size_t e = 0; e < joined.size(); ++e) joined[e] = isBoundaryEdge(complex, tet, e);
  return joinsNearSheets(seen, joined);
}

template bool isInNarrowGap<PlainSpace>(const TetComplex&, TetId);
template bool isInNarrowGap<StretchedSpace>(const TetComplex&, TetId);

}  // namespace tetrafront
