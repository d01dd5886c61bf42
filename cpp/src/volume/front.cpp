#include "volume/front.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tetrafront {
namespace {

// Cells somewhat wider than the typical face, so that most faces share a level.
constexpr double kCellPerSize = 1.3;

// Key layout, most significant first: rule class 4 bits, size bucket 8, layer 12, fine size 14,
// sequence 26. The paper's order leaves bucket and layer out.
constexpr int kClassShift = 60;
constexpr int kBucketShift = 52;
constexpr int kLayerShift = 40;
constexpr int kFineShift = 26;
constexpr std::uint64_t kSequenceMask = (std::uint64_t{1} << kFineShift) - 1;
constexpr std::uint32_t kMaxLayer = (1U << (kBucketShift - kLayerShift)) - 1;
constexpr std::uint32_t kMaxFine = (1U << (kLayerShift - kFineShift)) - 1;

// A float's bits, read as an integer, grow with its logarithm: 2^23 per octave, straight in
// between. That orders sizes without a logarithm, whose last bit differs between C libraries.
constexpr int kMantissaBits = 23;
constexpr std::uint32_t kBitsOfOne = 127U << kMantissaBits;

/// log2(ratio), times 2^23, straight within octaves, with 2^0 at `offsetOctaves`; never negative.
std::uint32_t logBits(float ratio, std::uint32_t offsetOctaves) {
  const auto bits = std::bit_cast<std::uint32_t>(ratio) + (offsetOctaves << kMantissaBits);
  return bits < kBitsOfOne ? 0 : bits - kBitsOfOne;
}

}  // namespace

Front::Front(double typicalSize, const Vec3& origin, FrontOrder order)
    : order_(order), typicalSize_(typicalSize), grid_(kCellPerSize * typicalSize, origin) {}

std::uint32_t Front::addNode(const Vec3& place, std::uint16_t layer) {
  nodes_.push_back(place);
  layers_.push_back(layer);
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

void Front::dropNodesFrom(std::size_t count) {
  nodes_.resize(count);
  layers_.resize(count);
}

Box Front::boxOf(std::uint32_t face) const {
  const NodeTriple& n = faces_[face].nodes;
  return Box::of(nodes_[n[0]], nodes_[n[1]], nodes_[n[2]]);
}

std::uint32_t Front::addFace(const NodeTriple& nodes, std::uint32_t region, FieldHint hint,
                             bool queued) {
  std::uint32_t id = 0;
  if (freeFaces_.empty()) {
    id = static_cast<std::uint32_t>(faces_.size());
    faces_.emplace_back();
    heap_.reserveIds(faces_.size());
  } else {
    id = freeFaces_.back();
    freeFaces_.pop_back();
  }
  const Vec3& a = nodes_[nodes[0]];
  const Vec3& b = nodes_[nodes[1]];
  const Vec3& c = nodes_[nodes[2]];
  const double squares = glm::dot(a - b, a - b) + glm::dot(b - c, b - c) + glm::dot(c - a, c - a);
  faces_[id] = {nodes, static_cast<float>(std::sqrt(squares / 3.0)), region, hint, 0, true};
  grid_.insert(id, boxOf(id));
  ++activeCount_;
  if (queued) heap_.push(id, keyOf(faces_[id]));
  return id;
}

void Front::removeFace(std::uint32_t face) {
  heap_.remove(face);
  grid_.remove(face);
  faces_[face].active = false;
  freeFaces_.push_back(face);
  --activeCount_;
}

void Front::requeue(std::uint32_t face, std::uint8_t ruleClass) {
  faces_[face].ruleClass = ruleClass;
  heap_.push(face, keyOf(faces_[face]));
}

std::uint64_t Front::keyOf(const FrontFace& face) {
  const std::uint64_t ruleClass = static_cast<std::uint64_t>(face.ruleClass) << kClassShift;
  const std::uint64_t sequence = sequence_++ & kSequenceMask;
  if (order_ == FrontOrder::kSmallestFirst) {
    // The float's own bits (31, as sizes are positive) above the sequence number.
    const std::uint64_t size = std::bit_cast<std::uint32_t>(face.size);
    return ruleClass | size << kFineShift | sequence;
  }
  const auto ratio = static_cast<float>(static_cast<double>(face.size) / typicalSize_);
  // Buckets of factor 4 (two octaves), one of them centred on the typical size: +1 octave.
  constexpr std::uint32_t kBucketOctaves = 127;
  const std::uint64_t bucket =
      std::min<std::uint32_t>(logBits(ratio, kBucketOctaves) >> (kMantissaBits + 1), 255);
  constexpr std::uint32_t kFineOctaves = 32;
  constexpr int kFineBits = 8;  // 256 steps per octave
  const std::uint64_t fine =
      std::min(logBits(ratio, kFineOctaves) >> (kMantissaBits - kFineBits), kMaxFine);
  const std::uint64_t layer =
      std::min<std::uint32_t>(static_cast<std::uint32_t>(layers_[face.nodes[0]]) +
                                  layers_[face.nodes[1]] + layers_[face.nodes[2]],
                              kMaxLayer);
  return ruleClass | bucket << kBucketShift | layer << kLayerShift | fine << kFineShift | sequence;
}

}  // namespace tetrafront
