#pragma once

/// @file Second derivatives of a solution at the nodes of its mesh: at each node, those of the quadratic function that
/// fits the values around it best. On the values of a quadratic function they are exact up to rounding, at the boundary
/// too, where the samples lie on one side (Zhang & Naga 2005, polynomial preserving recovery).

#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "metric/mesh_metric.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// One number per sample and component: value `component` of sample s is values[components * s + component].
struct SampledValues {
  std::span<const double> values;
  std::uint32_t components = 1;
  bool isPerElement = false;  ///< samples are the centroids of the elements, not the nodes
};

/// Returns the Hessians, six numbers per node, one component after the other. `edges` are those of the mesh. At a node,
/// samples are taken from a growing neighbourhood until they determine a quadratic function well. Nodes without an
/// element get zeros.
Task<std::vector<double>> recoverHessians(Work& work, const VolumeMesh& mesh,
                                          const MeshEdges& edges, SampledValues samples);

}  // namespace tetrafront
