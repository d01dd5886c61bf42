#pragma once

/// @file What of the sizes wanted in a given surface can be had: its triangles stay, and elements
/// beside them are neither smaller nor larger; from there inwards sizes fall, or grow to those of a
/// grid, step by step. Triangles that are too large for what is wanted are counted.

#include <cstdint>
#include <optional>
#include <vector>

#include "field/size_field.h"
#include "field/size_octree_builder.h"
#include "field/size_sites.h"
#include "field/size_tensor.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Looks at a surface in slices; cuts the field where the surface is finer than a grid, and lifts it where
/// it is coarser than what is wanted.
class AchievableSizes {
 public:
  /// `field` has the sizes wanted there by the same grid and options. All must outlive this.
  AchievableSizes(const SurfaceMesh& surface, const BackgroundGrid& grid,
                  const MeshOptions& options, SizeField& field);

  /// Works on for about `budget` triangles or cells; true when the field is fit.
  bool advance(std::uint32_t budget);

  /// kCoarseSurface, or nothing.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;

 private:
  enum class Stage : std::uint8_t { kLook, kView, kMeasure, kCeiling, kGiveWay, kFloor, kDone };

  void look(std::uint32_t triangle);
  /// How many wanted elements the triangle's edges are long, at most.
  [[nodiscard]] double coarsenessOf(std::uint32_t triangle);
  void viewSome(std::uint32_t budget);
  void startCeiling();
  [[nodiscard]] bool startFloor();
  [[nodiscard]] bool giveWay(std::uint32_t budget);

  const SurfaceMesh& surface_;
  const BackgroundGrid& grid_;
  const MeshOptions& options_;
  SizeField& field_;
  SizeField asked_;  ///< what is asked for but for the surface's own sizes; empty if that is field_
  bool usesGrid_;
  double least_ = 0.0;  ///< nobody asks for less
  FieldHint hint_;
  std::uint32_t next_ = 0;
  std::uint32_t coarse_ = 0;
  std::uint32_t coarsest_ = 0;
  double coarseness_ = 0.0;
  Stage stage_;
  std::vector<Vec3> points_;
  std::vector<SymmetricTensor> views_;
  std::vector<double> lengths_;  ///< of edges, at each point
  double descent_ = 0.0;         ///< of sizes, per unit of distance from the surface
  std::optional<SizeSites> shortest_;
  std::uint32_t nearest_ = 0;  ///< site of the last place
  std::vector<Vec3> places_;   ///< nodes and middles of triangles
  std::vector<double> held_;   ///< the sizes there that the surface allows
  std::optional<SizeOctreeBuilder> builder_;
};

}  // namespace tetrafront
