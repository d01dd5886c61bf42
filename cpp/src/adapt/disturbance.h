#pragma once

/// @file Disturbances: where no single change improves the last poor elements, changes that make the mesh worse at first, and are
/// kept if improvements around them lower the badness in the end.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "adapt/cavity.h"
#include "adapt/local_improvement.h"
#include "adapt/poor_list.h"
#include "base/task.h"

namespace tetrafront {

class Disturbance {
 public:
  /// All must outlive this. When `isStopped` becomes true, the work ends soon.
  Disturbance(AdaptMesh& mesh, Badness& badness, LocalImprovement& improvement,
              const bool& isStopped)
      : mesh_(mesh), badness_(badness), improvement_(improvement), isStopped_(isStopped) {}

  /// Disturbs the mesh at each element far below the floor, and keeps each change that lowers the badness. To be called once.
  Task<> run(Work& work);

 private:
  /// A change of an edge, whatever it costs.
  enum class Kind : std::uint8_t { kSplit, kCollapse, kRemove };

  /// Metric lengths of an edge before and after a change; 0 if it is not there.
  struct Change {
    double before = 0.0;
    double after = 0.0;
  };

  bool disturb(Kind kind, NodeId a, NodeId b, TetId id);
  void settle(std::uint32_t since);
  void settleInSteps(std::uint32_t since);
  bool disturbAndSettle(Kind kind, const TetEdge& edge, TetId id);
  Task<bool> tryElement(Work& work, TetId id);
  [[nodiscard]] bool wasTried(const PoorElement& poor) const;
  [[nodiscard]] double gain();

  AdaptMesh& mesh_;
  Badness& badness_;
  LocalImprovement& improvement_;
  const bool& isStopped_;
  AdaptMesh::State state_;  ///< the best so far
  EdgeMap<Change> changes_;
  std::vector<PoorElement> failed_;
  std::size_t triesLeft_ = 0;
};

}  // namespace tetrafront
