#pragma once

/// @file Meshes a closed boundary with tetrahedra: sets up the front from its triangles (step F3),
/// advances it, and recovers what it leaves.

#include <cstdint>
#include <memory>
#include <vector>

#include "base/task.h"
#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "topology/region_meshes.h"
#include "topology/tet_mesh.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/front_advance.h"
#include "volume/front_watch.h"
#include "volume/recovery.h"

namespace tetrafront {

class VolumeMesher {
 public:
  /// `boundary` must be closed, embedded, oriented outward and have its regions, as closeBoundary()
  /// leaves it, but without interfaces (region_mesher.h). It, `field` and `names`, for a recording, must outlive the mesher.
  VolumeMesher(const SurfaceMesh& boundary, const SizeField& field, const MeshOptions& options,
               const FrontMaker& maker = PlainFrontMaker(), const NodeNames& names = {});

  /// Fills the boundary: the two tasks below. One unit of budget is a step of the front.
  Task<MeshStatus> run(Work& work);
  /// Advances the front until it is closed, or stalls, which is no failure. Returns false if the run has failed.
  Task<bool> advanceFront(Work& work);
  /// Closes what the front has left.
  Task<MeshStatus> recover(Work& work);

  [[nodiscard]] MeshStatus status() const { return status_; }
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  [[nodiscard]] std::uint32_t nodeCount() const {
    return static_cast<std::uint32_t>(front_.nodes().size());
  }
  [[nodiscard]] std::uint32_t tetrahedronCount() const {
    return static_cast<std::uint32_t>(elements_.liveCount());
  }
  /// Includes the triangles that are not in the front yet.
  [[nodiscard]] std::uint32_t frontFaceCount() const {
    return front_.activeCount() + static_cast<std::uint32_t>(triangleCount() - nextTriangle_);
  }
  /// Faces that the front has left to recovery, per triangle of the boundary; 0 until it ends.
  [[nodiscard]] double openShare() const { return openShare_; }
  [[nodiscard]] double exactFillFraction() const { return recovery_.exactFillFraction(); }

  /// Returns the mesh made so far. Leaves out nodes that neither an element nor a boundary triangle
  /// uses.
  [[nodiscard]] TetMesh mesh() const;
  /// The same without a copy; once, as the last call.
  [[nodiscard]] TetMesh take();
  /// Appends the faces of the front, x y z of three corners each. O(front).
  void appendFront(std::vector<double>& corners) const;
  [[nodiscard]] RecoverySummary recovery() const;
  [[nodiscard]] FrontCounters counters() const;

 private:
  [[nodiscard]] std::size_t triangleCount() const { return boundary_.triangles.size() / 3; }
  Task<> setUp(Work& work);
  void addTriangle(std::size_t triangle, const Vec3& origin);
  void end(MeshStatus status);
  [[nodiscard]] TetMesh compacted(std::vector<Vec3> points, std::vector<NodeQuad> tetrahedra,
                                  std::vector<std::uint32_t> regions) const;

  const SurfaceMesh& boundary_;
  const SizeField& field_;
  MeshStatus status_ = MeshStatus::kRunning;
  std::size_t nextTriangle_ = 0;
  Front front_;
  Elements elements_;
  std::unique_ptr<FrontAdvance> advance_;
  FrontWatch watch_;
  Recovery recovery_;
  bool exactFillOnly_;
  std::size_t boundaryNodes_;
  NodeNames names_;
  double openShare_ = 0.0;
  double enclosedVolume_ = 0.0;  ///< times six
  FieldHint coverHint_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace tetrafront
