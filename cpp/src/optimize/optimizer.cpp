#include "optimize/optimizer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "optimize/mesh_score.h"
#include "optimize/mesh_costs.h"
#include "optimize/schedule.h"
#include "optimize/sweep_observer.h"
#include "optimize/sweeps.h"
#include "optimize/tet_complex.h"

namespace tetrafront {
namespace {

/// Mean relative edge length above which edges are split from a lower limit on: the region is about
/// one and a half elements thick, or its interior began without nodes. The sum of costs alone would
/// accept too few nodes there.
constexpr double kSparse = 1.13;
constexpr double kSplitAllOfSparse = 1.4;
/// In thin walls, collapses would remove the new nodes again. Interiors with a longer mean edge are
/// not walls and have room for them.
constexpr double kEmpty = 1.3;
constexpr double kMaxEdgeInWalls = 1.65;
/// Number of elements that miss a target above which a mesh no longer counts as small.
constexpr double kFewMissing = 500.0;
/// Fraction of the mesh. If improvements changed more, as in gaps one edge wide, shape sweeps would
/// visit that part again and again.
constexpr double kMuchChanged = 0.02;
/// For the estimate of the progress: share of the time before the first step, and the part of a step that a repetition leaves.
constexpr double kBuildShare = 0.05;
constexpr double kLeftByRepeat = 0.5;

/// Returns per node the region with the smallest cap among those of its elements; empty if no region has a cap.
std::vector<std::uint32_t> regionsOfNodes(const VolumeMesh& mesh, const SizeField& field) {
  if (!field.hasRegionCaps()) return {};
  std::vector<std::uint32_t> regions(mesh.points.size() / 3, FieldHint::kAnyRegion);
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    std::uint32_t& known = regions[mesh.tetrahedra[i]];
    const std::uint32_t region = mesh.regions[i / 4];
    if (field.capOf(region) < field.capOf(known)) known = region;
  }
  return regions;
}

}  // namespace

/// Interface called once per slice, for either kind of space.
class MeshOptimizer::AnySpace {
 public:
  AnySpace() = default;
  AnySpace(const AnySpace&) = delete;
  AnySpace& operator=(const AnySpace&) = delete;
  virtual ~AnySpace() = default;

  virtual bool advance(std::uint32_t budget) = 0;
  void observe(SweepObserver& observer) { observer_ = &observer; }
  [[nodiscard]] virtual double fraction() const = 0;
  [[nodiscard]] virtual std::size_t elementCount() const = 0;
  [[nodiscard]] virtual VolumeMesh mesh() const = 0;
  [[nodiscard]] virtual std::size_t pointCount() const = 0;
  [[nodiscard]] virtual bool hasFoundNothingBetter() const = 0;
  [[nodiscard]] virtual bool hasRefusedGrowth() const = 0;

 protected:
  SweepObserver* observer_ = nullptr;
};

/// Executes the schedule. Each step queries the size field if necessary, recomputes the elements'
/// costs, decides whether it is worthwhile, and repeats its sweeps as its rule says.
template <class Space>
class MeshOptimizer::InSpace final : public MeshOptimizer::AnySpace {
 public:
  InSpace(VolumeMesh mesh, std::size_t boundaryNodes, const SizeField& field,
          std::vector<Step> schedule, const MeshLimits& limits)
      : schedule_(std::move(schedule)),
        limits_(limits),
        field_(field),
        targetsNeeded_(mesh.points.size() / 3),
        givenRegionOf_(regionsOfNodes(mesh, field)),
        complex_(std::move(mesh), boundaryNodes, Space::kIsStretched),
        sweeps_(complex_) {}

  bool advance(std::uint32_t budget) override {
    while (budget > 0 && !isDone()) {
      std::size_t done = 0;
      if (targetsKnown_ < targetsNeeded_) {
        done = queryTargets(budget);
      } else if (!isBuilt_) {
        done = build(budget);
      } else if (costed_ < toCost_) {
        done = costSome(budget);
      } else if (!isUnderWay_) {
        enter();
      } else {
        done = sweepSome(budget);
      }
      budget -= std::min<std::uint32_t>(budget, static_cast<std::uint32_t>(done) + 1);
    }
    return isDone();
  }

  [[nodiscard]] double fraction() const override {
    if (isDone()) return 1.0;
    if (!isBuilt_) return kBuildShare * knownShare();
    double before = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < schedule_.size(); ++i) {
      all += schedule_[i].work;
      if (i < step_) before += schedule_[i].work;
    }
    const double made = before + (isUnderWay_ ? stepFraction() * step().work : 0.0);
    return kBuildShare + (1.0 - kBuildShare) * made / all;
  }
  [[nodiscard]] std::size_t elementCount() const override {
    if (isDone() && kept_) return kept_->regions.size();
    return complex_.elementCount();
  }
  [[nodiscard]] VolumeMesh mesh() const override {
    if (isDone() && kept_) return *kept_;
    return complex_.toMesh();
  }
  [[nodiscard]] std::size_t pointCount() const override {
    if (!isBuilt_) return complex_.nodeCount();
    if (isDone() && kept_) return kept_->points.size() / 3;
    return complex_.boundaryNodeCount() + freeNodes_;
  }
  [[nodiscard]] bool hasFoundNothingBetter() const override {
    return isDone() && kept_.has_value();
  }
  [[nodiscard]] bool hasRefusedGrowth() const override { return complex_.hasRefusedGrowth(); }

 private:
  [[nodiscard]] bool isDone() const { return isBuilt_ && step_ == schedule_.size(); }
  [[nodiscard]] const Step& step() const { return schedule_[step_]; }

  [[nodiscard]] double knownShare() const {
    return targetsNeeded_ == 0
               ? 1.0
               : static_cast<double>(targetsKnown_) / static_cast<double>(targetsNeeded_);
  }

  /// Estimated part of the step that is made. How often it repeats is not known: each repetition takes the same part of
  /// what is left, because later ones visit less.
  [[nodiscard]] double stepFraction() const {
    const double ofRepeat = (static_cast<double>(sweep_) + sweeps_.fraction()) /
                            static_cast<double>(step().sweeps.size());
    if (step().maxRepeats == 1) return ofRepeat;
    return 1.0 - std::pow(kLeftByRepeat, static_cast<double>(repeats_) + ofRepeat);
  }

  std::size_t queryTargets(std::uint32_t budget) {
    const std::size_t count = std::min<std::size_t>(budget, targetsNeeded_ - targetsKnown_);
    for (std::size_t i = 0; i < count; ++i, ++targetsKnown_) {
      const NodeId node(targetsKnown_);
      if (!complex_.isUsed(node) && isBuilt_) continue;
      if (field_.hasRegionCaps()) hint_.region = regionOf(node);
      complex_.setTarget<Space>(node, Space::targetAt(field_, complex_.position(node), hint_));
    }
    return count;
  }

  /// Returns the region whose sizes apply at a node: on an interface, that of the smaller cap.
  [[nodiscard]] std::uint32_t regionOf(NodeId node) const {
    return node.index() < givenRegionOf_.size() ? givenRegionOf_[node.index()]
                                                : complex_.regionAt(node);
  }

  std::size_t build(std::uint32_t budget) {
    if (!complex_.build(budget)) return budget;
    isBuilt_ = true;
    freeNodes_ = complex_.freeNodeCount();
    if (complex_.elementCount() == 0) schedule_.clear();
    if (observer_ != nullptr && !isDone()) observer_->begun(complex_);
    turnToStep(0);
    return budget;
  }

  [[nodiscard]] bool isLeftOut() const {
    return (step().entry == Entry::kIfGivenUp && !isGivenUp_) ||
           (step().entry == Entry::kIfBefore && !isUnderWay_) ||
           (step().entry == Entry::kIfGaining && !isGaining_);
  }

  /// Advances to the next step that is not skipped.
  void turnToStep(std::size_t next) {
    step_ = next;
    while (!isDone() && isLeftOut()) ++step_;
    repeats_ = 0;
    isUnderWay_ = false;
    if (isDone()) {
      if (observer_ != nullptr && kept_) observer_->restored();
      return;
    }
    if (step().costBasis == CostBasis::kTargets) {
      if (improvementBegan_ == 0) improvementBegan_ = complex_.pass() + 1;
      sweeps_.improvements().begin(step());
    }
    const bool isNewMeasure = step().costBasis != CostBasis::kAsBefore;
    if (isNewMeasure) {
      sweeps_.measureBy(costOfStep().above(limits_.leastRadiusRatio),
                        step().changedOnly ? improvementBegan_ : 0);
    }
    complex_.limitElements(step().costBasis == CostBasis::kTargets ? limits_.elementsWithRepairs
                                                                   : limits_.elements);
    if (isRounds()) {
      beginRound();
    } else if (Space::kIsStretched && step_ > 0) {
      requeryTargets();
    }
    if (isNewMeasure) recomputeCosts();
  }

  [[nodiscard]] ElementCost<Space> costOfStep() const {
    // Factor of the squared tangents of half the angles. Recomputing the cost of an unchanged element changes it by
    // far less; the angles that a report shows differ by far more.
    constexpr double kMargin = 1.0 + 1e-9;
    switch (step().costBasis) {
      case CostBasis::kAsBefore:
        break;
      case CostBasis::kBulk:
        return ElementCost<Space>(Measure::kBulk);
      case CostBasis::kFinish:
        return ElementCost<Space>(Measure::kFinish);
      case CostBasis::kTargets:
        return ElementCost<Space>(Measure::kDihedral, step().targets);
      case CostBasis::kWithinAngles:
        return ElementCost<Space>(Measure::kWithin,
                                  sweeps_.score().within(kTargets35And130).loweredBy(kMargin));
    }
    return sweeps_.cost();
  }

  std::size_t costSome(std::uint32_t budget) {
    const std::size_t some = std::min<std::size_t>(budget, toCost_ - costed_);
    complex_.recomputeCosts(sweeps_.cost(), costed_, costed_ + some);
    costed_ += some;
    return some;
  }

  [[nodiscard]] bool isRounds() const { return step().again == Again::kWhileItGains; }

  /// Returns whether the targets of the nodes must be queried again: nodes have moved, and new
  /// nodes have a mean of their neighbours' targets. Without stretching this affects lengths only,
  /// which matter in rounds alone.
  void beginRound() {
    requeryTargets();
    if (Space::kIsStretched) recomputeCosts();
  }

  void requeryTargets() {
    targetsKnown_ = complex_.boundaryNodeCount();
    targetsNeeded_ = complex_.nodeCount();
  }

  void recomputeCosts() {
    costed_ = 0;
    toCost_ = complex_.slotCount();
  }

  /// Begins the step's sweeps, or the next step, now that the costs are known.
  void enter() {
    if (!isWorthwhile()) return turnToStep(step_ + 1);
    if (isRounds()) meanCost_ = meanCostOf(complex_);
    if (step().again == Again::kIfMuchChanged) isMuchChanged_ = changedPart() > kMuchChanged;
    isUnderWay_ = true;
    beginSweeps();
  }

  [[nodiscard]] double changedPart() const {
    return static_cast<double>(changedSince(complex_, improvementBegan_)) /
           static_cast<double>(complex_.elementCount());
  }

  /// Returns whether the step is worthwhile; also records whether its target is given up.
  bool isWorthwhile() {
    if (step().costBasis != CostBasis::kTargets) return true;
    const std::size_t missing = sweeps_.improvements().missing();
    if (step().entry == Entry::kIfFewMiss) {
      return !isGivenUp_ && missing > 0 && missing <= ImprovementQueue<Space>::kVeryFew;
    }
    const auto count = static_cast<double>(complex_.elementCount());
    const double most =
        std::max(step().many * count, std::min(kFewMissing, step().manyOfFew * count));
    isGivenUp_ = static_cast<double>(missing) > most;
    return !isGivenUp_;
  }

  void beginSweeps() {
    sweep_ = 0;
    sweeps_.begin(step().sweeps[0]);
  }

  std::size_t sweepSome(std::uint32_t budget) {
    const std::size_t done = sweeps_.advance(budget);
    if (!sweeps_.isDone()) return done;
    if (observer_ != nullptr) observer_->swept(step().sweeps[sweep_], complex_);
    freeNodes_ = complex_.freeNodeCount();
    if (++sweep_ < step().sweeps.size()) {
      sweeps_.begin(step().sweeps[sweep_]);
    } else {
      endSweeps();
    }
    return done;
  }

  /// Repeats the step or advances to the next one.
  void endSweeps() {
    ++repeats_;
    if (isAgain(sweeps_.takeChanges())) return repeat();
    if (step().costBasis == CostBasis::kTargets) isGivenUp_ = sweeps_.improvements().canGiveUp();
    servePurpose();
    turnToStep(isHopeless_ ? schedule_.size() : step_ + 1);
  }

  [[nodiscard]] bool isAgain(std::size_t changes) {
    const bool isLast = repeats_ >= step().maxRepeats;
    switch (step().again) {
      case Again::kAlways:
        return !isLast;
      case Again::kWhileItGains: {
        const double before = std::exchange(meanCost_, meanCostOf(complex_));
        isGaining_ =
            static_cast<double>(changes) >= step().minChanges * static_cast<double>(freeNodes_) &&
            meanCost_ < before * (1.0 - step().minGain);
        return !isLast && isGaining_;
      }
      case Again::kWhileItImproves:
        if (changes > 0 && !isLast) return true;
        if (!sweeps_.improvements().focusOnWorst()) return false;
        repeats_ = 0;
        return true;
      case Again::kWhileLastResortHelps:
        return changes > 0 && !isLast;
      case Again::kIfMuchChanged:
        return isMuchChanged_ && !isLast;
    }
    return false;
  }

  void repeat() {
    if (isRounds()) beginRound();
    beginSweeps();
  }

  void servePurpose() {
    switch (step().purpose) {
      case Purpose::kSweeps:
        return;
      case Purpose::kSeeIfSparse:
        seeIfSparse();
        return;
      case Purpose::kKeep:
        keptScore_ = sweeps_.score();
        kept_ = complex_.toMesh();
        if (observer_ != nullptr) observer_->kept();
        return;
      case Purpose::kGiveUp:
        isHopeless_ = sweeps_.score().isHopelessBeside(keptScore_);
        return;
      case Purpose::kCompare:
        if (sweeps_.score().isBetterThan(keptScore_)) kept_.reset();
        return;
    }
  }

  void seeIfSparse() {
    const double mean = meanEdgeOf<Space>(complex_);
    if (mean <= kSparse) return;
    sweeps_.splitter().splitAllAbove(kSplitAllOfSparse);
    if (mean <= kEmpty) sweeps_.collapser().allowEdgesUpTo(kMaxEdgeInWalls);
  }

  std::vector<Step> schedule_;
  MeshLimits limits_;
  const SizeField& field_;
  FieldHint hint_;
  std::size_t targetsKnown_ = 0;              ///< nodes whose targets are known
  std::size_t targetsNeeded_;                 ///< nodes whose targets are needed
  std::vector<std::uint32_t> givenRegionOf_;  ///< per given node; empty without caps
  std::size_t costed_ = 0;
  std::size_t toCost_ = 0;
  TetComplex complex_;
  Sweeps<Space> sweeps_;
  bool isBuilt_ = false;
  std::size_t step_ = 0;     ///< index in the schedule
  bool isUnderWay_ = false;  ///< the step's sweeps have begun
  std::size_t sweep_ = 0;    ///< index in the step
  int repeats_ = 0;          ///< of the step
  double meanCost_ = 0.0;    ///< of the elements at the end of the last round
  bool isMuchChanged_ = false;
  bool isGaining_ = false;              ///< the last round gained
  bool isHopeless_ = false;             ///< the kept mesh is the result
  bool isGivenUp_ = false;              ///< the target of the last improvement was given up
  std::uint32_t improvementBegan_ = 0;  ///< pass in which improvements began; 0 before
  std::size_t freeNodes_ = 0;           ///< at the end of the last sweep; counting them is O(nodes)
  MeshScore keptScore_;
  std::optional<VolumeMesh> kept_;  ///< mesh to restore unless the new one is no worse
};

MeshOptimizer::MeshOptimizer(VolumeMesh mesh, std::size_t boundaryNodes, const SizeField& field,
                             Optimization level, const MeshLimits& limits)
    : optimizer_(make(std::move(mesh), boundaryNodes, field, scheduleOf(level), limits)) {}

MeshOptimizer::MeshOptimizer(std::unique_ptr<AnySpace> optimizer)
    : optimizer_(std::move(optimizer)) {}

MeshOptimizer MeshOptimizer::cautious(VolumeMesh mesh, std::size_t boundaryNodes,
                                      const SizeField& field, const MeshLimits& limits) {
  return MeshOptimizer(make(std::move(mesh), boundaryNodes, field, cautiousSchedule(), limits));
}

std::unique_ptr<MeshOptimizer::AnySpace> MeshOptimizer::make(VolumeMesh mesh,
                                                             std::size_t boundaryNodes,
                                                             const SizeField& field,
                                                             std::vector<Step> schedule,
                                                             const MeshLimits& limits) {
  if (field.isStretched()) {
    return std::make_unique<InSpace<StretchedSpace>>(std::move(mesh), boundaryNodes, field,
                                                     std::move(schedule), limits);
  }
  return std::make_unique<InSpace<PlainSpace>>(std::move(mesh), boundaryNodes, field,
                                               std::move(schedule), limits);
}

MeshOptimizer::MeshOptimizer(MeshOptimizer&&) noexcept = default;
MeshOptimizer& MeshOptimizer::operator=(MeshOptimizer&&) noexcept = default;
MeshOptimizer::~MeshOptimizer() = default;

void MeshOptimizer::observe(SweepObserver& observer) { optimizer_->observe(observer); }
bool MeshOptimizer::advance(std::uint32_t budget) { return optimizer_->advance(budget); }
double MeshOptimizer::fraction() const { return optimizer_->fraction(); }
std::uint32_t MeshOptimizer::pointCount() const {
  return static_cast<std::uint32_t>(optimizer_->pointCount());
}
std::uint32_t MeshOptimizer::tetrahedronCount() const {
  return static_cast<std::uint32_t>(optimizer_->elementCount());
}
VolumeMesh MeshOptimizer::mesh() const { return optimizer_->mesh(); }
bool MeshOptimizer::hasFoundNothingBetter() const { return optimizer_->hasFoundNothingBetter(); }
bool MeshOptimizer::hasRefusedGrowth() const { return optimizer_->hasRefusedGrowth(); }

}  // namespace tetrafront
