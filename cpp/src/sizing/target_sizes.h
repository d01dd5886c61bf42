#pragma once

/// @file The sizes wanted on a given surface and in what it encloses (steps F1, F3): those of a
/// background grid, or else of the surface's own edges, up to one size; cut down by sources.

#include <cstdint>
#include <optional>
#include <vector>

#include "field/grid_locator.h"
#include "field/size_field.h"
#include "field/size_octree_builder.h"
#include "sizing/surface_coverage.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Whether the sizes come from the grid's tetrahedra: one size goes before them.
[[nodiscard]] bool usesGrid(const BackgroundGrid& grid, const MeshOptions& options);

/// Whether anything is asked for beyond the surface's own edges.
[[nodiscard]] bool hasTargetSizes(const BackgroundGrid& grid, const MeshOptions& options);

/// Finds what is wrong with the part of the grid that is used.
[[nodiscard]] BackgroundGridCheck targetSizeCheck(const BackgroundGrid& grid,
                                                  const MeshOptions& options);

/// kSizeTooLarge where the triangles of the surface, at least one, span less than the one size.
/// O(triangles).
[[nodiscard]] std::vector<Diagnostic> checkLargestSize(const SurfaceMesh& surface, double size);

/// What is asked for beside the surface's own edges: a size, or none, and sources. Not for grids.
[[nodiscard]] SizeField explicitTargetSizes(const BackgroundGrid& grid, const MeshOptions& options);

/// Whether the surface's own edges count where there is no grid, or only what is asked for beside them.
enum class EdgeSizes : std::uint8_t { kCount, kIgnored };

/// Makes the field in slices.
class TargetSizes {
 public:
  /// The grid must have passed targetSizeCheck(). All must outlive this.
  TargetSizes(const SurfaceMesh& surface, const BackgroundGrid& grid, const MeshOptions& options,
              EdgeSizes own);

  /// Works on for about `budget` places or cells; true when finished.
  bool advance(std::uint32_t budget);

  /// kOutsideBackgroundGrid, or nothing.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;

  /// Once, when finished.
  [[nodiscard]] SizeField take();

 private:
  const BackgroundGrid& grid_;
  const SurfaceMesh& surface_;
  std::optional<GridLocatorBuilder> locator_;
  std::optional<SizeField> field_;
  std::optional<SizeOctreeBuilder> builder_;
  std::optional<SurfaceCoverage> coverage_;
};

/// How many wanted elements an edge is long: an integral, by Simpson's rule.
[[nodiscard]] double metricLength(const SizeField& field, const Vec3& a, const Vec3& b,
                                  FieldHint& hint);

/// The same for one size throughout, that at `place`.
[[nodiscard]] double metricLengthAt(const SizeField& field, const Vec3& place, const Vec3& edge,
                                    FieldHint& hint);

}  // namespace tetrafront
