#pragma once

/// @file The linear functions on a mesh whose products with all linear functions have given integrals: the projection of
/// a field in the sense of least squares. The mass matrix is well conditioned, so conjugate gradients take few steps.

#include <cstddef>
#include <span>
#include <vector>

#include "base/task.h"
#include "tetrafront/mesh.h"
#include "topology/mesh_access.h"

namespace tetrafront {

class MassProjection {
 public:
  /// `components`: numbers per node. `mesh` must outlive the projection.
  MassProjection(const VolumeMesh& mesh, std::size_t components);

  /// Adds the integrals over an element: corner by corner, all components times the weight of the corner.
  void add(TetId tet, std::span<const double> integrals);

  /// Returns the values at the nodes, node by node. `guess`: values with which the search begins; they are kept at nodes
  /// without an element.
  Task<std::vector<double>> solve(Work& work, std::vector<double> guess);

 private:
  /// Adds a component of the mass matrix times values to `products`.
  void multiply(std::span<const double> values, std::vector<double>& products) const;
  Task<> solveComponent(Work& work, std::size_t component, std::vector<double>& values);

  const VolumeMesh* mesh_;
  std::size_t components_;
  std::vector<double> integrals_;
  std::vector<double> volumes_;   ///< per element
  std::vector<double> diagonal_;  ///< of the mass matrix, per node
};

}  // namespace tetrafront
