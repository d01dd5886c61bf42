#pragma once

/// @file The initial front of a drawn model (Löhner & Parikh 1988, section 5): every line divided
/// once, every patch triangulated between its lines' nodes. Patches are watertight because they
/// use the same nodes along the lines they share.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "field/size_field.h"
#include "model/resolved_model.h"
#include "surface/patch_mesher.h"
#include "tetrafront/mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

class SurfaceMesher {
 public:
  /// `model` must have passed diagnoseModel(). Both must outlive this.
  SurfaceMesher(const Model& model, const SizeField& field);
  SurfaceMesher(SurfaceMesher&&) noexcept;
  SurfaceMesher& operator=(SurfaceMesher&&) noexcept;
  ~SurfaceMesher();

  /// Works on: `budget` counts sides taken from the planar fronts or nodes and triangles
  /// improved. kDone; kInvalidInput with diagnostics: a line or patch leaves the background grid,
  /// loops touch, a patch folds over itself, or too many elements are asked for.
  MeshStatus advance(std::uint32_t budget);

  /// Phase::kSides, then Phase::kSurface.
  [[nodiscard]] Phase phase() const;
  /// Of this mesher's own work, 0 to 1.
  [[nodiscard]] double fraction() const;
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const;

  /// Nodes: the end points of lines that patches use, in the model's order; then the inner nodes
  /// of those lines, line by line; then the inner nodes of the patches, patch by patch. Triangles
  /// turn alike within a patch, counter-clockwise in its plane; which way out is, is not known
  /// yet. Complete after kDone.
  [[nodiscard]] const SurfaceMesh& mesh() const;
  [[nodiscard]] SurfaceMesh takeMesh();
  /// Per patch, in the model's order. Complete after kDone.
  [[nodiscard]] const std::vector<PatchSummary>& patchSummaries() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
