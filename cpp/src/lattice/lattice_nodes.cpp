#include "lattice/lattice_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/sort.h"

namespace tetrafront {
namespace {

/// Nodes per unit of budget.
constexpr std::size_t kNodesPerUnit = 8;
/// Visits of nodes by the sort per unit of budget.
constexpr std::size_t kVisitsPerUnit = 64;

}  // namespace

Lattice::Lattice(double constant, const Vec3& low)
    : half_(0.5 * constant), base_(2.0 * glm::floor(low / constant)) {}

std::uint32_t Lattice::firstFrom(double coordinate, int axis) const {
  const double steps = std::ceil(coordinate / half_) - base_[axis];
  return static_cast<std::uint32_t>(std::clamp(steps, 0.0, double{kMaxSteps}));
}

bool Lattice::reaches(const Vec3& high) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] / half_ - base_[axis] >= double{kMaxSteps}) return false;
  }
  return true;
}

/// The nodes of a row along x. Queries must ascend.
class LatticeNodes::Row {
 public:
  Row(const std::vector<Key>& keys, Key first)
      : keys_(keys),
        row_(first),
        next_(static_cast<std::size_t>(std::ranges::lower_bound(keys, first) - keys.begin())) {}

  /// Returns the node at x, or none. Later queries may be for x - 2 or more.
  [[nodiscard]] NodeId at(std::uint32_t x) {
    const Key key = row_ | x;
    while (next_ < keys_.size() && keys_[next_] + 2 < key) ++next_;
    for (std::size_t i = next_; i < keys_.size() && keys_[i] <= key; ++i) {
      if (keys_[i] == key) return NodeId(i);
    }
    return {};
  }

 private:
  const std::vector<Key>& keys_;
  Key row_;
  std::size_t next_;
};

LatticeNodes::Row LatticeNodes::rowAt(std::uint32_t y, std::uint32_t z) const {
  return {keys_, keyOf({0, y, z})};
}

Task<> LatticeNodes::sort(Work& work) {
  SlicedSort<Key> sort(keys_);
  co_await work.finish(sort, kVisitsPerUnit);
}

LatticePlace LatticeNodes::placeOf(NodeId node) const {
  constexpr Key kMask = (Key{1} << kBits) - 1;
  const Key key = keys_[node.index()];
  return {static_cast<std::uint32_t>(key & kMask), static_cast<std::uint32_t>(key >> kBits & kMask),
          static_cast<std::uint32_t>(key >> 2 * kBits)};
}

Task<std::vector<NodeQuad>> LatticeNodes::tetrahedra(Work& work) const {
  std::vector<NodeQuad> tetrahedra;
  co_await work.forEachBlock(
      keys_.size(),
      [&](std::size_t first, std::size_t last) { addTetrahedra(first, last, tetrahedra); },
      kNodesPerUnit);
  co_return tetrahedra;
}

/// Adds the tetrahedra that the centres in a part of the list have with the next centre along an axis: around the line between both
/// are four corners, of which each two neighbours make one tetrahedron.
void LatticeNodes::addTetrahedra(std::size_t first, std::size_t last,
                                 std::vector<NodeQuad>& tetrahedra) const {
  while (first < last) {
    const LatticePlace start = placeOf(NodeId(first));
    const std::uint32_t y = start.y;
    const std::uint32_t z = start.z;
    const Key endOfRow = keyOf({0, y + 1, z});
    if (y % 2 == 0) {
      while (first < last && keys_[first] < endOfRow) ++first;
      continue;
    }
    Row own = rowAt(y, z);
    Row alongY = rowAt(y + 2, z);
    Row alongZ = rowAt(y, z + 2);
    std::array<std::array<Row, 2>, 2> corners{
        {{rowAt(y - 1, z - 1), rowAt(y - 1, z + 1)}, {rowAt(y + 1, z - 1), rowAt(y + 1, z + 1)}}};
    for (; first < last && keys_[first] < endOfRow; ++first) {
      const NodeId centre(first);
      const std::uint32_t x = placeOf(centre).x;
      // The eight corners of the cube: [below or above along x][y][z].
      std::array<std::array<std::array<NodeId, 2>, 2>, 2> cube;
      for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
          cube[0][i][j] = corners[i][j].at(x - 1);
          cube[1][i][j] = corners[i][j].at(x + 1);
        }
      }
      const auto add = [&](NodeId next, const std::array<NodeId, 4>& around) {
        if (next.isNone()) return;
        for (std::size_t k = 0; k < 4; ++k) {
          const NodeId a = around[k];
          const NodeId b = around[(k + 1) % 4];
          if (!a.isNone() && !b.isNone()) tetrahedra.push_back({centre, next, a, b});
        }
      };
      add(own.at(x + 2), {cube[1][0][0], cube[1][1][0], cube[1][1][1], cube[1][0][1]});
      add(alongY.at(x), {cube[0][1][0], cube[0][1][1], cube[1][1][1], cube[1][1][0]});
      add(alongZ.at(x), {cube[0][0][1], cube[1][0][1], cube[1][1][1], cube[0][1][1]});
    }
  }
}

}  // namespace tetrafront
