#pragma once

/// @file Makes a valid mesh a good one: swaps, moves, splits and collapses in sweeps over the whole
/// mesh, then repair of the elements that still miss their angles. Shapes are judged as the size
/// field wants them: where it is stretched, in the space where the wanted element is regular. The
/// boundary is not touched, and every change keeps every element's volume positive.

#include <cstdint>
#include <memory>

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"

namespace tetrafront {

class MeshOptimizer {
 public:
  /// The first `boundaryNodes` nodes of the mesh are fixed. The field must outlive this. Costs are
  /// O(n) per sweep.
  MeshOptimizer(VolumeMesh mesh, std::size_t boundaryNodes, const SizeField& field,
                Optimization level);
  MeshOptimizer(MeshOptimizer&&) noexcept;
  MeshOptimizer& operator=(MeshOptimizer&&) noexcept;
  ~MeshOptimizer();

  /// Works on for about `budget` elements or nodes; true when finished.
  bool advance(std::uint32_t budget);

  /// Of its own work, 0 to 1, estimated.
  [[nodiscard]] double fraction() const;
  [[nodiscard]] std::uint32_t pointCount() const;
  [[nodiscard]] std::uint32_t tetrahedronCount() const;

  /// The mesh as it stands; always valid. Boundary nodes first, in their order.
  [[nodiscard]] VolumeMesh mesh() const;

 private:
  class Impl;
  template <class Space>
  class ImplIn;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
