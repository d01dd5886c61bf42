#pragma once

/// @file Meshes from anywhere: whether they are sound, how good their elements are, and what bounds
/// them. Signs are exact, and figures are those of a run's own report.

#include <cstdint>
#include <memory>
#include <span>

#include "tetrafront/mesh.h"
#include "tetrafront/quality_statistics.h"
#include "tetrafront/status.h"

namespace tetrafront {

struct MeshInspection {
  /// Whole numbers in range, finite coordinates, at least one element. If not, nothing else is told.
  bool isReadable = false;
  std::uint32_t nodes = 0;  ///< that elements use
  std::uint32_t unusedNodes = 0;
  std::uint32_t tetrahedra = 0;
  std::uint32_t turnedTetrahedra = 0;  ///< with (b-a) x (c-a) . (d-a) < 0; measured as if turned
  std::uint32_t flatTetrahedra = 0;    ///< without volume, exactly
  std::uint32_t repeatedTetrahedra = 0;
  std::uint32_t crowdedFaces = 0;     ///< of more than two elements
  std::uint32_t overlaps = 0;         ///< faces of two elements on the same side
  std::uint32_t coincidentNodes = 0;  ///< used nodes at the place of another
  double shortestEdge = 0.0;
  double longestEdge = 0.0;
  /// Over the edges of all elements, each as often as elements have it.
  double meanEdge = 0.0;
  QualitySummary quality;
  /// With `meanEdge` as the wanted length of all edges.
  QualityStatistics statistics;
  /// Faces of one element, counter-clockwise seen from outside; nodes are those of the mesh. Per
  /// triangle the region of its element in trianglePatch. `points` stays empty.
  SurfaceMesh boundary;
};

/// Inspects a mesh in slices. O(n log n).
class MeshInspector {
 public:
  /// The elements a b c d at tetrahedra[4t..4t+3], positions in `points` (x y z each), with one region
  /// each, or none at all. All is copied.
  MeshInspector(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
                std::span<const std::uint32_t> regions);
  MeshInspector(MeshInspector&&) noexcept;
  MeshInspector& operator=(MeshInspector&&) noexcept;
  ~MeshInspector();

  /// Works on for about `budget` elements; true when finished.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const MeshInspection& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The whole inspection at once.
[[nodiscard]] MeshInspection inspectMesh(std::span<const double> points,
                                         std::span<const std::uint32_t> tetrahedra,
                                         std::span<const std::uint32_t> regions);

}  // namespace tetrafront
