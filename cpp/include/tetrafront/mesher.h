#pragma once

/// @file The engine's public calls. A MeshRun is resumable: advance() works for a bounded number
/// of steps and returns, so that the caller can report progress, draw the front, or stop, without
/// threads.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"
#include "tetrafront/options.h"
#include "tetrafront/quality_statistics.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// One run of the chain F1-F9 of Löhner & Parikh 1988, section 2.
class MeshRun {
 public:
  /// Meshes a drawn model: lines, patches, closed boundary, volume.
  MeshRun(Model model, BackgroundGrid grid, const MeshOptions& options);

  /// Fills a given closed surface, which is kept triangle for triangle. `points` holds x y z per
  /// node, `triangles` three node positions per triangle; parts that are inside out as a whole are
  /// turned, single triangles that face inward refused. Sizes come from the surface's own edges
  /// unless options.size is set.
  MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
          const MeshOptions& options);

  /// The same with sizes from a background grid, which must cover the surface: its nodes and
  /// tetrahedra replace the sizes from the surface's own edges unless options.size is set, its
  /// sources cut down whatever sizes there are. A grid without nodes and tetrahedra leaves the
  /// surface its own sizes.
  MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
          BackgroundGrid grid, const MeshOptions& options);

  MeshRun(MeshRun&&) noexcept;
  MeshRun& operator=(MeshRun&&) noexcept;
  ~MeshRun();

  /// Works on. `budget` bounds the work: about that many faces taken from the front, or a
  /// comparable amount in the other phases. Returns kRunning while there is more to do.
  MeshStatus advance(std::uint32_t budget);

  /// Ends the run at once; what exists stays readable.
  void cancel();

  [[nodiscard]] MeshStatus status() const;
  [[nodiscard]] Progress progress() const;
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const;

  /// The boundary, oriented outward; complete from the end of Phase::kSurface on.
  [[nodiscard]] const SurfaceMesh& surface() const;

  /// One summary per patch, in the model's order, from the end of Phase::kSurface on; none for a
  /// given surface.
  [[nodiscard]] const std::vector<PatchSummary>& patchSummaries() const;

  /// A copy of the mesh as it stands, complete or not. O(size of the mesh).
  [[nodiscard]] VolumeMesh volume() const;

  /// A copy of the front, x y z of three corners per active face; empty outside Phase::kVolume.
  /// O(front).
  [[nodiscard]] std::vector<double> front() const;

  /// Of the mesh as it stands after kDone, kStalled or kCancelled.
  [[nodiscard]] QualitySummary quality() const;
  /// Of the finished mesh; empty unless kDone.
  [[nodiscard]] QualityStatistics statistics() const;
  [[nodiscard]] RecoverySummary recovery() const;
  [[nodiscard]] FrontCounters counters() const;

  /// 64-bit hash over coordinates and indices of volume(): equal on every platform for the
  /// same input and options.
  [[nodiscard]] std::uint64_t fingerprint() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a viewer draws of a model before it is meshed.
struct ModelPreview {
  /// Polyline of line l: linePoints[3i..3i+2] for i in lineOffsets[l] .. lineOffsets[l+1]-1.
  std::vector<double> linePoints;
  std::vector<std::uint32_t> lineOffsets;
  /// Triangles of patch p: patchTriangles[3t..3t+2] for t in patchOffsets[p] .. patchOffsets[p+1]-1,
  /// positions in patchPoints (x y z). A patch that cannot be evaluated has none.
  std::vector<double> patchPoints;
  std::vector<std::uint32_t> patchTriangles;
  std::vector<std::uint32_t> patchOffsets;
  /// Everything the model check found, all at once, also about the background grid.
  std::vector<Diagnostic> diagnostics;
};

/// Samples lines and patches coarsely for display and checks the model. Milliseconds for the
/// models people draw; tolerates broken input, which is reported and left out of the picture.
/// `options` are those it will be meshed with: with a uniform size nothing is said about the grid
/// but for its sources.
[[nodiscard]] ModelPreview previewModel(const Model& model, const BackgroundGrid& grid,
                                        const MeshOptions& options = {});

/// previewModel() in slices, so that a preview nobody waits for any more can be given up.
class ModelPreviewer {
 public:
  /// All is copied.
  ModelPreviewer(Model model, BackgroundGrid grid, const MeshOptions& options = {});
  ModelPreviewer(ModelPreviewer&&) noexcept;
  ModelPreviewer& operator=(ModelPreviewer&&) noexcept;
  ~ModelPreviewer();

  /// Works on for about `budget` steps; true when finished.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const ModelPreview& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
