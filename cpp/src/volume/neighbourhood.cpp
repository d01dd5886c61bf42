#include "volume/neighbourhood.h"

#include <algorithm>

namespace tetrafront {
namespace {

// Shewchuk's bound for orient3d is (7 + 56u)u times a permanent of six terms, each at most the
// product of the three extents: 4.7e-15. The rest covers the rounding of the extents.
constexpr double kErrorPerVolume = 8e-15;

struct Extent {
  double low;
  double high;
};

Extent extentOf(std::span<const double> values, double further) {
  Extent extent{further, further};
  for (const double value : values) {
    extent.low = std::min(extent.low, value);
    extent.high = std::max(extent.high, value);
  }
  return extent;
}

}  // namespace

/// Assigns local indices to nodes. The compiler keeps its node count in a register; a member of
/// Neighbourhood would be reloaded.
class Neighbourhood::LocalNumbering {
 public:
  LocalNumbering(Neighbourhood& around, const Front& front)
      : around_(around),
        positions_(front.nodes().data()),
        entries_(around.entries_.data()),
        nodeIds_(around.nodeIds_.data()),
        x_(around.x_.data()),
        y_(around.y_.data()),
        z_(around.z_.data()),
        stamp_(around.stamp_) {}

  LocalNode localNode(NodeId node) {
    LocalEntry& entry = entries_[node.index()];
    if (entry.stamp == stamp_) return entry.local;
    const LocalNode local = nodes_++;
    entry = {stamp_, local};
    const Vec3& position = positions_[node.index()];
    nodeIds_[local] = node;
    x_[local] = position.x;
    y_[local] = position.y;
    z_[local] = position.z;
    return local;
  }

  /// Replaces the node ids of gathered face `face` by local indices.
  void number(std::uint32_t face) {
    LocalTriple& nodes = around_.faces_[face];
    const LocalNode a = localNode(NodeId(nodes[0]));
    const LocalNode b = localNode(NodeId(nodes[1]));
    const LocalNode c = localNode(NodeId(nodes[2]));
    nodes = {a, b, c};
    const int onBase = (a < 3 ? 1 : 0) + (b < 3 ? 1 : 0) + (c < 3 ? 1 : 0);
    if (onBase == 2) addAdjacent(face, nodes);
  }

  [[nodiscard]] std::size_t nodeCount() const { return nodes_; }

 private:
  void addAdjacent(std::uint32_t face, const LocalTriple& nodes) {
    const std::size_t apex = nodes[0] >= 3 ? 0 : (nodes[1] >= 3 ? 1 : 2);
    around_.adjacent_.push_back({face, nodes[apex], nodes[(apex + 1) % 3], nodes[(apex + 2) % 3]});
  }

  Neighbourhood& around_;
  const Vec3* positions_;
  LocalEntry* entries_;
  NodeId* nodeIds_;
  double* x_;
  double* y_;
  double* z_;
  std::uint32_t stamp_;
  LocalNode nodes_ = 0;
};

void Neighbourhood::reserve(std::size_t nodesOfFront, std::size_t faces) {
  if (entries_.size() < nodesOfFront) entries_.resize(nodesOfFront * 3 / 2 + 64);
  if (faceIds_.size() >= faces) return;
  const std::size_t capacity = 2 * faces + 64;
  faceIds_.resize(capacity);
  faces_.resize(capacity);
  const std::size_t nodeCapacity = 3 * capacity + 4;  // the base's and a new node's too
  nodeIds_.resize(nodeCapacity);
  x_.resize(nodeCapacity);
  y_.resize(nodeCapacity);
  z_.resize(nodeCapacity);
}

void Neighbourhood::boundErrors(const Vec3& reach) {
  const auto inUse = [&](const std::vector<double>& values) {
    return std::span(values).first(nodeCount_);
  };
  const Extent ex = extentOf(inUse(x_), reach.x);
  const Extent ey = extentOf(inUse(y_), reach.y);
  const Extent ez = extentOf(inUse(z_), reach.z);
  determinantError_ =
      kErrorPerVolume * (ex.high - ex.low) * (ey.high - ey.low) * (ez.high - ez.low);
}

/// Keeps those of the faces found that may overlap the region, in their order; returns their
/// number.
std::size_t Neighbourhood::dropFarFaces(const Front& front, const SearchRegion& region,
                                        std::size_t count) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const NodeTriple& nodes = front.face(FaceId(found_[i])).nodes;
    found_[kept] = found_[i];
    kept += region.mayIntersect(front.node(nodes[0]), front.node(nodes[1]), front.node(nodes[2]))
                ? 1
                : 0;
  }
  return kept;
}

void Neighbourhood::gather(const Front& front, const NodeTriple& base, const SearchRegion& region,
                           const Vec3& reach) {
  std::size_t count = front.facesNear(region.box(), found_);
  if (region.isStretched()) count = dropFarFaces(front, region, count);
  reserve(front.nodes().size(), count);
  adjacent_.clear();
  ++stamp_;
  // A separate loop, so that these loads do not wait for each other.
  for (std::size_t i = 0; i < count; ++i) {
    const FaceId face(found_[i]);
    const NodeTriple& nodes = front.face(face).nodes;
    faceIds_[i] = face;
    faces_[i] = {nodes[0].value, nodes[1].value, nodes[2].value};
  }
  LocalNumbering numbering(*this, front);
  for (const NodeId node : base) numbering.localNode(node);
  for (std::uint32_t i = 0; i < count; ++i) numbering.number(i);
  faceCount_ = count;
  nodeCount_ = numbering.nodeCount();
  boundErrors(reach);
}

void Neighbourhood::mapTo(const UnitSpace& space) {
  unit_ = {x_.data(), y_.data(), z_.data()};
  if (!space.isStretched()) return;
  for (std::vector<double>& axis : mapped_) axis.resize(std::max(axis.size(), nodeCount_));
  for (LocalNode i = 0; i < nodeCount_; ++i) {
    const Vec3 unit = space.toUnit(position(i));
    mapped_[0][i] = unit.x;
    mapped_[1][i] = unit.y;
    mapped_[2][i] = unit.z;
  }
  unit_ = {mapped_[0].data(), mapped_[1].data(), mapped_[2].data()};
}

LocalNode Neighbourhood::setNewNode(const Vec3& position) {
  const std::size_t local = nodeCount();
  x_[local] = position.x;
  y_[local] = position.y;
  z_[local] = position.z;
  return static_cast<LocalNode>(local);
}

}  // namespace tetrafront
