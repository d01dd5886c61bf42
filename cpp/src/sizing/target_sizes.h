#pragma once

/// @file The target sizes on a given surface and in its interior (steps F1, F3): the sizes of a background grid, or
/// else those of the surface's own edges, capped by one size. Sources cap both.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/task.h"
#include "field/check_background_grid.h"
#include "field/size_field.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// True if the sizes come from the tetrahedra of the grid. A size in the options replaces them.
[[nodiscard]] bool usesGrid(const BackgroundGrid& grid, const MeshOptions& options);

/// True if a size, a largest volume, a grid or a source is given, beyond the surface's own edges.
[[nodiscard]] bool hasTargetSizes(const BackgroundGrid& grid, const MeshOptions& options);

/// Checks the part of the grid that is used. `grid` must outlive the task.
[[nodiscard]] Task<std::vector<Diagnostic>> checkTargetGrid(Work& work, const BackgroundGrid& grid,
                                                            const MeshOptions& options);

/// Returns kSizeTooLarge if `size` exceeds the extent of the surface, which must have a triangle. O(triangles).
[[nodiscard]] std::vector<Diagnostic> checkLargestSize(const SurfaceMesh& surface, double size);

/// Returns the target sizes without the surface's own edges and without the grid: the size of the options, if any,
/// capped by the sources and by the size for the largest volume.
[[nodiscard]] SizeField explicitTargetSizes(const BackgroundGrid& grid, const MeshOptions& options);

/// Whether the lengths of the surface's own edges are target sizes, if no grid is used.
enum class EdgeSizes : std::uint8_t { kCount, kIgnored };

/// Makes the size field in slices.
class TargetSizes {
 public:
  /// The grid must have passed checkTargetGrid(). The references must outlive this.
  TargetSizes(const SurfaceMesh& surface, const BackgroundGrid& grid, const MeshOptions& options,
              EdgeSizes edgeSizes)
      : surface_(surface), grid_(grid), options_(options), edgeSizes_(edgeSizes) {}

  /// Visits about `budget` positions or cells; returns true when finished.
  bool advance(std::uint32_t budget) { return job_.advance(budget); }
  /// 0 to 1.
  [[nodiscard]] double fraction() const { return job_.fraction(); }

  /// When finished: kOutsideBackgroundGrid if the grid does not cover the surface, or nothing.
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

  /// Returns the field; once, when finished.
  [[nodiscard]] SizeField take() { return std::move(*field_); }

 private:
  Task<> makeField(Work& work);
  Task<> locateGrid(Work& work);
  Task<> checkCoverage(Work& work);
  Task<> measureEdges(Work& work);

  const SurfaceMesh& surface_;
  const BackgroundGrid& grid_;
  const MeshOptions& options_;
  EdgeSizes edgeSizes_;
  std::optional<SizeField> field_;
  std::vector<Diagnostic> diagnostics_;
  Job<> job_{[this](Work& work) { return makeField(work); }};  ///< last: uses the others
};

/// Returns the length of an edge in the metric of the target sizes, length / target length: an integral by Simpson's
/// rule.
[[nodiscard]] double metricLength(const SizeField& field, const Vec3& a, const Vec3& b,
                                  FieldHint& hint);

/// Returns the same if the target size at `position` held along the whole edge.
[[nodiscard]] double metricLengthAt(const SizeField& field, const Vec3& position, const Vec3& edge,
                                    FieldHint& hint);

}  // namespace tetrafront
