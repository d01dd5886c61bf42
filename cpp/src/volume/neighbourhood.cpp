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

void Neighbourhood::begin(const Front& front, const NodeTriple& base, std::size_t faces) {
  ++stamp_;
  if (marks_.size() < front.nodes().size()) marks_.resize(front.nodes().size() * 3 / 2 + 64);
  if (faceIds_.size() < faces) {
    const std::size_t capacity = 2 * faces + 64;
    faceIds_.resize(capacity);
    faces_.resize(capacity);
    const std::size_t nodeCapacity = 3 * capacity + base.size() + 1;  // one more for a new node
    nodeIds_.resize(nodeCapacity);
    x_.resize(nodeCapacity);
    y_.resize(nodeCapacity);
    z_.resize(nodeCapacity);
  }
  faceCount_ = 0;
  nodeCount_ = 0;
  for (const NodeId node : base) localNode(front, node);
}

LocalNode Neighbourhood::localNode(const Front& front, NodeId node) {
  Mark& mark = marks_[node.index()];
  if (mark.stamp == stamp_) return mark.local;
  const std::size_t local = nodeCount_++;
  mark = {stamp_, static_cast<LocalNode>(local)};
  const Vec3& place = front.node(node);
  nodeIds_[local] = node;
  x_[local] = place.x;
  y_[local] = place.y;
  z_[local] = place.z;
  return mark.local;
}

void Neighbourhood::addFace(const Front& front, FaceId face) {
  const NodeTriple& nodes = front.face(face).nodes;
  const LocalNode a = localNode(front, nodes[0]);
  const LocalNode b = localNode(front, nodes[1]);
  const LocalNode c = localNode(front, nodes[2]);
  faceIds_[faceCount_] = face;
  faces_[faceCount_] = {a, b, c};
  ++faceCount_;
}

void Neighbourhood::finish(const Vec3& reach) {
  const auto inUse = [&](const std::vector<double>& values) {
    return std::span(values).first(nodeCount_);
  };
  const Extent ex = extentOf(inUse(x_), reach.x);
  const Extent ey = extentOf(inUse(y_), reach.y);
  const Extent ez = extentOf(inUse(z_), reach.z);
  determinantError_ =
      kErrorPerVolume * (ex.high - ex.low) * (ey.high - ey.low) * (ez.high - ez.low);
}

void Neighbourhood::gather(const Front& front, const NodeTriple& base, const Box& box,
                           const Vec3& reach) {
  const std::size_t count = front.facesNear(box, found_);
  begin(front, base, count);
  for (std::size_t i = 0; i < count; ++i) addFace(front, FaceId(found_[i]));
  finish(reach);
}

void Neighbourhood::mapTo(const UnitSpace& space) {
  unit_ = {x_.data(), y_.data(), z_.data()};
  if (!space.isStretched()) return;
  for (std::vector<double>& axis : mapped_) axis.resize(std::max(axis.size(), nodeCount_));
  for (LocalNode i = 0; i < nodeCount_; ++i) {
    const Vec3 unit = space.toUnit(place(i));
    mapped_[0][i] = unit.x;
    mapped_[1][i] = unit.y;
    mapped_[2][i] = unit.z;
  }
  unit_ = {mapped_[0].data(), mapped_[1].data(), mapped_[2].data()};
}

LocalNode Neighbourhood::setNewNode(const Vec3& place) {
  const std::size_t local = nodeCount();
  x_[local] = place.x;
  y_[local] = place.y;
  z_[local] = place.z;
  return static_cast<LocalNode>(local);
}

}  // namespace tetrafront
