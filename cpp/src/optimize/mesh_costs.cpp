#include "optimize/mesh_costs.h"

#include <algorithm>

#include "optimize/density.h"

namespace tetrafront {

double meanCostOf(const TetComplex& complex) {
  double sum = 0.0;
  for (std::size_t t = 0; t < complex.slotCount(); ++t) {
    if (complex.isLive(TetId(t))) sum += complex.cost(TetId(t));
  }
  return sum / static_cast<double>(complex.elementCount());
}

template <class Space>
double meanEdgeOf(const TetComplex& complex) {
  constexpr std::size_t kOneIn = 16;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t t = 0; t < complex.slotCount(); t += kOneIn) {
    if (!complex.isLive(TetId(t))) continue;
    const Corners& nodes = complex.element(TetId(t)).nodes;
    for (const TetEdge& ends : kTetEdges) {
      sum += relativeLength<Space>(complex, nodes[ends.from], nodes[ends.to]);
      count += 1.0;
    }
  }
  return sum / std::max(count, 1.0);
}

template double meanEdgeOf<PlainSpace>(const TetComplex&);
template double meanEdgeOf<StretchedSpace>(const TetComplex&);

std::size_t changedSince(const TetComplex& complex, std::uint32_t pass) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < complex.slotCount(); ++t) {
    if (complex.isLive(TetId(t)) && complex.changedIn(TetId(t)) >= pass) ++count;
  }
  return count;
}

}  // namespace tetrafront
