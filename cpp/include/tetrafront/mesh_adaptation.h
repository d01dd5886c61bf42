#pragma once

/// @file Adapts a tetrahedral mesh to a metric: afterwards, nearly all edges have about unit length in it, and elements are
/// regular in it. The boundary follows the given one.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/node_placement.h"
#include "tetrafront/sliced_tool.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Effort and aim of an adaptation.
struct AdaptOptions {
  /// Quality that the sweeps try to reach in every element, from 0 to 1; above 0.6, few meshes do.
  double leastQuality = 0.5;
  /// Sweeps at most that improve edges and elements, after the lengths have been reached.
  std::uint32_t sweeps = 12;
};

/// Metrics at the nodes of a background mesh. If the mesh fills the body and a larger part of its edges has unit length than in
/// the mesh to adapt, the adaptation begins with it: where it is adapted, nodes stay, with exactly these metrics. Between the
/// nodes, the logarithms of the metrics are interpolated; outside, the metric of the nearest position of the mesh applies.
struct MetricMesh {
  std::vector<double> points;             ///< x y z per node
  std::vector<std::uint32_t> tetrahedra;  ///< four nodes per element, in either orientation
  /// Per node the upper triangle of the symmetric matrix M by rows: xx xy xz yy yz zz. An edge e has length sqrt(e M e).
  std::vector<double> metrics;
};

/// The mesh to adapt. The boundary that is followed is its own, or the faces of a model that this approximates.
struct AdaptInput {
  std::vector<double> points;             ///< x y z per node
  std::vector<std::uint32_t> tetrahedra;  ///< four nodes per element, in any orientation
  std::vector<std::uint32_t> regions;     ///< one number per element, or empty
  /// Three nodes per triangle: faces of elements. Faces between regions and triangles inside are kept as they are.
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t>
      trianglePatch;  ///< one number per triangle; the lines between patches are kept
  /// Numbers of the TrimmedModels whose faces the boundary approximates (see model/model_numbers.h), or empty. New nodes on curved
  /// patches and lines are on their faces and edges. Faces that cannot be evaluated, or are not near, count as missing: the
  /// triangles of the mesh are followed there.
  std::vector<double> model;
  ModelTriangles modelTriangles;  ///< near the faces of the model
};

/// Number of classes in MetricStatistics::lengths.
inline constexpr std::size_t kLengthClasses = 16;

/// Lengths of edges and qualities of elements in a metric.
struct MetricStatistics {
  std::uint32_t nodes = 0;
  std::uint32_t tetrahedra = 0;
  std::uint32_t edges = 0;
  double unitEdges = 0.0;    ///< part of the edges with a length from 1 / sqrt(2) to sqrt(2)
  double peakedEdges = 0.0;  ///< part of the edges with a length from 0.8 to 1.25
  double shortest = 0.0;
  double longest = 0.0;
  /// Mean ratio in the metric of the node with the largest determinant: 1 for a regular element. After an adaptation that began
  /// with its background mesh, the least ratio over the nodes that may have the largest one, because between the nodes of
  /// the background determinants are interpolated.
  double leastQuality = 0.0;
  double meanQuality = 0.0;
  /// Number of edges per class: class i has lengths from 2^(i/4 - 2) to 2^(i/4 - 7/4); the first and the last have all beyond.
  std::array<std::uint32_t, kLengthClasses> lengths{};
};

/// Result of an adaptation. If there is a diagnostic of severity kError, nothing else is set but `isReadable`.
struct MeshAdaptation {
  /// False if an array length, an index, a coordinate or a metric is invalid, or if there is no element.
  bool isReadable = false;
  bool isPartial = false;                 ///< stop() ended the work early
  std::vector<double> points;             ///< x y z per node; those of triangles come first
  std::vector<std::uint32_t> tetrahedra;  ///< nodes a b c d per element, (b-a) x (c-a) . (d-a) > 0
  std::vector<std::uint32_t> regions;     ///< one per element, with the given numbers
  /// The boundary, counter-clockwise as seen from outside, and the kept triangles.
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> trianglePatch;  ///< one per triangle, with the given numbers
  std::vector<double> metrics;               ///< six per node, as MetricMesh::metrics
  MetricStatistics before;
  MetricStatistics after;
  std::vector<Diagnostic> diagnostics;
};

/// Adapts a mesh in slices by splits, collapses, swaps and moves. A unit of work is about one element. After stop(), the
/// result is the mesh as it then was, which is valid, too.
class MeshAdapter : public SlicedTool<MeshAdaptation> {
 public:
  MeshAdapter(AdaptInput input, MetricMesh background, const AdaptOptions& options);
};

}  // namespace tetrafront
