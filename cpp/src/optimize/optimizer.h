#pragma once

/// @file Makes a valid mesh a good one: swaps, moves, splits and collapses in sweeps over the whole
/// mesh, then improves the elements that still miss their target angles. Shapes are measured in the
/// metric of the size field. The boundary does not change, and every change keeps the volume of
/// every element positive.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "base/task.h"
#include "field/size_field.h"
#include "optimize/element_cost.h"
#include "tetrafront/options.h"
#include "topology/tet_mesh.h"

namespace tetrafront {

struct Step;
class SweepObserver;
class TileRunner;

/// What a given mesh must keep. By default nothing.
struct MeshLimits {
  ElementLimits ofElements;
  /// No change makes more elements, unless it improves a poor one.
  std::size_t elements = std::numeric_limits<std::size_t>::max();
  /// No change at all makes more elements.
  std::size_t elementsWithRepairs = std::numeric_limits<std::size_t>::max();
};

class MeshOptimizer {
 public:
  /// Fixed nodes stay where they are; those of the boundary must be fixed. The field must outlive this; if it has sizes of regions, the mesh must be that of
  /// one region. O(n) per sweep.
  MeshOptimizer(TetMesh mesh, const SizeField& field, Optimization level,
                const MeshLimits& limits = {});
  /// The same with the steps of cautiousSchedule().
  static MeshOptimizer cautious(TetMesh mesh, const SizeField& field, const MeshLimits& limits);
  /// The same with the steps that change shapes everywhere, or with all, those in tiles if the mesh is large. The runner must outlive this.
  static MeshOptimizer shapes(TetMesh mesh, const SizeField& field, Optimization level);
  static MeshOptimizer inTiles(TetMesh mesh, const SizeField& field, Optimization level,
                               TileRunner& runner);
  MeshOptimizer(MeshOptimizer&&) noexcept;
  MeshOptimizer& operator=(MeshOptimizer&&) noexcept;
  ~MeshOptimizer();

  /// Reports the sweeps to an observer, which must outlive this. Call it before run().
  void observe(SweepObserver& observer);

  /// Executes the schedule; once. This must outlive the task and must not move meanwhile.
  Task<> run(Work& work);

  /// Number of nodes that are not fixed.
  [[nodiscard]] std::size_t innerNodeCount() const;
  [[nodiscard]] std::size_t tetrahedronCount() const;

  /// The current mesh, always valid. Boundary nodes come first, in their order.
  [[nodiscard]] TetMesh mesh() const;
  /// The same with fewer copies. Afterwards only hasFoundNothingBetter() and hasRefusedGrowth() may be called.
  [[nodiscard]] TetMesh take();

  /// True if Optimization::kThorough is finished and found no better mesh: mesh() is that of Optimization::kDefault.
  [[nodiscard]] bool hasFoundNothingBetter() const;
  /// Whether a change was refused because it would have made too many elements.
  [[nodiscard]] bool hasRefusedGrowth() const;

 private:
  /// The optimizer in the metric space of the field. Its hot loops are compiled for each of the two: plain, and stretched.
  class AnySpace;
  template <class Space>
  class InSpace;
  class InTiles;
  explicit MeshOptimizer(std::unique_ptr<AnySpace> optimizer);
  static std::unique_ptr<AnySpace> make(TetMesh mesh, const SizeField& field,
                                        std::vector<Step> schedule, const MeshLimits& limits);

  std::unique_ptr<AnySpace> optimizer_;
};

}  // namespace tetrafront
