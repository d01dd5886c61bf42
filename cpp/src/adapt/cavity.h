#pragma once

/// @file The one operator of an adaptation: a cavity of elements is taken out, and its hull is starred from a point, new or
/// a corner of the cavity. Splits, collapses, edge removals and swaps are cavities of their own kind.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "adapt/adapt_mesh.h"
#include "adapt/badness.h"
#include "adapt/boundary_guide.h"

namespace tetrafront {

/// Edges by their nodes, in the order of their first use; emptied at once.
template <class Value>
class EdgeMap {
 public:
  struct Entry {
    NodeId low;
    NodeId high;
    Value value;
  };

  void clear() {
    entries_.clear();
    if (stamps_.empty()) grow(1024);
    ++now_;
  }
  /// Returns the value of an edge, new if it was not there. Valid until the next call.
  Value& operator()(NodeId a, NodeId b) {
    if (b < a) std::swap(a, b);
    if (2 * entries_.size() >= stamps_.size()) grow(2 * stamps_.size());
    for (std::size_t slot = slotOf(a, b);; slot = (slot + 1) & (stamps_.size() - 1)) {
      if (stamps_[slot] != now_) {
        stamps_[slot] = now_;
        items_[slot] = static_cast<std::uint32_t>(entries_.size());
        return entries_.emplace_back(Entry{a, b, {}}).value;
      }
      Entry& entry = entries_[items_[slot]];
      if (entry.low == a && entry.high == b) return entry.value;
    }
  }
  [[nodiscard]] std::span<Entry> entries() { return entries_; }

 private:
  [[nodiscard]] std::size_t slotOf(NodeId a, NodeId b) const {
    const std::uint32_t mixed = (a.value * 0x9e3779b1U) ^ (b.value * 0x85ebca77U);
    return (mixed ^ mixed >> 15U) & (stamps_.size() - 1);
  }
  void grow(std::size_t slots) {
    stamps_.assign(slots, 0);
    items_.assign(slots, 0);
    now_ = 1;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      std::size_t slot = slotOf(entries_[i].low, entries_[i].high);
      while (stamps_[slot] == now_) slot = (slot + 1) & (slots - 1);
      stamps_[slot] = now_;
      items_[slot] = static_cast<std::uint32_t>(i);
    }
  }

  std::vector<Entry> entries_;
  std::vector<std::uint32_t> stamps_;
  std::vector<std::uint32_t> items_;
  std::uint32_t now_ = 0;
};

/// How a cavity is starred.
struct StarPlan {
  NodeId apex;
  /// Faces of the boundary with these nodes are replaced by faces at the apex; none: no such face.
  NodeId under{};
  NodeId alsoUnder{};
  bool mayGrow = false;  ///< the cavity takes in elements beyond faces that the apex does not see
  /// Largest cost of the new elements; above it, building ends early. Does not count once the cavity has grown.
  double allowance = kForbidden;
  std::uint32_t removed = 0;  ///< nodes that vanish
};

class Cavity {
 public:
  Cavity(AdaptMesh& mesh, const BoundaryGuide& guide, const Badness& badness)
      : mesh_(mesh), guide_(guide), badness_(badness) {}

  /// The elements that are taken out; to be set before build().
  std::vector<TetId> elements;

  /// Stars the hull. Returns false if an element would be flat or inverted, or a node would be lost.
  [[nodiscard]] bool build(const StarPlan& plan);
  /// Measures the change that build() prepared.
  void evaluate();
  /// Makes the change. Returns false, and changes nothing, if the mesh would not remain valid.
  [[nodiscard]] bool commit();

  [[nodiscard]] double worstBefore() const { return worstBefore_; }
  [[nodiscard]] double worstAfter() const { return worstAfter_; }
  [[nodiscard]] double gain() const { return -change_; }  ///< by which the badness falls
  [[nodiscard]] double longestNew() const { return longestNew_; }

 private:
  enum class HullKind : std::uint8_t {
    kStarred,  ///< becomes a face of a new element
    kAtApex,   ///< has the apex as a node
    kUnder,    ///< of the boundary, and replaced
  };
  struct HullFace {
    NodeTriple nodes;  ///< counter-clockwise as seen from the cavity
    Beyond beyond;
    HullKind kind;
    std::uint32_t item;  ///< index of the new element, of a starred face
  };
  struct NewElement {
    NodeQuad nodes;  ///< a starred face, then the apex
    double quality;
  };
  struct EdgeState {
    bool isOld = false;
    bool isNew = false;
  };
  /// The one or two hull faces at an edge.
  struct Rim {
    std::uint32_t count = 0;
    std::array<std::uint32_t, 2> faces{};
    std::array<std::uint8_t, 2> corners{};  ///< opposite the edge
  };

  [[nodiscard]] bool collectHull(const StarPlan& plan, bool& hasGrown);
  [[nodiscard]] HullKind kindOf(const NodeTriple& nodes, Beyond beyond, const StarPlan& plan) const;
  [[nodiscard]] bool keepsNodes(const StarPlan& plan);
  [[nodiscard]] bool keepsLinks();
  [[nodiscard]] bool matchRims();
  [[nodiscard]] bool isDisc();
  [[nodiscard]] bool isRimValid(const Rim& rim) const;
  [[nodiscard]] bool isNewFaceValid(const HullFace& under, std::size_t corner) const;
  void makeElements();
  void linkRims();
  void relink(Beyond outside, const NodeTriple& face, Beyond to);
  [[nodiscard]] bool isTaken(TetId id) const { return taken_.has(id.index()); }

  AdaptMesh& mesh_;
  const BoundaryGuide& guide_;
  const Badness& badness_;
  NodeId apex_;
  std::vector<HullFace> hull_;
  std::vector<NewElement> made_;
  std::vector<TetId> ids_;
  Marks taken_;
  Marks seen_;
  EdgeMap<EdgeState> edges_;
  EdgeMap<Rim> rims_;
  std::vector<TetId> ball_;
  double worstBefore_ = 0.0;
  double worstAfter_ = 0.0;
  double change_ = 0.0;
  double longestNew_ = 0.0;
};

}  // namespace tetrafront
