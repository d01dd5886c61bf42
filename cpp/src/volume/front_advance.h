#pragma once

/// @file Steps F4 to F8 (Löhner & Parikh 1988, section 2) for one base face at a time: pick it, place
/// the ideal point, rank the candidates, take the first whose element crosses nothing, update the front.

#include <array>
#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "volume/candidates.h"
#include "volume/crossing.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/ideal_point.h"
#include "volume/neighbourhood.h"
#include "volume/rules.h"
#include "volume/trace.h"

namespace tetrafront {

template <class Trace>
class FrontAdvance {
 public:
  struct Counters {
    std::uint64_t pops = 0;
    std::uint64_t gatheredFaces = 0;
    std::uint64_t candidatesTried = 0;
    std::uint64_t comparedFaces = 0;  ///< found by linear searches; only in experiments
    std::uint64_t relaxed = 0;        ///< elements made under a class other than the strict one
    std::uint64_t relaxedCost = 0;  ///< cost of the steps under such classes, as step() returns it
  };

  /// For `filters`, see CrossingTest.
  FrontAdvance(Front& front, Elements& elements, const SizeField& field, bool filters)
      : front_(front), elements_(elements), field_(field), crossing_(around_, filters) {}

  /// Takes the next base face and completes it. If this fails, requeues the face under the next
  /// rule class, or sets it aside after the last one. Without `mayRelax`, the strict class is the
  /// last. The front must have a face in its queue. Returns the cost: 1 if triangles are well
  /// shaped, more if a face has many others near it.
  std::uint32_t step(bool mayRelax = true);

  void setVariant(const RuleVariant& variant) { variant_ = variant; }

  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] const CrossingTest::Counters& crossingCounters() const {
    return crossing_.counters();
  }
  [[nodiscard]] Trace& trace() { return trace_; }
  /// Passes what recovery has changed to the trace. O(front + elements) if it records, else nothing.
  void recordChange(FrontChange what) {
    if constexpr (Trace::kOn) trace_.recorder->changed(front_, elements_, what);
    static_cast<void>(what);
  }

 private:
  using CrossingScope = typename Trace::CrossingScope;
  /// Per base corner: the face of the front that already is the element's face opposite it, or
  /// none.
  using ExistingFaces = std::array<FaceId, 3>;

  bool complete(FaceId face);
  void postpone(FaceId face, bool mayRelax);
  void gatherAround(const NodeTriple& nodes, const UnitSpace& space, const BaseFace& base,
                    const IdealPoint& ideal, const RuleClass& rules);
  bool tryCandidate(FaceId face, const Candidate& candidate, const UnitSpace& space,
                    double minFaceDistance);
  [[nodiscard]] std::uint64_t facesVisited() const {
    return counters_.gatheredFaces + facesMasked_;
  }
  [[nodiscard]] FaceId firstCrossedFace(LocalNode apex);
  [[nodiscard]] bool isTooCloseToFace(const Vec3& position, double distance, FaceId& culprit);
  [[nodiscard]] ExistingFaces findExistingFaces(LocalNode apex) const;
  /// Returns the faces that join the front, each where there was no existing one.
  std::array<FaceId, 3> accept(FaceId face, NodeId apex, const ExistingFaces& existing);

  Front& front_;
  Elements& elements_;
  const SizeField& field_;
  RuleVariant variant_;
  Neighbourhood around_;
  CrossingTest crossing_;
  EdgeNeighbours neighbours_;
  CandidateList candidates_;
  Counters counters_;
  std::uint64_t facesMasked_ = 0;  ///< per candidate tried: all gathered faces, tested or not
  [[no_unique_address]] Trace trace_;
};

extern template class FrontAdvance<NullTrace>;
extern template class FrontAdvance<ClockTrace>;
extern template class FrontAdvance<RecordingTrace>;

}  // namespace tetrafront
