#pragma once

/// @file Metrics at the nodes of a mesh: the metric that the mesh itself follows, the number of elements that metrics
/// ask for, and the limit of their growth from node to node. Metrics are flat arrays, six numbers per node
/// (symmetric_tensor.h).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "metric/symmetric_tensor.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Returns the metric in which all six edges of a tetrahedron have length 1; the zero tensor if it is degenerate.
[[nodiscard]] SymmetricTensor impliedMetric(const std::array<Vec3, 4>& p);

/// Returns at each node the log-Euclidean mean of the implied metrics of its elements, weighted by their volumes. Nodes
/// without an element of positive volume get the zero tensor.
Task<std::vector<double>> impliedMetrics(Work& work, const VolumeMesh& mesh);

/// Elements of a mesh / complexity of the metric that it follows. A mesh of regular tetrahedra with edges of length 1
/// would have 8.5, but they do not fill space. Adapted meshes of mmg 5.8 have 10.4, 10.7 and 11.1 (with the mean at the nodes) in three cases of the
/// Unstructured Grid Adaptation Working Group, and 15.7 in the fourth, where a curved boundary is finer than its metric.
inline constexpr double kElementsPerComplexity = 10.0;

/// Returns the integral of sqrt(det M) over a tetrahedron, from its values at the corners, > 0. Logarithms of metrics are
/// interpolated linearly, so the logarithm of sqrt(det M) is linear too.
[[nodiscard]] double complexityWithin(const std::array<Vec3, 4>& corners,
                                      const std::array<double, 4>& densities);

/// Returns the integral of sqrt(det M) over the mesh, the complexity of the metric. `metrics` must be positive definite.
[[nodiscard]] double complexityOf(const VolumeMesh& mesh, std::span<const double> metrics);

/// The edges of a mesh, each once, with the lower node first, ascending.
using MeshEdges = std::vector<std::array<std::uint32_t, 2>>;
Task<MeshEdges> edgesOf(Work& work, const VolumeMesh& mesh);

/// Limits the growth of metrics along the edges. Seen from node p, the metric at node q must not be below M_p / (1 +
/// growth l)^2, where l is the length of the edge in M_p: all sizes of p may grow by the same factor, the one by which
/// the size along the edge grows by `growth` per unit of distance (Alauzet 2010, homogeneous growth in the metric
/// space). The axes of M_p and the ratios of its sizes are kept, so a layer of thin elements stays thin along itself.
/// Where a metric is below the limit, it is intersected with it. Nodes that comply keep their bits. Sweeps over the
/// edges end when no metric is below its limit by more than 0.01 %, at the latest after 100. `growth` > 0.
Task<> limitGrowth(Work& work, const VolumeMesh& mesh, const MeshEdges& edges, double growth,
                   std::vector<double>& metrics);

}  // namespace tetrafront
