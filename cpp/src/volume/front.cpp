#include "volume/front.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/scrambled.h"

namespace tetrafront {
namespace {

// Size of a grid cell: slightly above the typical face, so that most faces share a level.
constexpr double kCellPerSize = 1.3;

// Layout of a key, most significant part first: rule class 4 bits, size bucket 8, layer 12, tile
// 12, fine size 8, sequence 20. In the paper's order, 31 bits of the size replace the parts between
// class and sequence. Orders that ignore the size have one part below the class.
constexpr int kClassShift = 60;
constexpr int kBucketShift = 52;
constexpr int kLayerShift = 40;
constexpr int kTileShift = 28;
constexpr int kFineShift = 20;
constexpr std::uint64_t kSequenceMask = (std::uint64_t{1} << kFineShift) - 1;
constexpr std::uint64_t kBelowClassMask = (std::uint64_t{1} << kClassShift) - 1;
constexpr std::uint32_t kMaxLayer = (1U << (kBucketShift - kLayerShift)) - 1;

// Buckets span a factor of 4 (two octaves). One of them is centred on the typical size.
constexpr std::uint32_t kBucketOctaves = 127;
constexpr int kTypicalBucket = 63;

// Edge of a tile, in typical sizes of the bucket. A tile holds a few hundred faces of one layer;
// they and their neighbourhoods fit into the L2 cache.
constexpr double kSizesPerTile = 8.0;

// The bits of a float, read as an integer, grow with its logarithm: 2^23 per octave, linearly in
// between. They order sizes without computing a logarithm, whose last bit differs between C
// libraries.
constexpr int kMantissaBits = 23;
constexpr std::uint32_t kBitsOfOne = 127U << kMantissaBits;
constexpr int kBucketBits = kMantissaBits + 1;

/// Returns about 2^23 log2(ratio), linear within octaves, plus 2^23 `offsetOctaves`; at least 0.
std::uint32_t logBits(float ratio, std::uint32_t offsetOctaves) {
  const auto bits = std::bit_cast<std::uint32_t>(ratio) + (offsetOctaves << kMantissaBits);
  return bits < kBitsOfOne ? 0 : bits - kBitsOfOne;
}

/// Returns 4^exponent exactly, for exponents from -511 to 511.
double powerOfFour(int exponent) {
  constexpr int kBias = 1023;
  constexpr int kDoubleMantissaBits = 52;
  return std::bit_cast<double>(static_cast<std::uint64_t>(kBias + 2 * exponent)
                               << kDoubleMantissaBits);
}

/// Spreads the last four bits of `x`, with two free bits after each.
std::uint64_t spreadFourBits(std::uint32_t x) {
  return (x & 1U) | (x & 2U) << 2U | (x & 4U) << 4U | (x & 8U) << 6U;
}

}  // namespace

Front::Front(double typicalSize, const Vec3& origin, FrontOrder order)
    : order_(order),
      typicalSize_(typicalSize),
      origin_(origin),
      grid_(kCellPerSize * typicalSize, origin) {}

NodeId Front::addNode(const Vec3& position, std::uint16_t layer, FieldHint hint) {
  nodes_.push_back(position);
  for (int axis = 0; axis < 3; ++axis)
    maxOffset_ = std::max(maxOffset_, std::fabs(position[axis] - origin_[axis]));
  layers_.push_back(layer);
  hints_.push_back(hint);
  return NodeId(nodes_.size() - 1);
}

void Front::dropNodesFrom(std::size_t count) {
  nodes_.resize(count);
  layers_.resize(count);
  hints_.resize(count);
}

Box Front::boxOf(FaceId face) const {
  const NodeTriple& n = faces_[face.index()].nodes;
  return Box::of(node(n[0]), node(n[1]), node(n[2]));
}

FaceId Front::addFace(const NodeTriple& nodes, std::uint32_t region, FieldHint hint, bool queued) {
  hint.region = region;
  FaceId id;
  if (freeSlots_.empty()) {
    id = FaceId(faces_.size());
    faces_.emplace_back();
    heap_.reserveIds(faces_.size());
  } else {
    id = freeSlots_.back();
    freeSlots_.pop_back();
  }
  const Vec3& a = node(nodes[0]);
  const Vec3& b = node(nodes[1]);
  const Vec3& c = node(nodes[2]);
  const double squares = glm::dot(a - b, a - b) + glm::dot(b - c, b - c) + glm::dot(c - a, c - a);
  faces_[id.index()] = {nodes, static_cast<float>(std::sqrt(squares / 3.0)), region, hint, 0, true};
  grid_.insert(id.value, Box::of(a, b, c));
  ++activeCount_;
  if (queued) heap_.push(id.value, keyOf(faces_[id.index()]));
  return id;
}

void Front::removeFace(FaceId face) {
  heap_.remove(face.value);
  grid_.remove(face.value);
  faces_[face.index()].active = false;
  freeSlots_.push_back(face);
  --activeCount_;
}

void Front::requeue(FaceId face, std::uint8_t ruleClass) {
  faces_[face.index()].ruleClass = ruleClass;
  heap_.push(face.value, keyOf(faces_[face.index()]));
}

std::vector<FaceId> Front::activeFaces() const {
  std::vector<FaceId> active;
  active.reserve(activeCount_);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (faces_[i].active) active.emplace_back(i);
  }
  return active;
}

std::uint64_t Front::keyOf(const FrontFace& face) {
  const std::uint64_t ruleClass = static_cast<std::uint64_t>(face.ruleClass) << kClassShift;
  const std::uint64_t number = sequence_++;
  if (order_ == FrontOrder::kFirstIn) return ruleClass | (number & kBelowClassMask);
  if (order_ == FrontOrder::kRandom) return ruleClass | (scrambled(number) & kBelowClassMask);
  const std::uint64_t sequence = number & kSequenceMask;
  if (order_ == FrontOrder::kSmallestFirst) {
    // The bits of the float above the sequence number: 31, because sizes are positive.
    const std::uint64_t size = std::bit_cast<std::uint32_t>(face.size);
    return ruleClass | size << kFineShift | sequence;
  }
  const std::uint64_t fine = (sizeInBuckets(face.size) & ((1U << kBucketBits) - 1)) >>
                             (kBucketBits - (kTileShift - kFineShift));
  const FrontRank rank = rankOf(face);
  const std::uint64_t cappedLayers = std::min(rank.layers, kMaxLayer);
  return ruleClass | std::uint64_t{rank.bucket} << kBucketShift | cappedLayers << kLayerShift |
         tileOf(face, static_cast<int>(rank.bucket)) << kTileShift | fine << kFineShift | sequence;
}

std::uint32_t Front::sizeInBuckets(float size) const {
  return logBits(static_cast<float>(static_cast<double>(size) / typicalSize_), kBucketOctaves);
}

FrontRank Front::rankOf(const FrontFace& face) const {
  FrontRank rank{sizeInBuckets(face.size) >> kBucketBits, 0};
  for (const NodeId node : face.nodes) rank.layers += layer(node);
  return rank;
}

/// Tiles follow a Morton curve that repeats every 16 tiles.
std::uint64_t Front::tileOf(const FrontFace& face, int bucket) const {
  const double tilesPerLength =
      powerOfFour(kTypicalBucket - bucket) / (kSizesPerTile * typicalSize_);
  const Vec3& position = node(face.nodes[0]);
  std::uint64_t tile = 0;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double kLast = 4294967295.0;
    const double along = std::clamp((position[axis] - origin_[axis]) * tilesPerLength, 0.0, kLast);
    tile |= spreadFourBits(static_cast<std::uint32_t>(along)) << axis;
  }
  return tile;
}

}  // namespace tetrafront
