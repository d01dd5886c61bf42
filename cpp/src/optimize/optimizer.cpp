#include "optimize/optimizer.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "optimize/mesh_score.h"
#include "optimize/mesh_costs.h"
#include "optimize/schedule.h"
#include "optimize/sweeps.h"
#include "optimize/tet_complex.h"

namespace tetrafront {
namespace {

/// In the mean over all edges, by wanted lengths: with longer ones, the body has walls of about one and
/// a half elements, or its interior began without nodes. The sum of costs is content with fewer nodes
/// than wanted, so that edges are split from less on.
constexpr double kSparse = 1.13;
constexpr double kSplitAllOfSparse = 1.4;
/// In walls, collapses would take the new nodes away again; interiors longer than this in the mean are
/// not walls, and have room for them.
constexpr double kEmpty = 1.3;
constexpr double kMaxEdgeInWalls = 1.65;
/// Above this many elements that miss a target, small meshes are no longer small.
constexpr double kFewMissing = 500.0;
/// Part of the mesh. Where repairs have changed more, as in gaps of an edge, easing goes over that
/// again and again.
constexpr double kMuchMended = 0.02;

}  // namespace

/// What is asked once per slice, whichever space shapes are judged in.
class MeshOptimizer::Impl {
 public:
  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  virtual ~Impl() = default;

  virtual bool advance(std::uint32_t budget) = 0;
  [[nodiscard]] virtual double fraction() const = 0;
  [[nodiscard]] virtual std::size_t elementCount() const = 0;
  [[nodiscard]] virtual VolumeMesh mesh() const = 0;
  [[nodiscard]] virtual std::size_t pointCount() const = 0;
};

/// Goes through the schedule. Each step asks the size field where it needs to, has the elements' costs
/// computed, sees whether it is worth its while, and makes its sweeps as often as its rule says.
template <class Space>
class MeshOptimizer::ImplIn final : public MeshOptimizer::Impl {
 public:
  ImplIn(VolumeMesh mesh, std::size_t boundaryNodes, const SizeField& field, Optimization level)
      : schedule_(scheduleOf(level)),
        field_(field),
        toAsk_(mesh.points.size() / 3),
        complex_(std::move(mesh), boundaryNodes, Space::kIsStretched),
        sweeps_(complex_) {}

  bool advance(std::uint32_t budget) override {
    while (budget > 0 && !isDone()) {
      std::size_t done = 0;
      if (asked_ < toAsk_) {
        done = askField(budget);
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
    if (!isBuilt_) return 0.0;
    const double within = static_cast<double>(sweep_) / static_cast<double>(step().sweeps.size());
    return (1.0 + static_cast<double>(step_) + within) / static_cast<double>(1 + schedule_.size());
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

 private:
  [[nodiscard]] bool isDone() const { return isBuilt_ && step_ == schedule_.size(); }
  [[nodiscard]] const Step& step() const { return schedule_[step_]; }

  std::size_t askField(std::uint32_t budget) {
    const std::size_t count = std::min<std::size_t>(budget, toAsk_ - asked_);
    for (std::size_t i = 0; i < count; ++i, ++asked_) {
      const NodeId node(asked_);
      if (!complex_.isUsed(node) && isBuilt_) continue;
      complex_.setWanted<Space>(node, Space::wantedAt(field_, complex_.place(node), hint_));
    }
    return count;
  }

  std::size_t build(std::uint32_t budget) {
    if (!complex_.build(budget)) return budget;
    isBuilt_ = true;
    freeNodes_ = complex_.freeNodeCount();
    if (complex_.elementCount() == 0) schedule_.clear();
    turnToStep(0);
    return budget;
  }

  [[nodiscard]] bool isLeftOut() const {
    return (step().entry == Entry::kIfGivenUp && !isGivenUp_) ||
           (step().entry == Entry::kIfBefore && !isUnderWay_);
  }

  /// The next that is not left out for what has happened before.
  void turnToStep(std::size_t next) {
    step_ = next;
    while (!isDone() && isLeftOut()) ++step_;
    repeats_ = 0;
    isUnderWay_ = false;
    if (isDone()) return;
    if (step().costBasis == CostBasis::kTargets) {
      if (improvementBegan_ == 0) improvementBegan_ = complex_.pass() + 1;
      sweeps_.improvements().begin(step());
    }
    const bool isNewMeasure = step().costBasis != CostBasis::kAsBefore;
    if (isNewMeasure) sweeps_.measureBy(costOfStep(), step().changedOnly ? improvementBegan_ : 0);
    if (isRounds()) {
      beginRound();
    } else if (Space::kIsStretched && step_ > 0) {
      askAnew();
    }
    if (isNewMeasure) costAnew();
  }

  [[nodiscard]] ElementCost<Space> costOfStep() const {
    // A share of the squared tangents of half the angles: far more than an unchanged element, reckoned
    // anew, can differ by, and far less than any angle that is told.
    constexpr double kRounding = 1.0 + 1e-9;
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
                                  sweeps_.score().within(kTargets35And130).loweredBy(kRounding));
    }
    return sweeps_.cost();
  }

  std::size_t costSome(std::uint32_t budget) {
    const std::size_t some = std::min<std::size_t>(budget, toCost_ - costed_);
    complex_.costAnew(sweeps_.cost(), costed_, costed_ + some);
    costed_ += some;
    return some;
  }

  [[nodiscard]] bool isRounds() const { return step().again == Again::kWhileItGains; }

  /// Nodes are not where they were, and new ones have a mean of what others were told. Where nothing is
  /// stretched that concerns lengths only, which matter in rounds alone.
  void beginRound() {
    askAnew();
    if (Space::kIsStretched) costAnew();
  }

  void askAnew() {
    asked_ = complex_.boundaryNodeCount();
    toAsk_ = complex_.nodeCount();
  }

  void costAnew() {
    costed_ = 0;
    toCost_ = complex_.slotCount();
  }

  /// Begins the step's sweeps, or turns to the next step, now that costs are known.
  void enter() {
    if (!isWorthwhile()) return turnToStep(step_ + 1);
    if (isRounds()) meanCost_ = meanCostOf(complex_);
    if (step().again == Again::kIfMuchChanged) isMuchMended_ = changedPart() > kMuchMended;
    isUnderWay_ = true;
    beginSweeps();
  }

  [[nodiscard]] double changedPart() const {
    return static_cast<double>(changedSince(complex_, improvementBegan_)) /
           static_cast<double>(complex_.elementCount());
  }

  /// Also notes whether the step's target is given up.
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
    freeNodes_ = complex_.freeNodeCount();
    if (++sweep_ < step().sweeps.size()) {
      sweeps_.begin(step().sweeps[sweep_]);
    } else {
      endSweeps();
    }
    return done;
  }

  /// The same again, or the next step.
  void endSweeps() {
    ++repeats_;
    if (isAgain(sweeps_.takeChanges())) return repeat();
    if (step().costBasis == CostBasis::kTargets) isGivenUp_ = sweeps_.improvements().canGiveUp();
    servePurpose();
    turnToStep(step_ + 1);
  }

  [[nodiscard]] bool isAgain(std::size_t changes) {
    const bool isLast = repeats_ >= step().maxRepeats;
    switch (step().again) {
      case Again::kAlways:
        return !isLast;
      case Again::kWhileItGains: {
        const double before = std::exchange(meanCost_, meanCostOf(complex_));
        return !isLast &&
               static_cast<double>(changes) >=
                   step().minChanges * static_cast<double>(freeNodes_) &&
               meanCost_ < before * (1.0 - step().minGain);
      }
      case Again::kWhileItImproves:
        if (changes > 0 && !isLast) return true;
        if (!sweeps_.improvements().focusOnWorst()) return false;
        repeats_ = 0;
        return true;
      case Again::kWhileLastResortHelps:
        return changes > 0 && !isLast;
      case Again::kIfMuchChanged:
        return isMuchMended_ && !isLast;
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
        return;
      case Purpose::kCompare:
        if (sweeps_.score().isNoWorseThan(keptScore_)) kept_.reset();
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
  const SizeField& field_;
  FieldHint hint_;
  std::size_t asked_ = 0;  ///< of the field: for nodes up to here
  std::size_t toAsk_;      ///< for nodes up to here
  std::size_t costed_ = 0;
  std::size_t toCost_ = 0;
  TetComplex complex_;
  Sweeps<Space> sweeps_;
  bool isBuilt_ = false;
  std::size_t step_ = 0;     ///< of the schedule
  bool isUnderWay_ = false;  ///< the step's sweeps have begun
  std::size_t sweep_ = 0;    ///< of the step
  int repeats_ = 0;          ///< of the step
  double meanCost_ = 0.0;    ///< of the elements, when the last round ended
  bool isMuchMended_ = false;
  bool isGivenUp_ = false;              ///< the target of the last repair
  std::uint32_t improvementBegan_ = 0;  ///< the pass; 0 before
  std::size_t freeNodes_ = 0;           ///< when the last sweep ended: counting them is O(nodes)
  MeshScore keptScore_;
  std::optional<VolumeMesh> kept_;  ///< what striving began with, unless it is no worse
};

MeshOptimizer::MeshOptimizer(VolumeMesh mesh, std::size_t boundaryNodes, const SizeField& field,
                             Optimization level) {
  if (field.isStretched()) {
    impl_ = std::make_unique<ImplIn<StretchedSpace>>(std::move(mesh), boundaryNodes, field, level);
  } else {
    impl_ = std::make_unique<ImplIn<PlainSpace>>(std::move(mesh), boundaryNodes, field, level);
  }
}

MeshOptimizer::MeshOptimizer(MeshOptimizer&&) noexcept = default;
MeshOptimizer& MeshOptimizer::operator=(MeshOptimizer&&) noexcept = default;
MeshOptimizer::~MeshOptimizer() = default;

bool MeshOptimizer::advance(std::uint32_t budget) { return impl_->advance(budget); }
double MeshOptimizer::fraction() const { return impl_->fraction(); }
std::uint32_t MeshOptimizer::pointCount() const {
  return static_cast<std::uint32_t>(impl_->pointCount());
}
std::uint32_t MeshOptimizer::tetrahedronCount() const {
  return static_cast<std::uint32_t>(impl_->elementCount());
}
VolumeMesh MeshOptimizer::mesh() const { return impl_->mesh(); }

}  // namespace tetrafront
