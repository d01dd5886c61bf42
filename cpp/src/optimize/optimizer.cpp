#include "optimize/optimizer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "optimize/locality.h"
#include "optimize/mesh_costs.h"
#include "optimize/mesh_score.h"
#include "optimize/rules.h"
#include "optimize/schedule.h"
#include "optimize/sweep_observer.h"
#include "optimize/sweeps.h"
#include "optimize/tet_complex.h"
#include "optimize/tile_runner.h"
#include "optimize/tiles.h"

namespace tetrafront {
namespace {

/// For the estimate of the progress: the share of the time before the first step, the share of a step before its sweeps, and the
/// part of a step that remains after each repetition.
constexpr double kBuildShare = 0.05;
constexpr double kMeasureShare = 0.05;
constexpr double kLeftByRepeat = 0.55;
/// The same for improvements: the first pass makes most of them, and hardly any of its time is for collecting elements.
constexpr double kLeftByImprovement = 0.3;
constexpr double kCollectPart = 0.1;
/// Free nodes per element of a mesh with an interior. Work of steps in a body of one layer, without free nodes: factor of the shape
/// sweeps, and what the first repair has in addition.
constexpr double kFreeNodesPerElement = 0.1;
constexpr double kSweepsOfThin = 0.3;
constexpr double kRepairOfThin = 35.0;
/// In tiles, for the estimate of the progress: the ends of the shape steps in tiles, and of those at seams.
constexpr double kTilesEnd = 0.7;
constexpr double kSeamsEnd = 0.85;

}  // namespace

/// Either kind of space.
class MeshOptimizer::AnySpace {
 public:
  AnySpace() = default;
  AnySpace(const AnySpace&) = delete;
  AnySpace& operator=(const AnySpace&) = delete;
  virtual ~AnySpace() = default;

  virtual Task<> run(Work& work) = 0;
  void observe(SweepObserver& observer) { observer_ = &observer; }
  [[nodiscard]] virtual std::size_t elementCount() const = 0;
  [[nodiscard]] virtual TetMesh mesh() const = 0;
  [[nodiscard]] virtual TetMesh take() = 0;
  [[nodiscard]] virtual std::size_t innerNodeCount() const = 0;
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
  InSpace(TetMesh mesh, const SizeField& field, std::vector<Step> schedule,
          const MeshLimits& limits)
      : schedule_(std::move(schedule)),
        limits_(limits),
        field_(field),
        complex_(std::move(mesh), Space::kIsStretched),
        sweeps_(complex_) {
    if (complex_.slotCount() > 0) hint_.region = complex_.regionOf(TetId(0U));
  }

  Task<> run(Work& work) override {
    work.beginPart(kBuildShare);
    co_await queryTargets(work);
    co_await complex_.findNeighbours(work);
    freeNodes_ = complex_.freeNodeCount();
    hasNeighbours_ = true;
    if (observer_ != nullptr) observer_->begunRegion(complex_);
    if (complex_.elementCount() > 0) {
      work.beginPart(1.0);
      co_await runSteps(work);
    }
    isDone_ = true;
    if (observer_ != nullptr && kept_) observer_->restored();
  }
  [[nodiscard]] std::size_t elementCount() const override {
    if (hasFoundNothingBetter()) return kept_->regions.size();
    return complex_.elementCount();
  }
  [[nodiscard]] TetMesh mesh() const override {
    return hasFoundNothingBetter() ? *kept_ : complex_.toMesh();
  }
  [[nodiscard]] TetMesh take() override {
    return hasFoundNothingBetter() ? std::move(*kept_) : complex_.take();
  }
  [[nodiscard]] std::size_t innerNodeCount() const override {
    if (!hasNeighbours_) return complex_.nodeCount() - complex_.fixedNodeCount();
    if (hasFoundNothingBetter()) return kept_->points.size() - complex_.fixedNodeCount();
    return freeNodes_;
  }
  [[nodiscard]] bool hasFoundNothingBetter() const override { return isDone_ && kept_.has_value(); }
  [[nodiscard]] bool hasRefusedGrowth() const override { return complex_.hasRefusedGrowth(); }

 private:
  Task<> runSteps(Work& work) {
    const double fullness = interiorPart();
    double remaining = 0.0;
    for (const Step& step : schedule_) remaining += workOf(step, fullness);
    for (const Step& step : schedule_) {
      const double own = workOf(step, fullness);
      const double rest = std::exchange(remaining, remaining - own);
      if (isLeftOut(step)) continue;
      work.beginShare(kMeasureShare * own, rest);
      co_await measureBy(work, step);
      wasWorthwhile_ = isWorthwhile(step);
      if (!wasWorthwhile_) continue;
      work.beginShare(own, rest);
      co_await runSweeps(work, step);
      if (isHopeless_) co_return;
    }
  }

  /// Returns how much of an interior the mesh has, 0 to 1, by the nodes that can move: none in a plate of one layer.
  [[nodiscard]] double interiorPart() const {
    const auto count = static_cast<double>(complex_.elementCount());
    return std::min(1.0, static_cast<double>(freeNodes_) / (kFreeNodesPerElement * count));
  }

  /// Returns the estimated work of a step: without interior nodes, shape sweeps have little to do and leave more elements to
  /// the first repair.
  [[nodiscard]] double workOf(const Step& step, double fullness) const {
    if (step.costBasis != CostBasis::kTargets)
      return step.work * std::lerp(kSweepsOfThin, 1.0, fullness);
    const bool isFirst =
        std::ranges::find(schedule_, CostBasis::kTargets, &Step::costBasis).base() == &step;
    return isFirst ? step.work + kRepairOfThin * (1.0 - fullness) : step.work;
  }

  [[nodiscard]] bool isLeftOut(const Step& step) const {
    return (step.entry == Entry::kIfGivenUp && !isGivenUp_) ||
           (step.entry == Entry::kIfBefore && !wasWorthwhile_) ||
           (step.entry == Entry::kIfGaining && !isGaining_);
  }

  /// Queries the targets of the nodes: at first those of all, later those of nodes that may have moved.
  Task<> queryTargets(Work& work) {
    co_await work.forEachId<NodeId>(complex_.nodeCount(), [this](NodeId node) {
      if (hasNeighbours_ && (complex_.isFixed(node) || !complex_.isUsed(node))) return;
      complex_.setTarget<Space>(node, Space::targetAt(field_, complex_.position(node), hint_));
    });
  }

  /// Sets what the step measures elements by, with the targets and costs that it needs.
  Task<> measureBy(Work& work, const Step& step) {
    if (step.costBasis == CostBasis::kTargets) {
      if (improvementBegan_ == 0) improvementBegan_ = complex_.pass() + 1;
      sweeps_.improvements().begin(step);
    }
    const bool isNewMeasure = step.costBasis != CostBasis::kAsBefore;
    if (isNewMeasure) {
      sweeps_.measureBy(costOf(step).within(limits_.ofElements),
                        step.changedOnly ? improvementBegan_ : 0);
    }
    complex_.limitElements(step.costBasis == CostBasis::kTargets ? limits_.elementsWithRepairs
                                                                 : limits_.elements);
    const bool isFirst = &step == schedule_.data();
    if (isRounds(step) || (Space::kIsStretched && !isFirst)) {
      co_await queryTargets(work);
    }
    if (isNewMeasure || (isRounds(step) && Space::kIsStretched)) co_await recomputeCosts(work);
  }

  [[nodiscard]] ElementCost<Space> costOf(const Step& step) const {
    // Factor of the squared tangents of half the angles. Recomputing the cost of an unchanged element changes it by
    // far less; the angles that a report shows differ by far more.
    constexpr double kMargin = 1.0 + 1e-9;
    switch (step.costBasis) {
      case CostBasis::kAsBefore:
        break;
      case CostBasis::kBulk:
        return ElementCost<Space>(Measure::kBulk);
      case CostBasis::kFinish:
        return ElementCost<Space>(Measure::kFinish);
      case CostBasis::kTargets:
        return ElementCost<Space>(Measure::kDihedral, step.targets);
      case CostBasis::kWithinAngles:
        return ElementCost<Space>(Measure::kWithin,
                                  sweeps_.score().within(kTargets35And130).loweredBy(kMargin));
    }
    return sweeps_.cost();
  }

  Task<> recomputeCosts(Work& work) {
    co_await work.forEachBlock(complex_.slotCount(), [this](std::size_t first, std::size_t last) {
      complex_.recomputeCosts(sweeps_.cost(), first, last);
    });
  }

  [[nodiscard]] static bool isRounds(const Step& step) {
    return step.again == Again::kWhileItGains;
  }

  [[nodiscard]] double changedPart() const {
    return static_cast<double>(changedSince(complex_, improvementBegan_)) /
           static_cast<double>(complex_.elementCount());
  }

  /// Returns whether the step is worthwhile; also records whether its target is given up.
  bool isWorthwhile(const Step& step) {
    if (step.costBasis != CostBasis::kTargets) return true;
    const std::size_t missing = sweeps_.improvements().missing();
    if (step.entry == Entry::kIfFewMiss) {
      return !isGivenUp_ && missing > 0 && missing <= ImprovementQueue<Space>::kVeryFew;
    }
    const auto count = static_cast<double>(complex_.elementCount());
    const double most = std::max(step.many * count, std::min(kFewMissing, step.manyOfFew * count));
    isGivenUp_ = static_cast<double>(missing) > most;
    return !isGivenUp_;
  }

  /// Makes the sweeps of the step, again as its rule says, and what else it does.
  Task<> runSweeps(Work& work, const Step& step) {
    if (isRounds(step)) meanCost_ = meanCostOf(complex_);
    if (step.again == Again::kIfMuchChanged) isMuchChanged_ = changedPart() > kMuchChanged;
    int repeats = 0;
    for (int run = 0;; ++run) {
      for (std::size_t i = 0; i < step.sweeps.size(); ++i) {
        work.beginPart(fractionAfter(step, run, i + 1));
        co_await sweep(work, step.sweeps[i]);
      }
      ++repeats;
      if (!isAgain(step, sweeps_.takeChanges(), repeats)) break;
      if (!isRounds(step)) continue;
      // Nodes have moved, and new nodes have a mean of their neighbours' targets. Without stretching this affects lengths
      // only, which matter in rounds alone.
      co_await queryTargets(work);
      if (Space::kIsStretched) co_await recomputeCosts(work);
    }
    if (step.costBasis == CostBasis::kTargets) isGivenUp_ = sweeps_.improvements().canGiveUp();
    servePurpose(step);
  }

  /// Returns the estimated part of the step that is done after this many sweeps of a run. The number of runs is not known
  /// beforehand: each takes the same share of the remaining work, because later runs visit fewer elements.
  [[nodiscard]] static double fractionAfter(const Step& step, int run, std::size_t sweeps) {
    const bool improves = step.costBasis == CostBasis::kTargets;
    const double ofRun = static_cast<double>(sweeps) / static_cast<double>(step.sweeps.size());
    if (step.maxRepeats == 1) return ofRun;
    const double done = improves && ofRun < 1.0 ? kCollectPart : ofRun;
    return 1.0 - std::pow(improves ? kLeftByImprovement : kLeftByRepeat, run + done);
  }

  Task<> sweep(Work& work, Sweep kind) {
    for (sweeps_.begin(kind); !sweeps_.isDone();) {
      const std::size_t done = sweeps_.advance(work.remaining());
      // The worst elements come first, and take the longest.
      const double visited = sweeps_.fraction();
      work.setFraction(kind == Sweep::kImprove ? std::cbrt(visited) : visited);
      co_await work.spend(done + 1);
    }
    if (observer_ != nullptr) observer_->swept(kind, complex_);
    freeNodes_ = complex_.freeNodeCount();
  }

  /// `repeats`: how often the sweeps have been made; set to 0 when the goal changes.
  [[nodiscard]] bool isAgain(const Step& step, std::size_t changes, int& repeats) {
    const bool isLast = repeats >= step.maxRepeats;
    switch (step.again) {
      case Again::kAlways:
        return !isLast;
      case Again::kWhileItGains: {
        const double before = std::exchange(meanCost_, meanCostOf(complex_));
        isGaining_ =
            static_cast<double>(changes) >= step.minChanges * static_cast<double>(freeNodes_) &&
            meanCost_ < before * (1.0 - step.minGain);
        return !isLast && isGaining_;
      }
      case Again::kWhileItImproves:
        if (changes > 0 && !isLast) return true;
        if (!sweeps_.improvements().focusOnWorst()) return false;
        repeats = 0;
        return true;
      case Again::kWhileLastResortHelps:
        return changes > 0 && !isLast;
      case Again::kIfMuchChanged:
        return isMuchChanged_ && !isLast;
    }
    return false;
  }

  void servePurpose(const Step& step) {
    switch (step.purpose) {
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
  TetComplex complex_;
  Sweeps<Space> sweeps_;
  bool hasNeighbours_ = false;
  bool isDone_ = false;
  bool wasWorthwhile_ = false;  ///< the last step that was not left out
  double meanCost_ = 0.0;       ///< of the elements at the end of the last round
  bool isMuchChanged_ = false;
  bool isGaining_ = false;              ///< the last round gained
  bool isHopeless_ = false;             ///< the kept mesh is the result
  bool isGivenUp_ = false;              ///< the target of the last improvement was given up
  std::uint32_t improvementBegan_ = 0;  ///< pass in which improvements began; 0 before
  std::size_t freeNodes_ = 0;           ///< at the end of the last sweep; counting them is O(nodes)
  MeshScore keptScore_;
  std::optional<TetMesh> kept_;  ///< mesh to restore unless the new one is no worse
};

/// Shapes in tiles, then at the seams between them, then the other steps for the whole mesh. Small meshes are not cut.
class MeshOptimizer::InTiles final : public MeshOptimizer::AnySpace {
 public:
  InTiles(TetMesh mesh, const SizeField& field, Optimization level, TileRunner& runner)
      : given_(std::move(mesh)), steps_{field, level}, runner_(runner) {}

  Task<> run(Work& work) override {
    if (isLarge()) co_await runTiles(work);
    const StepPart part = isTiled_ ? StepPart::kAfterShapes : StepPart::kAll;
    optimizer_ = make(std::exchange(given_, {}), steps_.field, scheduleOf(steps_.level, part), {});
    work.beginPart(1.0);
    co_await optimizer_->run(work);
  }
  [[nodiscard]] std::size_t elementCount() const override {
    if (tiled_) return tiled_->tetrahedronCount();
    return optimizer_ ? optimizer_->elementCount() : given_.tetrahedra.size();
  }
  [[nodiscard]] TetMesh mesh() const override {
    if (tiled_) return tiled_->joined();
    return optimizer_ ? optimizer_->mesh() : given_;
  }
  [[nodiscard]] TetMesh take() override {
    if (tiled_) return tiled_->joined();
    return optimizer_ ? optimizer_->take() : std::move(given_);
  }
  [[nodiscard]] std::size_t innerNodeCount() const override {
    if (optimizer_) return optimizer_->innerNodeCount();
    const std::size_t nodes = tiled_ ? tiled_->nodeCount() : given_.points.size();
    return nodes - fixedNodes_;
  }
  [[nodiscard]] bool hasFoundNothingBetter() const override {
    return optimizer_ && optimizer_->hasFoundNothingBetter();
  }
  [[nodiscard]] bool hasRefusedGrowth() const override {
    return optimizer_ && optimizer_->hasRefusedGrowth();
  }

 private:
  [[nodiscard]] bool isLarge() const {
    return steps_.level != Optimization::kNone && given_.tetrahedra.size() >= kMinTiled;
  }

  Task<> runTiles(Work& work) {
    isTiled_ = true;
    work.beginPart(kBuildShare);
    TiledMesh tiled = co_await TiledMesh::cut(work, given_);
    tiled_ = std::move(tiled);
    given_ = {};
    work.beginPart(kTilesEnd);
    co_await runner_.run(work, tiled_->tiles(), steps_);
    TiledMesh atSeams = co_await TiledMesh::cutSeams(work, *tiled_);
    tiled_ = std::move(atSeams);
    work.beginPart(kSeamsEnd);
    co_await runner_.run(work, tiled_->tiles(), steps_);
    given_ = tiled_->joined();
    tiled_.reset();
    co_await orderAlongMortonCurve(work, given_);
  }

  TetMesh given_;
  TileSteps steps_;
  TileRunner& runner_;
  std::size_t fixedNodes_ =
      static_cast<std::size_t>(std::ranges::count(given_.isFixed, std::uint8_t{1}));
  bool isTiled_ = false;
  std::optional<TiledMesh> tiled_;  ///< while tiles are worked on
  std::unique_ptr<AnySpace> optimizer_;
};

Task<> TileSteps::run(Work& work, TetMesh& mesh) const {
  MeshOptimizer optimizer = MeshOptimizer::shapes(mesh, field, level);
  co_await optimizer.run(work);
  mesh = optimizer.take();
}

MeshOptimizer::MeshOptimizer(TetMesh mesh, const SizeField& field, Optimization level,
                             const MeshLimits& limits)
    : optimizer_(make(std::move(mesh), field, scheduleOf(level), limits)) {}

MeshOptimizer::MeshOptimizer(std::unique_ptr<AnySpace> optimizer)
    : optimizer_(std::move(optimizer)) {}

MeshOptimizer MeshOptimizer::cautious(TetMesh mesh, const SizeField& field,
                                      const MeshLimits& limits) {
  return MeshOptimizer(make(std::move(mesh), field, cautiousSchedule(), limits));
}

MeshOptimizer MeshOptimizer::shapes(TetMesh mesh, const SizeField& field, Optimization level) {
  return MeshOptimizer(make(std::move(mesh), field, scheduleOf(level, StepPart::kShapes), {}));
}

MeshOptimizer MeshOptimizer::inTiles(TetMesh mesh, const SizeField& field, Optimization level,
                                     TileRunner& runner) {
  return MeshOptimizer(std::make_unique<InTiles>(std::move(mesh), field, level, runner));
}

std::unique_ptr<MeshOptimizer::AnySpace> MeshOptimizer::make(TetMesh mesh, const SizeField& field,
                                                             std::vector<Step> schedule,
                                                             const MeshLimits& limits) {
  if (field.isStretched()) {
    return std::make_unique<InSpace<StretchedSpace>>(std::move(mesh), field, std::move(schedule),
                                                     limits);
  }
  return std::make_unique<InSpace<PlainSpace>>(std::move(mesh), field, std::move(schedule), limits);
}

MeshOptimizer::MeshOptimizer(MeshOptimizer&&) noexcept = default;
MeshOptimizer& MeshOptimizer::operator=(MeshOptimizer&&) noexcept = default;
MeshOptimizer::~MeshOptimizer() = default;

void MeshOptimizer::observe(SweepObserver& observer) { optimizer_->observe(observer); }
Task<> MeshOptimizer::run(Work& work) { return optimizer_->run(work); }
std::size_t MeshOptimizer::innerNodeCount() const { return optimizer_->innerNodeCount(); }
std::size_t MeshOptimizer::tetrahedronCount() const { return optimizer_->elementCount(); }
TetMesh MeshOptimizer::mesh() const { return optimizer_->mesh(); }
TetMesh MeshOptimizer::take() { return optimizer_->take(); }
bool MeshOptimizer::hasFoundNothingBetter() const { return optimizer_->hasFoundNothingBetter(); }
bool MeshOptimizer::hasRefusedGrowth() const { return optimizer_->hasRefusedGrowth(); }

}  // namespace tetrafront
