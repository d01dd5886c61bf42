#pragma once

/// @file A tetrahedral mesh that can be changed: elements with their neighbours, nodes with one of
/// their elements. There is one kind of change: it replaces the elements of a cavity by others with
/// the same outer faces.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/free_memory.h"
#include "base/ids.h"
#include "base/task.h"
#include "optimize/element_cost.h"
#include "tetrafront/vec3.h"
#include "topology/tet_mesh.h"
#include "topology/tetrahedron.h"

namespace tetrafront {

using Corners = NodeQuad;

struct Element {
  Corners nodes;
  std::array<ElementFace, 4> across;  ///< the neighbour's face; none on the boundary
};

/// Returns which corner of the element a node is; it must be one. Branch-free, because the branches
/// would be unpredictable.
[[nodiscard]] inline std::size_t cornerOf(const Element& element, NodeId node) {
  const Corners& nodes = element.nodes;
  return static_cast<std::size_t>((nodes[1] == node ? 1 : 0) | (nodes[2] == node ? 2 : 0) |
                                  (nodes[3] == node ? 3 : 0));
}

/// A new element with its cost.
struct NewElement {
  Corners nodes;
  double cost;
};

/// Largest cavity; operators give up on larger ones.
inline constexpr std::size_t kMaxCavity = 500;

/// The elements around a node, and which of their corners it is.
struct Star {
  std::array<TetId, kMaxCavity + 3> elements;  ///< with room for the neighbours of the last one
  std::array<std::uint8_t, kMaxCavity> corner;
  std::size_t size = 0;
};

class TetComplex {
 public:
  /// Until findNeighbours() has finished, nothing may change.
  explicit TetComplex(TetMesh mesh, bool isStretched = false);

  /// Finds the neighbours of all elements. O(n log k) for k elements at a node.
  Task<> findNeighbours(Work& work);

  /// Returns the elements, and the used and the fixed nodes in their order.
  [[nodiscard]] TetMesh toMesh() const { return meshOf(positions_, regions_); }
  /// The same with fewer copies; once, as the last call.
  [[nodiscard]] TetMesh take() {
    freeMemory(states_);
    return meshOf(std::move(positions_), std::move(regions_));
  }

  // Nodes.
  [[nodiscard]] std::size_t nodeCount() const { return positions_.size(); }
  [[nodiscard]] const Vec3& position(NodeId node) const { return positions_[node.index()]; }
  /// Target of the size field at a node; undefined until set.
  template <class Space>
  [[nodiscard]] const typename Space::Target& target(NodeId node) const {
    return targetsOf<Space>(*this)[node.index()];
  }
  template <class Space>
  void setTarget(NodeId node, const typename Space::Target& target) {
    targetsOf<Space>(*this)[node.index()] = target;
  }
  [[nodiscard]] bool isFixed(NodeId node) const { return isFixed_[node.index()] != 0; }
  /// Returns whether any element uses the node.
  [[nodiscard]] bool isUsed(NodeId node) const { return !elementAt_[node.index()].isNone(); }
  [[nodiscard]] std::size_t fixedNodeCount() const { return fixedNodes_; }
  /// Returns whether the targets of nodes are tensors.
  [[nodiscard]] bool isStretched() const { return isStretched_; }
  [[nodiscard]] std::size_t freeNodeCount() const;
  template <class Space>
  NodeId addNode(const Vec3& position, const typename Space::Target& target) {
    const NodeId node = addNode(position);
    setTarget<Space>(node, target);
    return node;
  }
  void move(NodeId node, const Vec3& position);
  void forget(NodeId node) { elementAt_[node.index()] = TetId(); }

  // Elements. The slots of removed elements are reused.
  [[nodiscard]] std::size_t slotCount() const { return elements_.size(); }
  [[nodiscard]] std::size_t elementCount() const { return elements_.size() - freeSlots_.size(); }
  [[nodiscard]] bool isLive(TetId tet) const { return !elements_[tet.index()].nodes[0].isNone(); }
  [[nodiscard]] const Element& element(TetId tet) const { return elements_[tet.index()]; }
  [[nodiscard]] std::uint32_t regionOf(TetId tet) const { return regions_[tet.index()]; }
  [[nodiscard]] double cost(TetId tet) const { return states_[tet.index()].cost; }
  void setCost(TetId tet, double cost);
  template <class Space>
  [[nodiscard]] typename Space::Frame frameOf(const Corners& nodes) const {
    if constexpr (Space::kIsStretched) {
      return Space::frameOf(target<Space>(nodes[0]), target<Space>(nodes[1]),
                            target<Space>(nodes[2]), target<Space>(nodes[3]));
    } else {
      return {};
    }
  }
  template <class Space>
  [[nodiscard]] double costOf(const ElementCost<Space>& cost, const Corners& nodes) const {
    return cost(position(nodes[0]), position(nodes[1]), position(nodes[2]), position(nodes[3]),
                frameOf<Space>(nodes));
  }
  /// Recomputes the costs of slots [first, last) by another measure.
  template <class Space>
  void recomputeCosts(const ElementCost<Space>& cost, std::size_t first, std::size_t last);

  // Passes, numbered from 1, record when an element last changed.
  void beginPass() { ++pass_; }
  [[nodiscard]] std::uint32_t pass() const { return pass_; }
  [[nodiscard]] std::uint32_t changedIn(TetId tet) const { return states_[tet.index()].pass; }
  [[nodiscard]] std::uint32_t starChangedIn(NodeId node) const { return starPass_[node.index()]; }
  void markChanged(TetId tet) { states_[tet.index()].pass = pass_; }
  void markStars(TetId tet);

  /// Returns false if the star is larger than kMaxCavity. `node` must be used.
  bool findStar(NodeId node, Star& star);
  /// Returns a new stamp for a set of elements, to test membership in a cavity.
  std::uint32_t freshStamp() { return ++stamp_; }
  void stamp(TetId tet, std::uint32_t value) { states_[tet.index()].stamp = value; }
  [[nodiscard]] bool hasStamp(TetId tet, std::uint32_t value) const {
    return states_[tet.index()].stamp == value;
  }

  /// Replaces the elements `old` by `fresh`, which must have the same outer faces.
  void replace(std::span<const TetId> old, std::span<const NewElement> fresh);

  /// From now on, changes may make more elements only up to this number.
  void limitElements(std::size_t most) { mostElements_ = most; }
  /// Returns whether a change may replace so many elements by so many others. In a trial it may: fitsTrial() decides at
  /// its end.
  [[nodiscard]] bool hasRoomFor(std::size_t removed, std::size_t added);
  /// Returns whether the limit permits what the trial has made.
  [[nodiscard]] bool fitsTrial();
  /// Whether the limit has refused a change.
  [[nodiscard]] bool hasRefusedGrowth() const { return hasRefusedGrowth_; }

  // A trial: a change that can be undone.
  void beginTrial();
  void keepTrial();
  void takeBack();
  /// Sum of weigh(cost) over the elements that the trial touched: before it, and now.
  struct TrialSums {
    double before = 0.0;
    double now = 0.0;
  };
  template <class Weigh>
  [[nodiscard]] TrialSums sumsOfTrial(Weigh weigh);
  /// Returns whether the cost is valid for all elements that the trial touched or made.
  template <class Space>
  [[nodiscard]] bool isTrialValid(const ElementCost<Space>& cost);
  /// Live elements that the trial touched or made.
  [[nodiscard]] std::vector<TetId> touchedByTrial();

 private:
  /// Values of an element that are read together, stored together.
  struct ElementState {
    double cost = 0.0;
    std::uint32_t pass = 0;  ///< pass of its last change
    std::uint32_t stamp = 0;
  };
  struct SavedElement {
    TetId id;
    Element element;
    double cost;
    std::uint32_t pass;
  };
  struct SavedPosition {
    NodeId node;
    Vec3 position;
  };
  struct FaceKey {
    std::array<std::uint32_t, 3> nodes;
    friend bool operator==(const FaceKey&, const FaceKey&) = default;
  };
  struct FaceSlot {
    FaceKey key;
    ElementFace facing;
    std::uint32_t stamp = 0;
  };
  static constexpr std::size_t kFaceSlots = 8192;  // a power of two, above 4 x 2 x kMaxCavity

  /// Returns the array that has an entry for each node: sizes_ or tensors_.
  template <class Space, class Self>
  [[nodiscard]] static auto& targetsOf(Self& self) {
    if constexpr (Space::kIsStretched) {
      return self.tensors_;
    } else {
      return self.sizes_;
    }
  }
  [[nodiscard]] TetMesh meshOf(std::vector<Vec3> positions,
                               std::vector<std::uint32_t> regions) const;
  NodeId addNode(const Vec3& position);
  void resizeNodes(std::size_t count);
  [[nodiscard]] FaceKey keyOf(const Corners& nodes, std::size_t corner) const;
  FaceSlot& slotFor(const FaceKey& key);
  TetId takeSlot();
  void link(TetId tet, std::size_t corner);
  void join(ElementFace one, ElementFace other);
  void save(TetId tet);

  std::vector<std::uint8_t> isFixed_;
  std::size_t fixedNodes_;
  std::vector<Vec3> positions_;
  bool isStretched_;
  std::vector<double> sizes_;             ///< target lengths, without stretching
  std::vector<SymmetricTensor> tensors_;  ///< T, with stretching
  std::vector<TetId> elementAt_;
  std::vector<std::uint32_t> starPass_;
  std::vector<Element> elements_;
  std::vector<std::uint32_t> regions_;
  std::vector<ElementState> states_;
  std::vector<TetId> freeSlots_;
  std::uint32_t pass_ = 1;
  std::uint32_t stamp_ = 0;
  std::vector<FaceSlot> faceSlots_;
  std::uint32_t faceStamp_ = 0;
  std::size_t mostElements_ = std::numeric_limits<std::size_t>::max();
  bool hasRefusedGrowth_ = false;
  bool inTrial_ = false;
  std::size_t elementsBeforeTrial_ = 0;
  std::vector<SavedElement> savedElements_;
  std::vector<SavedPosition> savedPositions_;
  std::size_t freeSlotsKept_ = 0;  ///< number of freeSlots_ that the trial has not used
  std::vector<TetId> takenSlots_;  ///< the slots that the trial used, the last one first
  std::size_t slotsBeforeTrial_ = 0;
  std::size_t nodesBeforeTrial_ = 0;
};

template <class Space>
bool TetComplex::isTrialValid(const ElementCost<Space>& cost) {
  return !cost.hasLimit() || std::ranges::all_of(touchedByTrial(), [&](TetId tet) {
    return costOf(cost, element(tet).nodes) < kInvalidCost;
  });
}

template <class Weigh>
TetComplex::TrialSums TetComplex::sumsOfTrial(Weigh weigh) {
  TrialSums sums;
  const std::uint32_t stamp = freshStamp();
  for (const SavedElement& saved : savedElements_) {
    // The first saved state of an element is the one before the trial.
    if (hasStamp(saved.id, stamp)) continue;
    this->stamp(saved.id, stamp);
    const bool wasLive = !saved.element.nodes[0].isNone() && saved.id.index() < slotsBeforeTrial_;
    if (wasLive) sums.before += weigh(saved.cost);
  }
  for (const TetId tet : touchedByTrial()) sums.now += weigh(cost(tet));
  return sums;
}

}  // namespace tetrafront
