#pragma once

/// @file Writes the sweeps of the optimizer as the events of a trace, described in docs/TRACE.md. What a sweep has changed is
/// found by comparison with a copy of the mesh, so that the operations need no hooks.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/ids.h"
#include "base/trace_bytes.h"
#include "optimize/sweep_observer.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class SweepRecorder final : public SweepObserver {
 public:
  explicit SweepRecorder(TraceBytes& bytes) : bytes_(bytes) {}

  /// O(nodes + elements), as swept().
  void begun(const TetComplex& mesh) override;
  void swept(Sweep sweep, const TetComplex& mesh) override;
  void kept() override { kept_ = sweeps_; }
  void restored() override;

 private:
  /// What a sweep has changed, ascending.
  struct Changes {
    std::vector<std::uint32_t> movedNodes;
    std::uint32_t addedNodes = 0;
    std::uint32_t droppedNodes = 0;
    std::vector<std::uint32_t> made;     ///< elements
    std::vector<std::uint32_t> removed;  ///< slots that are empty now
  };

  [[nodiscard]] Changes changesIn(const TetComplex& mesh) const;
  void copy(const TetComplex& mesh);
  void writeMeasures(const TetComplex& mesh);
  void writeGeometry(const TetComplex& mesh, const Changes& changes);
  void writeElements(const TetComplex& mesh, const std::vector<std::uint32_t>& slots);

  TraceBytes& bytes_;
  bool hasGeometry_ = false;
  std::uint32_t sweeps_ = 0;  ///< recorded so far
  std::uint32_t kept_ = 0;    ///< number of the sweep whose mesh is kept
  /// The mesh after the last event.
  std::vector<Vec3> positions_;
  std::vector<std::uint8_t> isUsed_;  ///< per node
  std::vector<Corners> elements_;     ///< per slot; without nodes if it is empty
};

[[nodiscard]] std::unique_ptr<SweepObserver> makeSweepRecorder(TraceBytes& bytes);

}  // namespace tetrafront
