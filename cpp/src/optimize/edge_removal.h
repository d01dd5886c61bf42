#pragma once

/// @file Swaps around an edge. The elements around an edge form a ring. Dynamic programming over
/// intervals of the ring finds the best elements that fill the same volume without the edge, or
/// with fewer sectors around it.

#include <array>
#include <cstdint>
#include <span>

#include "optimize/element_cost.h"
#include "optimize/tet_complex.h"

namespace tetrafront {

inline constexpr std::size_t kMaxRing = 11;

/// The elements around the edge from `from` to `to`, and the nodes between them, counter-clockwise
/// as seen from `to`. Element i has nodes i and i+1 of the ring. In a closed ring the last element
/// has the last and the first node.
struct EdgeRing {
  NodeId from;
  NodeId to;
  bool closed = true;
  std::size_t nodeCount = 0;
  std::size_t elementCount = 0;
  std::array<NodeId, kMaxRing> nodes;
  std::array<TetId, kMaxRing> elements;

  [[nodiscard]] std::span<const TetId> elementSpan() const {
    return std::span(elements).first(elementCount);
  }
};

/// Index in kTetEdges of the edge between two nodes of an element, or 6 if there is none.
[[nodiscard]] std::size_t edgeBetween(const Element& element, NodeId a, NodeId b);

/// Collects the ring. Returns false if it has more than `maxNodes` nodes.
[[nodiscard]] bool findRing(const TetComplex& complex, TetId tet, std::size_t edge,
                            std::size_t maxNodes, EdgeRing& ring);

/// Collects a closed ring if `tet` is its first element that changed since that pass; returns false
/// otherwise. A sweep over all elements thus visits each edge with a changed element once.
[[nodiscard]] bool findClosedRing(const TetComplex& complex, TetId tet, std::size_t edge,
                                  std::size_t maxNodes, std::uint32_t since, EdgeRing& ring);

/// Returns whether an element's edge lies on the boundary.
[[nodiscard]] bool isBoundaryEdge(const TetComplex& complex, TetId tet, std::size_t edge);

struct EdgeRemovalOptions {
  bool fans = false;  ///< also try to keep the edge with fewer sectors, boundary edges included
  /// Minimum gain as a fraction of the ring's cost. Swaps that gain less would only alternate with
  /// node moves.
  double minGain = 1e-4;
};

template <class Space = PlainSpace>
class EdgeRemoval {
 public:
  explicit EdgeRemoval(TetComplex& complex) : complex_(complex) {}

  /// Swaps if the ring's total cost falls. Returns whether it did.
  bool improve(const EdgeRing& ring, const ElementCost<Space>& cost,
               const EdgeRemovalOptions& options);

  /// Removes the edge of a closed ring at any cost. Returns false if that is impossible.
  bool force(const EdgeRing& ring, const ElementCost<Space>& cost);

 private:
  enum class Plan : std::uint8_t { kNone, kRemove, kFans };

  bool plan(const EdgeRing& ring, const ElementCost<Space>& cost, bool fans, double bound);
  [[nodiscard]] double costOverTriangle(const EdgeRing& ring, const ElementCost<Space>& cost,
                                        std::size_t i, std::size_t j, std::size_t k,
                                        double bound) const;
  [[nodiscard]] bool costIntervals(const EdgeRing& ring, const ElementCost<Space>& cost, bool wraps,
                                   double bound);
  void planFans(const EdgeRing& ring, const ElementCost<Space>& cost, double bound);
  void costSectors(const EdgeRing& ring, const ElementCost<Space>& cost, double bound);
  /// Returns false if there is no room for the elements of the plan.
  bool apply(const EdgeRing& ring, const ElementCost<Space>& cost);
  void fillInterval(const EdgeRing& ring, const ElementCost<Space>& cost, std::size_t first,
                    std::size_t length);
  void put(const ElementCost<Space>& cost, NodeId a, NodeId b, NodeId c, NodeId d);

  TetComplex& complex_;
  Plan plan_ = Plan::kNone;
  double planCost_ = 0.0;
  /// Cost of the best elements on ring nodes i .. i + length without the edge, and where that
  /// interval is divided.
  std::array<std::array<double, kMaxRing + 1>, kMaxRing> intervals_{};
  std::array<std::array<std::uint8_t, kMaxRing + 1>, kMaxRing> cuts_{};
  /// Cost of the single sector (from, to, node i, node i + length).
  std::array<std::array<double, kMaxRing + 1>, kMaxRing> sectors_{};
  std::array<std::uint8_t, kMaxRing + 1> fanCuts_{};
  std::size_t fanCount_ = 0;
  std::size_t fanStart_ = 0;
  std::array<NewElement, 4 * kMaxRing> fresh_;
  std::size_t freshCount_ = 0;
};

}  // namespace tetrafront
