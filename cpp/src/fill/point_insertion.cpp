#include "fill/point_insertion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "base/sort.h"
#include "search/morton.h"

namespace tetrafront {
namespace {

/// Distance of the large tetrahedron's corners from the centre, in half extents per axis. Its faces
/// are then 4.6 half extents away, and the corners of the box at most 1.8.
constexpr double kEnclosure = 8.0;

/// Round of a point. Rounds are processed from high to low: 0 has half of all points, 1 a quarter,
/// and so on.
unsigned roundOf(std::uint32_t point) {
  std::uint32_t hash = (point + 1) * 0x9e3779b1U;
  hash = (hash ^ (hash >> 15U)) * 0x85ebca6bU;
  hash ^= hash >> 13U;
  return static_cast<unsigned>(std::countr_one(hash));
}

}  // namespace

PointInsertion::PointInsertion(FillMesh& mesh, unsigned variant) : mesh_(mesh), cone_(mesh, none_) {
  ExactPoints& points = mesh.points;
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < points.size(); ++i) positions.push_back(points.position(NodeId(i)));
  order_ = mortonOrder(positions);
  if (variant % 2 == 1) std::reverse(order_.begin(), order_.end());
  const auto first = static_cast<std::ptrdiff_t>(variant / 2 * order_.size() / 3);
  std::rotate(order_.begin(), order_.begin() + first, order_.end());
  stableSort(order_, [](std::uint32_t a, std::uint32_t b) { return roundOf(a) > roundOf(b); });
  Vec3 low = positions.front();
  Vec3 high = low;
  for (const Vec3& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const Vec3 middle = low + (high - low) * 0.5;
  const Vec3 half = (high - low) * 0.5;
  const double reach = kEnclosure * std::max({half.x, half.y, half.z});
  last_ = points.add(middle + Vec3(reach, reach, reach));
  const NodeId b = points.add(middle + Vec3(-reach, -reach, reach));
  const NodeId c = points.add(middle + Vec3(-reach, reach, -reach));
  const NodeId d = points.add(middle + Vec3(reach, -reach, -reach));
  if (points.orient(last_, b, c, d) > 0) {
    mesh.begin({last_, b, c, d});
  } else {
    mesh.begin({last_, c, b, d});
  }
}

std::uint32_t PointInsertion::faceTowards(TetId tet, NodeId node, std::size_t first) const {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto k = static_cast<std::uint32_t>((first + i) % 4);
    const NodeTriple f = mesh_.innerFace(tet, k);
    if (mesh_.points.orient(f[0], f[1], f[2], node) < 0) return k;
  }
  return 4;
}

/// Returns a tetrahedron that contains the point, or none. Walks towards the point. A walk may go
/// in circles; then all tetrahedra are searched.
TetId PointInsertion::locate(NodeId node) const {
  TetId tet = mesh_.at(last_);
  const std::size_t longest = mesh_.slotCount() + 100;
  for (std::size_t step = 0; step < longest; ++step) {
    const std::uint32_t face = faceTowards(tet, node, step);
    if (face == 4) return tet;
    const TetFace beyond = mesh_.tet(tet).across[face];
    if (beyond.isNone()) return {};
    tet = beyond.tet;
  }
  for (std::size_t i = 0; i < mesh_.slotCount(); ++i) {
    if (mesh_.isLive(TetId(i)) && faceTowards(TetId(i), node, 0) == 4) return TetId(i);
  }
  return {};
}

bool PointInsertion::insert(std::size_t index) {
  const NodeId node(order_[index]);
  const TetId tet = locate(node);
  if (tet.isNone()) return false;
  ConeRules rules;
  rules.maxCavity = std::numeric_limits<std::size_t>::max();
  rules.delaunay = true;
  bool done = cone_.make(node, std::span(&tet, 1), rules);
  if (!done) {
    rules.delaunay = false;
    done = cone_.make(node, std::span(&tet, 1), rules);
  }
  if (done) last_ = node;
  return done;
}

}  // namespace tetrafront
