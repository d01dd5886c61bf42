#pragma once

/// @file Makes second-order elements whose edges follow a curved boundary, and proves that they are valid.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/sliced_tool.h"

namespace tetrafront {

inline constexpr std::size_t kScaledJacobianBins = 20;  ///< of 0.05
/// Elements with a smaller scaled Jacobian are improved.
inline constexpr double kGoodScaledJacobian = 0.2;
/// Largest number of elements that SecondOrderMesh::worst lists.
inline constexpr std::size_t kWorstCurvedElements = 10;

/// Edges that are not straight, and what their elements are like.
///
/// The scaled Jacobian of an element is the least value of det J in it divided by the largest magnitude (Persson & Peraire 2009),
/// where J belongs to the map from the reference tetrahedron: 1 for elements with straight edges, 0 or less for elements that
/// are invalid somewhere. A positive value is a proven lower bound, about 0.001 too low at most.
struct SecondOrderMesh {
  /// False if an array length, an index or a coordinate is invalid, or if there is no element. All other members then
  /// keep their defaults.
  bool isReadable = false;
  /// Two nodes per edge whose middle node is not halfway between its ends: the lower one, then the higher one; the edges
  /// ascend by their lower, then by their higher nodes. The middle nodes of all other edges are halfway.
  std::vector<std::uint32_t> edges;
  std::vector<double> middles;  ///< x y z per edge
  /// Corner nodes that were moved, ascending; all are inside. Elements with straight edges stay valid.
  std::vector<std::uint32_t> movedNodes;
  std::vector<double> movedPoints;  ///< x y z per moved node
  /// Two nodes per given edge that is straight now, because an element at it would be invalid: lower, higher; ascending.
  std::vector<std::uint32_t> straightened;
  /// Elements that have no positive volume even with straight edges, ascending. They stay as they are.
  std::vector<std::uint32_t> invertedTetrahedra;
  /// Elements with a scaled Jacobian other than 1, ascending; then one value per such element.
  std::vector<std::uint32_t> curvedTetrahedra;
  std::vector<double> scaledJacobians;
  double minScaledJacobian = 0.0;
  double meanScaledJacobian = 0.0;
  /// Number of elements per class from 0 to 1; the first one also has all below 0.
  std::array<std::uint32_t, kScaledJacobianBins> histogram{};
  std::vector<std::uint32_t> worst;  ///< curved elements with the least values, the least one first
};

/// Curves the edges of a mesh in slices. Given edges get given middles. Where an element is invalid then, or its scaled
/// Jacobian below kGoodScaledJacobian, middles of edges inside are moved; then, at invalid elements, nodes inside; at last given
/// edges at invalid elements are straightened one by one. All elements of the result are valid, except for those that were
/// invalid with straight edges.
///
/// det J of a ten-node tetrahedron is a cubic polynomial. Its least value is bounded by its 20 Bezier coefficients, on
/// pieces of the element that are halved until the bound is close (Johnen, Remacle & Geuzaine 2013), at most 30 times. The sign
/// takes all rounding into account. Elements with straight edges only cost one exact orientation. O(n) for n elements, beside the elements
/// that are improved. A unit of work is an element.
class SecondOrderBuilder : public SlicedTool<SecondOrderMesh> {
 public:
  /// `points`: x y z per node. `tetrahedra`: nodes a b c d of element t at [4t..4t+3], (b-a) x (c-a) . (d-a) > 0. `triangles`:
  /// three nodes per triangle of the boundary and of interfaces, whose nodes stay, and whose edges stay straight if no middle is given.
  /// `curvedEdges`: two nodes per edge, each edge once. `curvedMiddles`: x y z per curved edge. All arrays are copied.
  SecondOrderBuilder(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
                     std::span<const std::uint32_t> triangles,
                     std::span<const std::uint32_t> curvedEdges,
                     std::span<const double> curvedMiddles);
};

}  // namespace tetrafront
