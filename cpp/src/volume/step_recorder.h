#pragma once

/// @file Writes the steps of the front as the events of a trace, described in docs/TRACE.md: a few bytes per step, in the
/// order in which they happen. Recovery changes the front in many ways; what it has changed is found by comparison with a
/// copy of the front, so that recovery itself needs no hooks for single faces.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/trace_bytes.h"
#include "tetrafront/vec3.h"
#include "topology/region_meshes.h"
#include "volume/candidates.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/ideal_point.h"
#include "volume/unit_space.h"

namespace tetrafront {

/// Reason for refusing a candidate.
enum class Refusal : std::uint8_t {
  kBehind = 0,          ///< the candidate is not on the empty side of the base face
  kCrosses = 1,         ///< the element would cross a face
  kTooCloseToFace = 2,  ///< a new node would be too close to a face
};

/// What a step of recovery has done.
enum class FrontChange : std::uint8_t {
  kStar = 0,       ///< a pocket was joined to one point
  kReopened = 1,   ///< elements around a pocket were removed
  kClosed = 2,     ///< the pocket closed again
  kUndone = 3,     ///< it did not, and is as it was before
  kExactFill = 4,  ///< a pocket was filled exactly
};

/// How many events of each kind were written.
struct StepCounts {
  std::uint64_t steps = 0;  ///< base faces, and changes by recovery
  std::uint64_t accepted = 0;
  std::array<std::uint64_t, 3> refused{};  ///< by Refusal
  std::uint64_t postponed = 0;
};

class StepRecorder {
 public:
  /// A front begins; its faces are those of the boundary. Nodes are written by their names, which must outlive the pass.
  void beginPass(const Front& front, const NodeNames& names = {});
  /// Step F4 and F5 for a base face, after its candidates were ranked.
  void base(const Front& front, FaceId face, const UnitSpace& space, const Vec3& ideal,
            std::size_t facesNear, std::size_t candidates);
  /// `position`: of a candidate without a node. `culprit`: the face that it crosses or is too close to.
  void refused(const Front& front, NodeId node, const Vec3& position, const Candidate& candidate,
               Refusal why, FaceId culprit);
  /// Call it after the front has changed. `nodes`: of the base face; `existing`: per corner, the face that left the front, or
  /// none; `added`: the face that joined it instead.
  void accepted(const Front& front, const NodeTriple& nodes, NodeId apex,
                const Candidate& candidate, const std::array<FaceId, 3>& existing,
                const std::array<FaceId, 3>& added, std::uint32_t region);
  /// `next`: the rule class of the next attempt, or kNoNextClass.
  void postponed(std::uint32_t next);
  static constexpr std::uint32_t kNoNextClass = 31;
  /// Recovery has changed the front and the elements. O(front + elements).
  void changed(const Front& front, const Elements& elements, FrontChange what);
  /// Does nothing between two fronts: a run may be cancelled there.
  void endPass();

  /// Where the events are written, for those of lines and patches before them.
  [[nodiscard]] TraceBytes& bytes() { return bytes_; }
  /// Returns the events since the last call.
  std::vector<std::uint8_t> takeEvents() { return bytes_.take(); }
  [[nodiscard]] const StepCounts& counts() const { return counts_; }

 private:
  /// The state of the front and of the elements after the last event.
  struct Face {
    NodeTriple nodes;
    std::uint32_t region = 0;
    bool isActive = false;
  };

  void writeScore(const Candidate& candidate);
  void setFace(FaceId slot, const NodeTriple& nodes, std::uint32_t region);
  void removeFace(FaceId slot) { faces_[slot.index()].isActive = false; }
  [[nodiscard]] bool isSame(const Front& front, std::size_t slot) const;
  void writeNodes(const Front& front);
  void writeLeavingFaces(const Front& front);
  void writeElements(const Elements& elements);
  void writeJoiningFaces(const Front& front);
  template <class Nodes>
  void writeCorners(const Nodes& nodes, std::uint32_t& before);

  TraceBytes bytes_;
  StepCounts counts_;
  bool isInPass_ = false;
  bool isRemeshing_ = false;
  FaceId base_;
  NodeNames names_;
  NodeId firstNode_;  ///< of the base face
  FaceId baseBefore_{0U};
  std::vector<Vec3> nodes_;
  std::vector<Face> faces_;
  std::vector<NodeQuad> elements_;
  std::vector<std::uint8_t> removed_;
};

}  // namespace tetrafront
