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

Extent extentOf(const std::vector<double>& values, double further) {
  Extent extent{further, further};
  for (const double value : values) {
    extent.low = std::min(extent.low, value);
    extent.high = std::max(extent.high, value);
  }
  return extent;
}

}  // namespace

void Neighbourhood::begin(const Front& front, const NodeTriple& base) {
  ++stamp_;
  if (marks_.size() < front.nodes().size()) marks_.resize(front.nodes().size() * 3 / 2 + 64);
  faceIds_.clear();
  faces_.clear();
  nodeIds_.clear();
  x_.clear();
  y_.clear();
  z_.clear();
  for (const NodeId node : base) localNode(front, node);
}

LocalNode Neighbourhood::localNode(const Front& front, NodeId node) {
  Mark& mark = marks_[node.index()];
  if (mark.stamp == stamp_) return mark.local;
  mark = {stamp_, static_cast<LocalNode>(nodeIds_.size())};
  const Vec3& place = front.node(node);
  nodeIds_.push_back(node);
  x_.push_back(place.x);
  y_.push_back(place.y);
  z_.push_back(place.z);
  return mark.local;
}

void Neighbourhood::addFace(const Front& front, FaceId face) {
  const NodeTriple& nodes = front.face(face).nodes;
  faceIds_.push_back(face);
  const LocalNode a = localNode(front, nodes[0]);
  const LocalNode b = localNode(front, nodes[1]);
  const LocalNode c = localNode(front, nodes[2]);
  faces_.push_back({a, b, c});
}

void Neighbourhood::finish(const Vec3& reach) {
  const Extent ex = extentOf(x_, reach.x);
  const Extent ey = extentOf(y_, reach.y);
  const Extent ez = extentOf(z_, reach.z);
  determinantError_ =
      kErrorPerVolume * (ex.high - ex.low) * (ey.high - ey.low) * (ez.high - ez.low);
  nodeIds_.emplace_back();
  x_.push_back(reach.x);
  y_.push_back(reach.y);
  z_.push_back(reach.z);
}

void Neighbourhood::gather(const Front& front, const NodeTriple& base, const Box& box,
                           const Vec3& reach) {
  begin(front, base);
  const std::size_t count = front.facesNear(box, found_);
  for (std::size_t i = 0; i < count; ++i) addFace(front, FaceId(found_[i]));
  finish(reach);
}

void Neighbourhood::take(const Front& front, const NodeTriple& base,
                         std::span<const FaceId> faces) {
  begin(front, base);
  for (const FaceId face : faces) addFace(front, face);
  finish(front.node(base[0]));
}

LocalNode Neighbourhood::setNewNode(const Vec3& place) {
  const std::size_t local = nodeCount();
  x_[local] = place.x;
  y_[local] = place.y;
  z_[local] = place.z;
  return static_cast<LocalNode>(local);
}

}  // namespace tetrafront
