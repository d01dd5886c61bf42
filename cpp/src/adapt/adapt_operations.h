#pragma once

/// @file The changes of an adaptation, each a cavity that is starred, and the rules by which they are accepted.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/adapt_mesh.h"
#include "adapt/badness.h"
#include "adapt/boundary_guide.h"
#include "adapt/cavity.h"
#include "adapt/metric_background.h"

namespace tetrafront {

/// Small pseudo-random numbers, the same on every machine.
class AdaptRandom {
 public:
  /// Returns a number in [0, 1).
  double next() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<double>(state_ >> 8U) / 16777216.0;
  }
  /// Returns an index below `count`.
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(next() * static_cast<double>(count));
  }

 private:
  std::uint32_t state_ = 12345;
};

/// What everything that changes the mesh works on.
struct AdaptContext {
  AdaptMesh& mesh;
  const BoundaryGuide& guide;
  const MetricBackground& background;
  const Badness& badness;

  /// Gives a node the metric at its position.
  void measure(AdaptNode& node) const;
};

/// When a change is accepted.
enum class Acceptance : std::uint8_t {
  kLengths,  ///< lengths lead; elements must not become nearly flat
  kBadness,  ///< the badness must fall
  kAny,      ///< the mesh only remains valid: a disturbance
};

class AdaptOperations {
 public:
  explicit AdaptOperations(const AdaptContext& context)
      : context_(context), cavity_(context.mesh, context.guide, context.badness) {}

  /// Splits an edge of `element` at a part of its way, by default the middle in the metric.
  bool split(NodeId a, NodeId b, TetId element, Acceptance acceptance, double part = -1.0);
  /// Collapses an edge of `element`, in either direction.
  bool collapse(NodeId a, NodeId b, TetId element, Acceptance acceptance) {
    return collapseOnto(a, b, element, acceptance) || collapseOnto(b, a, element, acceptance);
  }
  /// Removes an edge: its shell is starred from the best of its other nodes. kAny: from a random one.
  bool removeEdge(NodeId a, NodeId b, TetId element, Acceptance acceptance, AdaptRandom& random);
  /// Replaces a face by an edge.
  bool swapFace(TetId element, std::size_t corner, Acceptance acceptance);
  /// Takes off a flat element with two faces and all nodes on one curved patch.
  bool peel(TetId id);
  /// Inserts a node at the centroid of an element.
  bool insert(TetId element);

 private:
  [[nodiscard]] bool isAccepted(Acceptance acceptance) const;
  bool collapseOnto(NodeId a, NodeId b, TetId element, Acceptance acceptance);
  [[nodiscard]] bool mayCollapse(NodeId a, NodeId b, TetId element);
  [[nodiscard]] bool placeOnEdge(NodeId a, NodeId b, double part, AdaptNode& node) const;
  bool starFromNew(const AdaptNode& node, const StarPlan& plan, Acceptance acceptance);
  /// Returns the largest cost of new elements with which a change can still lower the badness: the elements of `taken` and edges
  /// with the cost `edges` vanish.
  [[nodiscard]] double allowanceFor(Acceptance acceptance, std::span<const TetId> taken,
                                    double edges) const;
  [[nodiscard]] double costOfEdgesAt(NodeId node);
  void findRing(NodeId a, NodeId b);
  [[nodiscard]] double middleOf(NodeId a, NodeId b) const;
  [[nodiscard]] bool isPeelGood(const AdaptElement& element) const;

  AdaptContext context_;
  Cavity cavity_;
  Shell shell_;
  std::vector<NodeId> ring_;
  Marks seen_;
};

}  // namespace tetrafront
