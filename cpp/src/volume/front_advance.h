#pragma once

/// @file Steps F4 to F9 (Löhner & Parikh 1988, section 2): for one base face after the other, pick it, place the ideal point,
/// rank the candidates, take the first whose element crosses nothing, update the front; until the front is empty.

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "field/size_field.h"
#include "volume/candidates.h"
#include "volume/crossing.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/front_watch.h"
#include "volume/ideal_point.h"
#include "volume/neighbourhood.h"
#include "volume/rules.h"
#include "volume/trace.h"

namespace tetrafront {

/// The steps, whether they are recorded or not. A virtual call costs nothing here, because each makes many steps.
class FrontAdvance {
 public:
  struct Counters {
    std::uint64_t pops = 0;
    std::uint64_t gatheredFaces = 0;
    std::uint64_t candidatesTried = 0;
    std::uint64_t comparedFaces = 0;    ///< found by linear searches; only in experiments
    std::uint64_t relaxed = 0;          ///< elements made under a class other than the strict one
    std::uint64_t relaxedCost = 0;      ///< cost of the steps under such classes
    std::uint64_t facesTested = 0;      ///< as in FrontCounters
    std::uint64_t facesAnalysed = 0;    ///< as in FrontCounters
    std::uint64_t exactPredicates = 0;  ///< signs that needed exact arithmetic
  };

  FrontAdvance() = default;
  FrontAdvance(const FrontAdvance&) = delete;
  FrontAdvance& operator=(const FrontAdvance&) = delete;
  virtual ~FrontAdvance() = default;

  /// Makes steps until they have cost `budget`, the queue is empty, or the watch ends the front. Returns the cost: 1 per step
  /// if triangles are well shaped, more if a face has many others near it.
  virtual std::uint64_t advance(std::uint64_t budget, FrontWatch& watch) = 0;
  /// The same for recovery, with other rules and without a watch.
  virtual std::uint64_t refill(std::uint64_t budget, const RuleVariant& variant) = 0;
  [[nodiscard]] virtual Counters counters() const = 0;

  /// Records the front as it begins. What `names` refers to must outlive this.
  virtual void recordBegin(const NodeNames& names) = 0;
  /// Records what recovery has changed. O(front + elements) if this records, else nothing.
  virtual void recordChange(FrontChange what) = 0;
  virtual void recordEnd() = 0;
};

template <class Trace>
class TracedFrontAdvance final : public FrontAdvance {
 public:
  /// For `filters`, see CrossingTest. What is referred to must outlive this.
  TracedFrontAdvance(Front& front, Elements& elements, const SizeField& field, bool filters,
                     Trace trace = Trace())
      : front_(front),
        elements_(elements),
        field_(field),
        crossing_(around_, filters),
        trace_(std::move(trace)) {}

  std::uint64_t advance(std::uint64_t budget, FrontWatch& watch) override;
  std::uint64_t refill(std::uint64_t budget, const RuleVariant& variant) override;
  [[nodiscard]] Counters counters() const override;
  void recordBegin(const NodeNames& names) override { trace_.beginPass(front_, names); }
  void recordChange(FrontChange what) override { trace_.changed(front_, elements_, what); }
  void recordEnd() override { trace_.endPass(); }

  /// Takes the next base face and completes it. If this fails, requeues the face under the next
  /// rule class, or sets it aside after the last one. Without `mayRelax`, the strict class is the
  /// last. The front must have a face in its queue. Returns the cost.
  std::uint32_t step(bool mayRelax = true);

  [[nodiscard]] const Trace& trace() const { return trace_; }

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
  NodeId addNode(const FrontFace& base, const Vec3& position);
  std::array<FaceId, 3> accept(const FrontFace& base, FaceId face, NodeId apex,
                               const ExistingFaces& existing);

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

extern template class TracedFrontAdvance<NullTrace>;
extern template class TracedFrontAdvance<ClockTrace>;
extern template class TracedFrontAdvance<RecordingTrace>;

/// Makes the steps of a front.
class FrontMaker {
 public:
  FrontMaker() = default;
  FrontMaker(const FrontMaker&) = delete;
  FrontMaker& operator=(const FrontMaker&) = delete;
  virtual ~FrontMaker() = default;
  /// What is referred to must outlive the result.
  [[nodiscard]] virtual std::unique_ptr<FrontAdvance> make(Front& front, Elements& elements,
                                                           const SizeField& field,
                                                           bool filters) const = 0;
};

/// Makes steps that record nothing and have the usual rules.
class PlainFrontMaker final : public FrontMaker {
 public:
  [[nodiscard]] std::unique_ptr<FrontAdvance> make(Front& front, Elements& elements,
                                                   const SizeField& field,
                                                   bool filters) const override;
};

}  // namespace tetrafront
