#pragma once

/// @file The sizes that can be achieved in a given surface. Its triangles stay, so elements next to them have about the
/// size of their edges. Inwards, sizes fall from there to the target sizes, or grow to those of a background grid.

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "field/size_field.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Fits the field to a surface, in slices: caps it where the surface is finer than a grid, and raises it where the
/// surface is coarser than the target sizes. Counts the triangles that are much too large for the target sizes.
class AchievableSizes {
 public:
  /// `field` has the target sizes of the same grid and options, and the caps of the surface's regions. All arguments must outlive this.
  AchievableSizes(const SurfaceMesh& surface, const BackgroundGrid& grid,
                  const MeshOptions& options, SizeField& field);

  /// Visits about `budget` triangles, nodes or cells; returns true when the field is complete.
  bool advance(std::uint32_t budget) { return job_.advance(budget); }
  /// 0 to 1.
  [[nodiscard]] double fraction() const { return job_.fraction(); }

  /// When finished: kCoarseSurface, or nothing.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;

 private:
  /// Positions on the surface, and the smallest achievable size at each.
  struct Floor {
    std::vector<Vec3> positions;
    std::vector<double> sizes;
  };

  Task<> fitField(Work& work);
  Task<std::vector<double>> measureEdges(Work& work, const std::vector<Vec3>& points);
  Task<> capField(Work& work, const std::vector<Vec3>& points, const std::vector<double>& lengths);
  Task<> raiseField(Work& work, const std::vector<Vec3>& points,
                    const std::vector<double>& lengths);
  Task<Floor> findFloor(Work& work, const std::vector<Vec3>& points,
                        const std::vector<double>& lengths, double descent);

  void checkTriangle(TriangleId triangle);
  [[nodiscard]] double coarsenessOf(TriangleId triangle);

  const SurfaceMesh& surface_;
  const BackgroundGrid& grid_;
  const MeshOptions& options_;
  SizeField& field_;
  SizeField explicit_;  ///< the target sizes without the surface's own edges; unused with a grid
  bool usesGrid_;
  double minTarget_ = 0.0;  ///< smallest target size
  FieldHint hint_;
  std::uint32_t coarseCount_ = 0;
  TriangleId coarsest_;
  double maxCoarseness_ = 0.0;
  Job<> job_{[this](Work& work) { return fitField(work); }};  ///< last: uses the others
};

}  // namespace tetrafront
