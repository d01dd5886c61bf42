#include "tetrafront/covering_grid.h"

#include <algorithm>

namespace tetrafront {
namespace {

/// Margin of the grid around the box / diagonal of the box. Large enough for rounding and for the
/// bulge of curved patches; small enough that nodes stay near the geometry they describe.
constexpr double kMargin = 1.0 / 20.0;

/// A corner tetrahedron contains the box if its three axis-parallel edges are this many times as
/// long as those of the box.
constexpr double kTetrahedronPerBox = 3.0;

BackgroundNode nodeAt(const Vec3& position, double size) {
  BackgroundNode node;
  node.position = position;
  node.size = size;
  return node;
}

BackgroundGrid boxOf(const Vec3& low, const Vec3& high, double size) {
  BackgroundGrid grid;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 at((corner & 1U) != 0 ? high.x : low.x, (corner & 2U) != 0 ? high.y : low.y,
                  (corner & 4U) != 0 ? high.z : low.z);
    grid.nodes.push_back(nodeAt(at, size));
  }
  // One tetrahedron inside, over alternate corners, and one at each remaining corner.
  grid.tetrahedra = {{0, 3, 5, 6}, {1, 0, 3, 5}, {2, 0, 3, 6}, {4, 0, 5, 6}, {7, 3, 5, 6}};
  return grid;
}

BackgroundGrid tetrahedronOf(const Vec3& low, const Vec3& high, double size) {
  const Vec3 edges = kTetrahedronPerBox * (high - low);
  BackgroundGrid grid;
  grid.nodes = {nodeAt(low, size), nodeAt(low + Vec3(edges.x, 0.0, 0.0), size),
                nodeAt(low + Vec3(0.0, edges.y, 0.0), size),
                nodeAt(low + Vec3(0.0, 0.0, edges.z), size)};
  grid.tetrahedra = {{0, 1, 2, 3}};
  return grid;
}

}  // namespace

BackgroundGrid coveringGrid(const Vec3& low, const Vec3& high, double size, CoverShape shape) {
  const double diagonal = glm::length(high - low);
  const Vec3 margin(diagonal > 0.0 ? kMargin * diagonal : size);
  return shape == CoverShape::kBox ? boxOf(low - margin, high + margin, size)
                                   : tetrahedronOf(low - margin, high + margin, size);
}

}  // namespace tetrafront
