#include "optimize/narrow_gaps.h"

#include <algorithm>

#include "optimize/edge_removal.h"
#include "quality/boundary_limits.h"

namespace tetrafront {

template <class Space>
bool isInNarrowGap(const TetComplex& complex, TetId tet) {
  const Corners& nodes = complex.element(tet).nodes;
  if (!std::ranges::all_of(nodes, [&](NodeId node) { return complex.isFixed(node); })) return false;
  const auto target =
      Space::meanOf(complex.target<Space>(nodes[0]), complex.target<Space>(nodes[1]),
                    complex.target<Space>(nodes[2]), complex.target<Space>(nodes[3]));
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] =
        Space::inTargetLengths(target, complex.position(nodes[k]) - complex.position(nodes[0]));
  }
  std::array<bool, 6> onBoundary{};
  for (std::size_t e = 0; e < onBoundary.size(); ++e)
    onBoundary[e] = isBoundaryEdge(complex, tet, e);
  return spansNarrowGap(corners, onBoundary);
}

template bool isInNarrowGap<PlainSpace>(const TetComplex&, TetId);
template bool isInNarrowGap<StretchedSpace>(const TetComplex&, TetId);

}  // namespace tetrafront
