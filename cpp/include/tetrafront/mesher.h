#pragma once

/// @file Meshes a drawn model or a given surface. A MeshRun is resumable: advance() does a bounded amount of work and
/// returns, so that the caller can report progress, draw the front or cancel, without threads.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/experiment.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"
#include "tetrafront/options.h"
#include "tetrafront/quality_statistics.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// One run of the steps F1-F9 of Löhner & Parikh 1988, section 2.
class MeshRun {
 public:
  /// Meshes a drawn model: lines, patches, closed boundary, volume.
  MeshRun(Model model, BackgroundGrid grid, const MeshOptions& options);

  /// Meshes a drawn model and bodies together: they may be disjoint or nested, but must not intersect. The patches of the
  /// bodies follow those of the model. A model without patches is left out: the bodies are then meshed as a given
  /// surface. Sizes are those of a given surface, in the triangles of the drawn patches and of the bodies; drawn patches
  /// need a size or a background grid.
  MeshRun(Model model, BodySurfaces bodies, BackgroundGrid grid, const MeshOptions& options);

  /// Meshes the inside of a given closed surface and keeps all of its triangles. `points` holds x y z per node,
  /// `triangles` three node indices per triangle. A component that faces inward as a whole is flipped; single
  /// triangles that face inward are errors. Sizes follow from the surface's own edges, unless options.size is set.
  MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
          const MeshOptions& options);

  /// The same with a background grid that covers the surface. Its nodes and tetrahedra replace the sizes of the
  /// surface's own edges, unless options.size is set; its sources cap all sizes. A grid without nodes and tetrahedra
  /// leaves the sizes of the edges.
  MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
          BackgroundGrid grid, const MeshOptions& options);

  /// The same with known regions, which replace MeshOptions::innerShells. kInconsistentRegions if the regions of two
  /// triangles contradict each other.
  MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
          GivenRegions regions, BackgroundGrid grid, const MeshOptions& options);

  MeshRun(MeshRun&&) noexcept;
  MeshRun& operator=(MeshRun&&) noexcept;
  ~MeshRun();

  /// Does about `budget` units of work and returns the status; kRunning means that work remains. One unit is one face
  /// taken from the front, or comparable work in another phase.
  MeshStatus advance(std::uint32_t budget);

  /// Ends the run immediately. The mesh made so far can still be read.
  void cancel();

  /// Lets a run that has not begun end as soon as its front could start: with kDone, without elements.
  void endBeforeFront();

  [[nodiscard]] MeshStatus status() const;
  [[nodiscard]] Progress progress() const;
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const;

  /// The boundary, oriented outward. Complete after Phase::kSurface.
  [[nodiscard]] const SurfaceMesh& surface() const;

  /// One summary per patch, in the order of the model and of the bodies. Complete after Phase::kSurface; empty for a
  /// given surface.
  [[nodiscard]] const std::vector<PatchSummary>& patchSummaries() const;

  /// Returns the mesh, complete or not. While the run works, each call copies it, O(n) for n elements; the next call of
  /// advance() or volume() replaces this copy. After its end, the first call makes the arrays of lattices.
  [[nodiscard]] const VolumeMesh& volume() const;

  /// Returns the number of nodes, or of tetrahedra, of volume(), without making its arrays. After the end of the run.
  [[nodiscard]] std::uint32_t nodeCount() const;
  [[nodiscard]] std::uint32_t tetrahedronCount() const;
  /// Return a part of the arrays of volume() without making the others, after the end of the run: of the nodes, or the
  /// tetrahedra, [first, last), or up to their end. O(last - first). Lattices then take no memory for their tetrahedra.
  [[nodiscard]] std::vector<double> points(std::uint32_t first, std::uint32_t last) const;
  [[nodiscard]] std::vector<std::uint32_t> tetrahedra(std::uint32_t first,
                                                      std::uint32_t last) const;
  /// Returns the regions of all tetrahedra in order, in runs: twice a region and its number of tetrahedra. O(n), without arrays.
  [[nodiscard]] std::vector<std::uint32_t> regionRuns() const;

  /// Returns a copy of the front: x y z of three corners per active face. Empty outside Phase::kVolume. O(n) for
  /// n faces.
  [[nodiscard]] std::vector<double> front() const;

  /// Quality of the mesh after kDone, kStalled or kCancelled.
  [[nodiscard]] QualitySummary quality() const;
  /// Statistics of the complete mesh; empty unless kDone.
  [[nodiscard]] QualityStatistics statistics() const;
  /// Shapes of the elements of the complete mesh; empty unless kDone, and without stretching.
  [[nodiscard]] MetricShapes metricShapes() const;
  [[nodiscard]] RecoverySummary recovery() const;
  [[nodiscard]] FrontCounters counters() const;

  /// Returns how many tetrahedra come from lattices (Interior::kLattice), of which the optimizer may change those at their hulls.
  [[nodiscard]] std::uint32_t latticeCount() const;

  /// True if Optimization::kThorough found no better mesh than Optimization::kDefault, which is the result then.
  [[nodiscard]] bool hasFoundNothingBetter() const;

  /// 64-bit hash of the coordinates and indices of volume(): equal on all platforms for equal input and options.
  [[nodiscard]] std::uint64_t fingerprint() const;

  /// Returns the events recorded since the last call, for a run that records them (trace.h); else nothing.
  [[nodiscard]] std::vector<std::uint8_t> takeTrace();
  /// Number of steps recorded so far: base faces, and changes by recovery.
  [[nodiscard]] std::uint64_t recordedSteps() const;
  /// The fingerprint of the mesh that the front and its recovery have made, before its optimization; 0 unless the run
  /// records its steps and Phase::kVolume is over.
  [[nodiscard]] std::uint64_t frontFingerprint() const;

 private:
  class Impl;
  friend void recordFront(MeshRun& run, const FrontExperiment& experiment);
  friend void useThreads(MeshRun& run, unsigned count);
  friend class TileHost;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
