#pragma once

/// @file Triangles for a TrimmedModel: divides every edge once, and triangulates every face between the nodes of its
/// edges with the front of a patch (Löhner & Parikh 1988, sections 4 and 5.2), on the surface itself.

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "base/task.h"
#include "field/size_field.h"
#include "model/edge_curve.h"
#include "model/face_loops.h"
#include "surface/divided_lines.h"
#include "surface/patch_mesher.h"
#include "surface/shared_strips.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "tetrafront/trimmed_model.h"

namespace tetrafront {

class TrimmedMesher {
 public:
  /// All references, splines and frames of `model` must be valid, and its positions finite: they are not checked here.
  /// Model and field must outlive this.
  /// Diagnostics quote `maxTetrahedra`. `stations`: parameters per edge at which it must have nodes, ascending from 0 to 1, or none;
  /// empty if no edge has any.
  TrimmedMesher(const TrimmedModel& model, const SizeField& field,
                std::uint32_t maxTetrahedra = MeshOptions{}.maxTetrahedra,
                std::vector<std::vector<double>> stations = {});

  /// Does about `budget` units of work, as SurfaceMesher::advance(). Returns kRunning, kDone, or kInvalidInput if there
  /// are diagnostics. In them, lines are edges and patches are faces.
  MeshStatus advance(std::uint32_t budget);

  [[nodiscard]] Phase phase() const { return phase_; }
  [[nodiscard]] double fraction() const { return job_.fraction(); }
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

  /// The surface; complete after kDone. Nodes are in this order: vertices that edges of faces use, in the order of the
  /// model; inner nodes of these edges, edge by edge; inner nodes of the faces, face by face. Triangles are
  /// counter-clockwise seen from outside the solid behind their face; their patch is the index of the face.
  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }
  [[nodiscard]] SurfaceMesh takeMesh() { return std::move(mesh_); }
  /// The divided edges; complete after kDone.
  [[nodiscard]] const DividedLines& lines() const { return lines_; }

 private:
  /// The inner nodes and the triangles of one face. Inner nodes have the ids that follow those of all edges.
  struct Triangulation {
    std::vector<Vec3> nodes;
    std::vector<NodeTriple> triangles;
    std::vector<Chord> chords;
  };

  Task<> meshSurface(Work& work);
  Task<> divideEdges(Work& work);
  Task<> divideEachEdge(Work& work);
  Task<> makeLoopsSimple(Work& work);
  Task<> meshFaces(Work& work);
  Task<> meshFace(Work& work, PatchId face);

  void findUsedEdges();
  void findMinSides();
  [[nodiscard]] LineDivision divisionOf(LineId edge) const;
  bool addSourcesAtBentEdges();
  void numberNodes();
  void writeEdges();
  void layOutFaces();
  [[nodiscard]] PatchBoundary separatedBoundary(PatchId face, const SizeField& field) const;
  void checkLoops(PatchId face, bool canHalve, std::set<LineSide>& halvings);
  void take(PatchId face, const PlanarMesh& planar);
  [[nodiscard]] std::vector<PatchId> findFacesToSeparate();
  void append(PatchId face);
  [[nodiscard]] Diagnostic tooManySides(double sides) const;
  [[nodiscard]] EdgeCurve curveOf(LineId edge) const {
    return {*model_, model_->edges[edge.index()]};
  }

  const TrimmedModel* model_;
  const SizeField* field_;
  std::uint32_t maxTetrahedra_;
  std::vector<std::vector<double>> stations_;
  std::optional<SizeField>
      gradedField_;                      ///< the field with sizes that grow from bent edges, if any
  std::vector<std::uint8_t> isUsed_;     ///< per edge: it has a curve, and a face uses it
  std::vector<std::uint32_t> minSides_;  ///< per edge
  std::vector<std::uint32_t> vertices_;  ///< vertices that are nodes, ascending
  DividedLines lines_;                   ///< lines are edges
  std::vector<FaceLoops> loops_;         ///< per face
  std::vector<FacePlane> planes_;        ///< per face
  std::vector<Triangulation> triangulations_;  ///< per face
  std::vector<std::vector<NodeId>>
      separated_;  ///< per face: nodes no interior edge connects, ascending
  Phase phase_ = Phase::kSides;
  SurfaceMesh mesh_;
  std::vector<Diagnostic> diagnostics_;
  Job<> job_{[this](Work& work) { return meshSurface(work); }};  ///< last: uses the others
};

}  // namespace tetrafront
