#pragma once

/// @file Meshes a closed boundary with tetrahedra: sets up the front from its triangles (step F3),
/// advances it, and recovers what it leaves.

#include <cstdint>
#include <memory>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/front_advance.h"
#include "volume/front_progress.h"
#include "volume/recovery.h"

namespace tetrafront {

template <class Trace>
class BasicVolumeMesher {
 public:
  /// `boundary` must be closed, embedded, oriented outward and have its regions, as closeBoundary()
  /// leaves it, but without interfaces (region_mesher.h). It and `field` must outlive the mesher.
  BasicVolumeMesher(const SurfaceMesh& boundary, const SizeField& field,
                    const MeshOptions& options);

  /// Does work that costs about `budget` steps of the front.
  MeshStatus advance(std::uint32_t budget);

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
    return front_.activeCount() +
           static_cast<std::uint32_t>(boundary_.triangles.size() / 3 - nextTriangle_);
  }
  /// Estimated progress of the front until it closes or stalls, 0 to 1.
  [[nodiscard]] double frontFraction() const;
  /// Returns true when the front has ended, and after recovery too.
  [[nodiscard]] bool isRecovering() const { return stage_ >= Stage::kRecover; }
  /// Faces that the front has left to recovery, per triangle of the boundary; 0 until it ends.
  [[nodiscard]] double openShare() const { return openShare_; }
  /// Estimated progress of recovery and of its exact fill, 0 to 1.
  [[nodiscard]] double recoveryFraction() const { return recovery_.fraction(); }
  [[nodiscard]] double exactFillFraction() const { return recovery_.exactFillFraction(); }

  /// Returns the mesh made so far. Leaves out nodes that neither an element nor a boundary triangle
  /// uses.
  [[nodiscard]] VolumeMesh mesh() const;
  /// Appends the faces of the front, x y z of three corners each. O(front).
  void appendFront(std::vector<double>& corners) const;
  [[nodiscard]] RecoverySummary recovery() const;
  [[nodiscard]] FrontCounters counters() const;
  /// Set it up before the first call of advance().
  [[nodiscard]] Trace& trace() { return advance_.trace(); }

 private:
  enum class Stage : std::uint8_t { kSetUp, kAdvance, kRecover, kFinished };

  void setUp(std::uint32_t budget);
  void advanceFront(std::uint32_t budget);
  void beginRecovery();
  void recover(std::uint32_t budget);
  void measureNewElements();
  void checkNewNodes();
  void stopAtLimit();
  void stall();
  void finish(MeshStatus status);
  /// Share of the enclosed volume that is filled, 0 to 1.
  [[nodiscard]] double filledFraction() const;

  const SurfaceMesh& boundary_;
  const SizeField& field_;
  std::uint32_t maxTetrahedra_;
  Stage stage_ = Stage::kSetUp;
  MeshStatus status_ = MeshStatus::kRunning;
  std::size_t nextTriangle_ = 0;
  Front front_;
  Elements elements_;
  FrontAdvance<Trace> advance_;
  Recovery<Trace> recovery_;
  bool exactFillOnly_;
  std::size_t boundaryNodes_;
  std::size_t checkedNodes_ = 0;
  std::uint64_t frontCost_ = 0;
  FrontProgress progress_;
  double openShare_ = 0.0;
  std::size_t measuredElements_ = 0;
  double enclosedVolume_ = 0.0;  ///< times six
  double filledVolume_ = 0.0;    ///< times six
  /// counted per slice: others may compute signs between two slices
  std::uint64_t exactPredicates_ = 0;
  FieldHint coverHint_;
  std::vector<Diagnostic> diagnostics_;
};

extern template class BasicVolumeMesher<NullTrace>;
extern template class BasicVolumeMesher<ClockTrace>;
extern template class BasicVolumeMesher<RecordingTrace>;

using VolumeMesher = BasicVolumeMesher<NullTrace>;

}  // namespace tetrafront
