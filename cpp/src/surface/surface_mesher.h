#pragma once

/// @file The initial front of a drawn model (Löhner & Parikh 1988, section 5): divides every line once, and
/// triangulates every patch between the nodes of its lines.

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "base/task.h"
#include "field/size_field.h"
#include "model/resolved_model.h"
#include "surface/divided_lines.h"
#include "surface/patch_mesher.h"
#include "surface/shared_strips.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

template <class Trace>
class BasicSurfaceMesher {
 public:
  /// `model` must have passed diagnoseModel(). Model and field must outlive this. Diagnostics quote `maxTetrahedra`.
  BasicSurfaceMesher(const Model& model, const SizeField& field,
                     std::uint32_t maxTetrahedra = MeshOptions{}.maxTetrahedra, Trace trace = {});

  /// Does `budget` units of work: one unit is an edge taken from a planar front, or a node or triangle improved.
  /// Returns kRunning, kDone, or kInvalidInput if there are diagnostics: a line or a patch leaves the background
  /// grid, loops intersect, a patch folds over itself, or the sizes require too many elements.
  MeshStatus advance(std::uint32_t budget);

  /// Phase::kSides, then Phase::kSurface.
  [[nodiscard]] Phase phase() const { return phase_; }
  /// Progress of this mesher, 0 to 1.
  [[nodiscard]] double fraction() const { return job_.fraction(); }
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

  /// The surface; complete after kDone. Nodes are in this order: the end points of lines that patches use, in the
  /// order of the model; the inner nodes of these lines, line by line; the interior nodes of the patches, patch by
  /// patch. All triangles of a patch are counter-clockwise in its plane; which side of a patch is outward is not yet
  /// known.
  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }
  [[nodiscard]] SurfaceMesh takeMesh() { return std::move(mesh_); }
  /// Per patch, in the order of the model. Complete after kDone.
  [[nodiscard]] const std::vector<PatchSummary>& patchSummaries() const { return summaries_; }

 private:
  /// The own nodes and the triangles of one patch. Its own nodes, those of its seam first, have the ids that follow
  /// those of the nodes of all lines.
  struct Triangulation {
    std::vector<Vec3> nodes;
    std::vector<NodeTriple> triangles;
    std::vector<Chord> chords;
  };

  Task<> meshSurface(Work& work);
  Task<> divideLines(Work& work);
  Task<> divideEachLine(Work& work);
  Task<> makeLoopsSimple(Work& work);
  Task<> meshPatches(Work& work);
  Task<> meshPatch(Work& work, PatchId patch, bool isRepeated);
  Task<> appendPatches(Work& work);

  void reportLine(LineId line, const LineDivision& division);
  bool addSources(const std::vector<SizeSource>& sources);
  [[nodiscard]] PatchBoundary layOut(PatchId patch) const;
  std::size_t checkLoops(PatchId patch, bool canHalve, std::set<LineSide>& halvings);
  bool gatherHalvings(PatchId patch, const PatchBoundary& boundary,
                      const std::vector<std::uint32_t>& invalid,
                      std::set<LineSide>& halvings) const;
  void reportLoops(PatchId patch, const PatchBoundary& boundary,
                   const std::vector<std::uint32_t>& invalid);
  void takePatch(PatchId patch, const PlanarMesh& planar, const std::vector<Vec3>& seam);
  void reportPatch(PatchId patch, const BasicPatchMesher<Trace>& mesher);
  [[nodiscard]] std::vector<PatchId> findPatchesToSeparate();
  void append(PatchId patch);
  [[nodiscard]] Diagnostic tooManySides(double sides) const;

  ResolvedModel model_;
  const SizeField* field_;
  std::uint32_t maxTetrahedra_;
  std::optional<SizeField>
      gradedField_;  ///< the field with sizes that grow from short lines and narrow tubes, if any
  LineDivider lines_;
  std::vector<PatchSurface> surfaces_;          ///< per patch
  std::vector<Triangulation> triangulations_;   ///< per patch
  std::vector<std::vector<NodeId>> separated_;  ///< per patch: see findNodesToSeparate()
  std::uint32_t lineNodes_ = 0;                 ///< nodes of all lines; they come first in the mesh
  Phase phase_ = Phase::kSides;
  SurfaceMesh mesh_;
  std::vector<PatchSummary> summaries_;
  std::vector<Diagnostic> diagnostics_;
  [[no_unique_address]] Trace trace_;
  Job<> job_{[this](Work& work) { return meshSurface(work); }};  ///< last: uses the others
};

extern template class BasicSurfaceMesher<NullSurfaceTrace>;
extern template class BasicSurfaceMesher<RecordingSurfaceTrace>;

using SurfaceMesher = BasicSurfaceMesher<NullSurfaceTrace>;

}  // namespace tetrafront
