#pragma once

/// @file The tetrahedral mesh that an adaptation changes: elements with their neighbours, and nodes with their metric and
/// their place on the boundary.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "metric/symmetric_tensor.h"
#include "remesh/feature_line.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"
#include "topology/tetrahedron.h"

namespace tetrafront {

/// What lies beyond a face of an element: another element, a patch of the boundary, or a face that is kept.
class Beyond {
 public:
  Beyond() = default;
  explicit Beyond(TetId element) : value_(element.value) {}
  [[nodiscard]] static Beyond patch(SmoothPatchId patch) { return Beyond(kBoundary | patch.value); }
  [[nodiscard]] static Beyond kept() { return Beyond(kKept); }

  [[nodiscard]] bool isElement() const { return value_ < kBoundary; }
  [[nodiscard]] bool isPatch() const { return value_ >= kBoundary && value_ != kKept; }
  [[nodiscard]] bool isKept() const { return value_ == kKept; }
  [[nodiscard]] TetId element() const { return TetId(value_); }
  [[nodiscard]] SmoothPatchId patch() const { return SmoothPatchId(value_ & ~kBoundary); }
  friend bool operator==(const Beyond&, const Beyond&) = default;

 private:
  static constexpr std::uint32_t kBoundary = 0x80000000U;
  static constexpr std::uint32_t kKept = 0xffffffffU;
  explicit Beyond(std::uint32_t value) : value_(value) {}
  std::uint32_t value_ = kKept;
};

enum class PlaceKind : std::uint8_t {
  kInside,  ///< moves freely
  kPatch,   ///< moves on a smooth patch
  kLine,    ///< moves along a feature line
  kFixed,   ///< stays
};

/// Where a node lies relative to the boundary.
struct Place {
  PlaceKind kind = PlaceKind::kInside;
  std::uint32_t entity = kNoIndex;  ///< a patch, a line, or a fixed node of the guide
  TriangleId near{};                ///< of a patch: the reference triangle at the node
  double arc = 0.0;                 ///< of a line

  [[nodiscard]] bool isOnBoundary() const { return kind != PlaceKind::kInside; }
};

struct AdaptNode {
  Vec3 point{0.0};
  SymmetricTensor metric;
  double density = 1.0;  ///< square root of the determinant of the metric
  double doubt = 0.0;    ///< part by which the density may be wrong; 0 where the metric is given
  GridTetId at{0U};      ///< background tetrahedron at the node
  TetId element{};       ///< one of its elements; none if the node is unused
  Place place;
  std::uint32_t part = 0;     ///< part of the given mesh that its elements belong to
  std::uint32_t changed = 0;  ///< when an element around it last changed
  std::uint32_t tried = 0;    ///< when it was last moved in vain
};

struct AdaptElement {
  NodeQuad nodes{};
  std::array<Beyond, 4> beyond{};  ///< opposite each node
  double quality = 0.0;
  std::uint32_t tried = 0;  ///< when it was last improved in vain

  [[nodiscard]] bool isAlive() const { return !nodes[0].isNone(); }
  /// Index of a node; 4 if the element does not have it.
  [[nodiscard]] std::size_t cornerOf(NodeId node) const {
    for (std::size_t k = 0; k < 4; ++k) {
      if (nodes[k] == node) return k;
    }
    return 4;
  }
  [[nodiscard]] bool has(NodeId node) const { return cornerOf(node) < 4; }
};

/// The elements around an edge, and the faces of the boundary that end there.
struct Shell {
  std::vector<TetId> elements;
  std::array<Beyond, 2> ends{};  ///< the boundary on either side; unused if the edge is inside
  bool isInside = true;

  /// True if both ends are patches.
  [[nodiscard]] bool isOnPatches() const {
    return !isInside && ends[0].isPatch() && ends[1].isPatch();
  }
};

/// Marks on the items of an array, all removed at once.
class Marks {
 public:
  void clear(std::size_t count) {
    if (stamps_.size() < count) stamps_.resize(2 * count + 64, 0);
    ++now_;
  }
  /// Returns false if the item was marked before.
  bool mark(std::size_t item) {
    if (stamps_[item] == now_) return false;
    stamps_[item] = now_;
    return true;
  }
  [[nodiscard]] bool has(std::size_t item) const { return stamps_[item] == now_; }

 private:
  std::vector<std::uint32_t> stamps_;
  std::uint32_t now_ = 0;
};

/// Metric length of the edge between two nodes: the logarithmic mean of its lengths in the metrics of both.
[[nodiscard]] double metricLengthBetween(const AdaptNode& from, const AdaptNode& to);

class AdaptMesh {
 public:
  std::vector<AdaptNode> nodes;
  std::vector<AdaptElement> elements;
  std::uint32_t now = 1;  ///< number of changes so far

  [[nodiscard]] AdaptNode& node(NodeId id) { return nodes[id.index()]; }
  [[nodiscard]] const AdaptNode& node(NodeId id) const { return nodes[id.index()]; }
  [[nodiscard]] AdaptElement& element(TetId id) { return elements[id.index()]; }
  [[nodiscard]] const AdaptElement& element(TetId id) const { return elements[id.index()]; }
  [[nodiscard]] const Vec3& point(NodeId id) const { return node(id).point; }
  [[nodiscard]] std::size_t elementCount() const { return elements.size() - free_.size(); }

  /// Returns an unused element.
  TetId addElement();
  void removeElement(TetId id);

  /// All elements and nodes at one time.
  struct State {
    std::vector<AdaptElement> elements;
    std::vector<AdaptNode> nodes;
    std::vector<TetId> free;
  };
  void save(State& state) const;
  /// Undoes all changes since the state was saved.
  void restore(const State& state);

  /// Metric length of an edge.
  [[nodiscard]] double lengthOf(NodeId a, NodeId b) const {
    return metricLengthBetween(node(a), node(b));
  }
  /// Mean ratio in the metric of the corner with the largest determinant, the least one if several may have it: 1 if regular,
  /// negative if not positively oriented.
  [[nodiscard]] double qualityOf(const NodeQuad& corners) const;

  /// Writes the elements around a node.
  void findBall(NodeId node, std::vector<TetId>& ball);
  /// Writes the elements around an edge of `first`, and its ends at the boundary.
  void findShell(NodeId a, NodeId b, TetId first, Shell& shell) const;
  /// Returns an element with both nodes, `hint` if it has them; none if there is none.
  [[nodiscard]] TetId findEdge(NodeId a, NodeId b, TetId hint);

  /// Marks the nodes of elements as changed now.
  void touch(std::span<const TetId> ids);

 private:
  void walkShell(NodeId a, NodeId b, TetId first, NodeId leave, bool isSecond, Shell& shell) const;

  std::vector<TetId> free_;
  Marks seen_;
  std::vector<TetId> ball_;
};

}  // namespace tetrafront
