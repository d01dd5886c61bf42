#pragma once

/// @file Writes the sweeps of the optimizer as the events of a trace, described in docs/TRACE.md. What a sweep has changed is
/// found by comparison with a copy of the mesh, so that the operations need no hooks.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/trace_bytes.h"
#include "optimize/sweep_observer.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Measures of a mesh, in the metric of the size field.
struct SweepMeasures {
  std::size_t innerNodes = 0;
  std::size_t elements = 0;
  double largestCosine = -1.0;
  double smallestCosine = 1.0;
  double radiusRatios = 0.0;  ///< their sum
  std::uint32_t outOfRange = 0;
};

class SweepRecorder final : public SweepObserver {
 public:
  explicit SweepRecorder(TraceBytes& bytes) : bytes_(bytes) {}

  /// O(nodes + elements), as begunRegion() and swept().
  void begun(const RegionMeshes& meshes, const SizeField& field) override;
  void begunRegion(const TetComplex& mesh) override;
  void swept(Sweep sweep, const TetComplex& mesh) override;
  void kept() override;
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

  /// Numbers in the trace: those of the nodes and elements of all regions before the first sweep, region by region, then those of new
  /// ones. They are used again only for what comes after a mesh without them was restored.
  struct Numbers {
    std::uint32_t nextNode = 0;
    std::uint32_t nextElement = 0;
  };

  [[nodiscard]] Changes changesIn(const TetComplex& mesh) const;
  void copy(const TetComplex& mesh);
  void number(const TetComplex& mesh, Numbers& numbers);
  void writeMeasures();
  void writeFirstMesh(const RegionMeshes& meshes);
  void writeGeometry(const TetComplex& mesh, const Changes& changes);
  void writeIndices(const std::vector<std::uint32_t>& own,
                    const std::vector<std::uint32_t>& numbers);

  TraceBytes& bytes_;
  std::span<const RegionMesh> regions_;
  std::size_t begunRegions_ = 0;
  std::size_t boundaryNodes_ = 0;        ///< of all regions
  std::vector<SweepMeasures> measures_;  ///< per region
  Numbers given_;                        ///< of the next region
  Numbers new_;
  Numbers newWhenKept_;
  SweepMeasures measuresWhenKept_;  ///< of the region
  bool hasGeometry_ = false;
  std::uint32_t sweeps_ = 0;  ///< recorded so far
  std::uint32_t kept_ = 0;    ///< number of the sweep whose mesh is kept
  // The mesh of the region after the last event.
  std::vector<std::uint32_t> nodeNumbers_;
  std::vector<std::uint32_t> elementNumbers_;  ///< per slot
  std::vector<Vec3> positions_;
  std::vector<std::uint8_t> isUsed_;  ///< per node
  std::vector<Corners> elements_;     ///< per slot; without nodes if it is empty
};

[[nodiscard]] std::unique_ptr<SweepObserver> makeSweepRecorder(TraceBytes& bytes);

}  // namespace tetrafront
