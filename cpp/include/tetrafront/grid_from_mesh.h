#pragma once

/// @file A background grid from a generated mesh, for adaptive remeshing (Löhner & Parikh 1988, section 3).

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Returns a generated mesh as a background grid (section 3). `sizes` holds one target size per node of the mesh. If
/// it is empty, the sizes follow from the mean edge length at each node, so that the grid asks for about as many
/// elements as the mesh has. Leaves out nodes without an element. An incomplete mesh covers only what it fills.
/// O(n) for n elements.
[[nodiscard]] BackgroundGrid gridFromMesh(const VolumeMesh& mesh, std::span<const double> sizes);

/// Does the work of gridFromMesh() in slices.
class MeshGridBuilder {
 public:
  MeshGridBuilder(VolumeMesh mesh, std::vector<double> sizes);
  MeshGridBuilder(MeshGridBuilder&&) noexcept;
  MeshGridBuilder& operator=(MeshGridBuilder&&) noexcept;
  ~MeshGridBuilder();

  /// Visits about `budget` elements or nodes; true when finished.
  bool advance(std::uint32_t budget);

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const BackgroundGrid& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
