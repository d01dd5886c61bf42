#include "optimize/optimizer.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "optimize/density.h"
#include "optimize/edge_removal.h"
#include "optimize/element_cost.h"
#include "optimize/judgement.h"
#include "optimize/near_sheets.h"
#include "optimize/node_moves.h"
#include "optimize/repair.h"
#include "optimize/rescue.h"
#include "optimize/tet_complex.h"

namespace tetrafront {
namespace {

/// One sweep over elements or nodes.
enum class Sweep : std::uint8_t {
  kSwap,              ///< E: edge removal
  kMove,              ///< O: circumcentre means
  kNewton,            ///< N
  kCollectSplits,     ///< P, first half
  kSplit,             ///< P
  kCollectCollapses,  ///< C, first half
  kCollapse,          ///< C
  kCollectBad,        ///< elements over the target, worst first
  kRepair,
  kJudge,
};
constexpr std::size_t kSweepKinds = 10;

/// Splits and collapses need a settled mesh between them: back to back they undo each other.
constexpr std::array kFirstSweeps{Sweep::kSwap, Sweep::kMove, Sweep::kMove};
constexpr std::array kRound{
    Sweep::kCollectSplits,    Sweep::kSplit,    Sweep::kSwap, Sweep::kMove, Sweep::kMove,
    Sweep::kCollectCollapses, Sweep::kCollapse, Sweep::kSwap, Sweep::kMove, Sweep::kMove};
constexpr std::array kFinishSweeps{Sweep::kSwap, Sweep::kNewton, Sweep::kNewton, Sweep::kSwap};
constexpr std::array kFastSweeps{Sweep::kSwap, Sweep::kNewton, Sweep::kSwap, Sweep::kNewton,
                                 Sweep::kSwap};
constexpr std::array kPolishSweeps{Sweep::kSwap, Sweep::kMove, Sweep::kNewton};
constexpr std::array kJudgeSweeps{Sweep::kJudge};
constexpr std::array kRepairSweeps{Sweep::kCollectBad, Sweep::kRepair};

constexpr int kMaxRounds = 10;
/// An interior with longer edges than this in the mean, by wanted lengths, began without nodes. The
/// sum of costs is content with fewer than wanted, so that those edges are split from less on.
constexpr double kSparse = 1.3;
constexpr double kSplitAllOfSparse = 1.4;
/// Rounds end when splits and collapses together are fewer than this part of the free nodes.
constexpr double kQuietRound = 0.1;
/// Or when a round lowers the mean cost by less than this part: where two sheets of the boundary
/// are near each other, splits and collapses can undo each other for ever.
constexpr double kLeastRoundGain = 0.01;
constexpr int kRepairPasses = 8;
/// A repair also ends when a pass has left more than this part of the bad elements that it met, and
/// more than that part of all: in a gap or a wedge without room for nodes, what mends one spoils
/// others.
constexpr double kMaxLeft = 0.8;
constexpr double kFewBad = 0.005;
/// A target is worth its cost only where few elements miss it: where the boundary is coarse for its
/// shape many do, and chasing them only adds elements.
constexpr double kMaxMissingLow = 0.1;
constexpr double kMaxMissingHigh = 0.04;
constexpr double kMaxMissingStrive = 0.01;
/// So few are mended in no time, unless they are a large part of all.
constexpr double kFewMissing = 500.0;
constexpr double kMaxMissingOfFew = 0.1;
constexpr int kPolishPasses = 4;
/// The lower targets: the first that few elements miss.
constexpr std::array kLowTargets{kTargets18And150, kTargets8And165, kTargets2And175};
/// Compound changes in one repair: so many, and one for so many elements.
constexpr std::size_t kLeastCompounds = 100;
constexpr std::size_t kElementsPerCompound = 50;
/// Rescues are for the last few; so many changes in all are tried, and one for so many elements.
constexpr std::size_t kMaxRescued = 40;
constexpr std::size_t kLeastRescueTries = 60;
constexpr std::size_t kElementsPerRescueTry = 200;
constexpr std::uint32_t kRescueWork = 1000;  ///< elements of a sweep that one of these costs
/// Easing goes once over what repairs have changed; as often as polishing where that is more than this
/// part of all, as in gaps of an edge.
constexpr double kMuchChanged = 0.02;
constexpr std::uint32_t kRepairWork = 64;  ///< elements of a sweep that one repair costs

enum class Stage : std::uint8_t {
  kBuild,
  kFirst,
  kRounds,
  kFinish,
  kRepairLow,
  kRepairHigh,
  kRescue,  ///< of what the repair has left
  kJudgeRepaired,
  kEase,          ///< shapes, where repairs and rescues have seen to angles only
  kJudgeDefault,  ///< what striving begins with
  kRepairStrive,
  kJudgeStrive,
  kPolish,  ///< shapes, where the repair has seen to angles only
  kJudgePolished,
  kDone
};

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

template <class Space>
class MeshOptimizer::ImplIn final : public MeshOptimizer::Impl {
 public:
  ImplIn(VolumeMesh mesh, std::size_t boundaryNodes, const SizeField& field, Optimization level)
      : level_(level),
        field_(field),
        toAsk_(mesh.points.size() / 3),
        complex_(std::move(mesh), boundaryNodes, Space::kIsStretched),
        removal_(complex_),
        mover_(complex_),
        splitter_(complex_),
        collapser_(complex_),
        repair_(complex_, removal_, splitter_, collapser_, mover_),
        rescue_(complex_, removal_, splitter_, collapser_, mover_, repair_) {}

  bool advance(std::uint32_t budget) override {
    while (budget > 0 && stage_ != Stage::kDone) {
      std::size_t done = 0;
      if (asked_ < toAsk_) {
        done = askField(budget);
      } else if (stage_ == Stage::kBuild) {
        done = build(budget);
      } else if (costing_) {
        done = costSome(budget);
      } else {
        done = sweepSome(budget);
      }
      budget -= std::min<std::uint32_t>(budget, static_cast<std::uint32_t>(done) + 1);
    }
    return stage_ == Stage::kDone;
  }

  [[nodiscard]] double fraction() const override {
    const double stages = static_cast<double>(Stage::kDone);
    const auto done = static_cast<double>(stage_);
    return (done + static_cast<double>(sweep_) / static_cast<double>(sweeps_.size() + 1)) / stages;
  }
  [[nodiscard]] std::size_t elementCount() const override {
    if (stage_ == Stage::kDone && defaultMesh_) return defaultMesh_->regions.size();
    return complex_.elementCount();
  }
  [[nodiscard]] VolumeMesh mesh() const override {
    if (stage_ == Stage::kDone && defaultMesh_) return *defaultMesh_;
    return complex_.toMesh();
  }
  [[nodiscard]] std::size_t pointCount() const override {
    if (stage_ == Stage::kBuild) return complex_.nodeCount();
    if (stage_ == Stage::kDone && defaultMesh_) return defaultMesh_->points.size() / 3;
    return complex_.boundaryNodeCount() + freeNodes_;
  }

 private:
  std::size_t askField(std::uint32_t budget) {
    const std::size_t count = std::min<std::size_t>(budget, toAsk_ - asked_);
    for (std::size_t i = 0; i < count; ++i, ++asked_) {
      const NodeId node(asked_);
      if (!complex_.isUsed(node) && stage_ != Stage::kBuild) continue;
      complex_.setWanted<Space>(node, Space::wantedAt(field_, complex_.place(node), hint_));
    }
    return count;
  }

  std::size_t build(std::uint32_t budget) {
    if (!complex_.build(budget)) return budget;
    freeNodes_ = complex_.freeNodeCount();
    if (level_ == Optimization::kNone || complex_.elementCount() == 0) {
      stage_ = Stage::kDone;
    } else if (level_ == Optimization::kFast) {
      begin(Stage::kFinish, kFastSweeps, ElementCost<Space>(Measure::kFinish));
    } else {
      begin(Stage::kFirst, kFirstSweeps, ElementCost<Space>(Measure::kBulk));
    }
    return budget;
  }

  /// Costs by a new measure; after the last one a repair may turn out not to be worth its while.
  std::size_t costSome(std::uint32_t budget) {
    const std::size_t some = std::min<std::size_t>(budget, complex_.slotCount() - costed_);
    complex_.costAnew(cost_, costed_, costed_ + some);
    costed_ += some;
    costing_ = costed_ < complex_.slotCount();
    const bool aims = cost_.measure() == Measure::kDihedral;
    if (!costing_ && aims && missing() > mostWorthwhile()) giveUpTarget();
    return some;
  }

  /// So many elements may miss this stage's target for it to be worth its cost.
  [[nodiscard]] double mostWorthwhile() const {
    const auto count = static_cast<double>(complex_.elementCount());
    if (stage_ == Stage::kRepairLow) return kMaxMissingLow * count;
    if (stage_ == Stage::kRepairStrive) return kMaxMissingStrive * count;
    return std::max(kMaxMissingHigh * count, std::min(kFewMissing, kMaxMissingOfFew * count));
  }

  std::size_t sweepSome(std::uint32_t budget) {
    if (stage_ == Stage::kRescue && sweeps_[sweep_] == Sweep::kRepair) return rescueSome();
    const std::uint32_t each = sweeps_[sweep_] == Sweep::kRepair ? kRepairWork : 1;
    const std::size_t count = std::min<std::size_t>(sweepEnd_ - next_, std::max(1U, budget / each));
    work(next_, next_ + count);
    next_ += count;
    if (next_ == sweepEnd_) endSweep();
    return count * each;
  }

  /// The first sweep of each kind visits what has changed since that pass.
  void begin(Stage stage, std::span<const Sweep> sweeps, const ElementCost<Space>& cost,
             std::uint32_t since = 0) {
    stage_ = stage;
    repeats_ = 0;
    sweeps_ = sweeps;
    cost_ = cost;
    costAnew();
    lastRun_.fill(since);
    // Where nothing is stretched only lengths are concerned, which matter in rounds alone.
    if (Space::kIsStretched && stage_ != Stage::kFirst) askAnew();
    beginSweeps();
  }

  /// Nodes are not where they were, and new ones have a mean of what others were told.
  void beginRound() {
    askAnew();
    if (Space::kIsStretched) costAnew();
    beginSweeps();
  }

  void askAnew() {
    asked_ = complex_.boundaryNodeCount();
    toAsk_ = complex_.nodeCount();
  }

  void costAnew() {
    costed_ = 0;
    costing_ = true;
  }

  void beginSweeps() {
    sweep_ = 0;
    beginSweep();
  }

  /// Elements that the sweep adds at the end are for the next one: looked up anew in each slice,
  /// the end would depend on where slices end.
  void beginSweep() {
    next_ = 0;
    sweepEnd_ = sweepSize();
    changes_ += changesInSweep_;
    changesInSweep_ = 0;
    complex_.beginPass();
    std::uint32_t& last = lastRun_[static_cast<std::size_t>(sweeps_[sweep_])];
    since_ = last;
    last = complex_.pass();
  }

  [[nodiscard]] std::size_t sweepSize() const {
    switch (sweeps_[sweep_]) {
      case Sweep::kSwap:
      case Sweep::kCollectSplits:
      case Sweep::kCollectBad:
      case Sweep::kJudge:
        return complex_.slotCount();
      case Sweep::kMove:
      case Sweep::kNewton:
      case Sweep::kCollectCollapses:
        return complex_.nodeCount();
      case Sweep::kSplit:
        return splitter_.collected();
      case Sweep::kCollapse:
        return collapser_.collected();
      case Sweep::kRepair:
        return bad_.size();
    }
    return 0;
  }

  void work(std::size_t first, std::size_t last) {
    switch (sweeps_[sweep_]) {
      case Sweep::kSwap:
        swap(first, last);
        break;
      case Sweep::kMove:
        move(first, last, MoveKind::kCircumcentres);
        break;
      case Sweep::kNewton:
        move(first, last, MoveKind::kNewton);
        break;
      case Sweep::kCollectSplits:
        splitter_.collect(first, last, since_);
        break;
      case Sweep::kCollectCollapses:
        collapser_.collect(first, last, since_);
        break;
      case Sweep::kSplit:
        changesInSweep_ += splitter_.splitSome(first, last - first, cost_);
        break;
      case Sweep::kCollapse:
        changesInSweep_ += collapser_.collapseSome(first, last - first, cost_);
        break;
      case Sweep::kCollectBad:
        collectBad(first, last);
        break;
      case Sweep::kRepair:
        repair(first, last);
        break;
      case Sweep::kJudge:
        judge(first, last);
        break;
    }
  }

  void swap(std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      // After a swap another element may live here: then all its edges.
      while (swapOneEdgeOf(TetId(t))) {
      }
    }
  }

  bool swapOneEdgeOf(TetId tet) {
    constexpr std::size_t kBulkRing = 7;
    constexpr double kSwapGain = 1e-4;
    if (!complex_.isLive(tet) || complex_.changedIn(tet) < since_) return false;
    EdgeRing ring;
    for (std::size_t e = 0; e < kEdgeCorners.size(); ++e) {
      if (!findClosedRing(complex_, tet, e, kBulkRing, since_, ring)) continue;
      if (removal_.improve(ring, cost_, {false, kSwapGain})) return true;
    }
    return false;
  }

  void move(std::size_t first, std::size_t last, MoveKind kind) {
    for (std::size_t i = std::max(first, complex_.boundaryNodeCount()); i < last; ++i) {
      const NodeId node(i);
      if (complex_.starChangedIn(node) >= since_) mover_.improve(node, kind, cost_);
    }
  }

  void judge(std::size_t first, std::size_t last) {
    if (first == 0) judgement_ = {};
    for (std::size_t t = first; t < last; ++t) {
      if (complex_.isLive(TetId(t))) judgement_.add<Space>(complex_, TetId(t));
    }
  }

  void collectBad(std::size_t first, std::size_t last) {
    if (first == 0) bad_.clear();
    for (std::size_t t = first; t < last; ++t) {
      if (isToBeMended(TetId(t))) bad_.emplace_back(t);
    }
  }

  /// Worst first; none where the last pass has hardly helped. Rescues begin with the best: it is
  /// the likeliest to be saved, and tries are few.
  void rankBad() {
    const auto count = static_cast<double>(bad_.size());
    const bool helped = repeats_ == 0 || bad_.size() <= kMaxRescued ||
                        count <= kMaxLeft * static_cast<double>(badBefore_);
    badBefore_ = bad_.size();
    if (!helped && count > kFewBad * static_cast<double>(complex_.elementCount())) bad_.clear();
    stableSort(bad_, [&](TetId p, TetId q) { return complex_.cost(p) > complex_.cost(q); });
    if (stage_ == Stage::kRescue) std::reverse(bad_.begin(), bad_.end());
  }

  void repair(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const TetId tet = bad_[i];
      if (!complex_.isLive(tet) || complex_.cost(tet) <= 1.0) continue;
      if (complex_.changedIn(tet) == complex_.pass()) continue;  // made in this pass: in the next
      changesInSweep_ += repair_.repair(tet, cost_) ? 1 : 0;
    }
  }

  /// One try for the element whose turn it is, or the next one's turn.
  std::size_t rescueSome() {
    if (isRescuing_ && rescue_.tryOne(cost_)) return kRescueWork;
    if (isRescuing_) {
      changesInSweep_ += rescue_.isSaved() ? 1 : 0;
      isRescuing_ = false;
      ++next_;
    }
    while (next_ < sweepEnd_ && !isToBeMended(bad_[next_])) ++next_;
    if (next_ < sweepEnd_) {
      rescue_.begin(bad_[next_]);
      isRescuing_ = true;
    } else {
      endSweep();
    }
    return 1;
  }

  void endSweep() {
    freeNodes_ = complex_.freeNodeCount();
    switch (sweeps_[sweep_]) {
      case Sweep::kCollectSplits:
        splitter_.sortCollected();
        break;
      case Sweep::kCollectCollapses:
        collapser_.sortCollected();
        break;
      case Sweep::kSplit:
        splitter_.clear();
        break;
      case Sweep::kCollapse:
        collapser_.clear();
        break;
      case Sweep::kCollectBad:
        rankBad();
        break;
      default:
        break;
    }
    if (++sweep_ < sweeps_.size()) {
      beginSweep();
    } else {
      endStage();
    }
  }

  /// After the last sweep of a stage: the same again, or the next stage.
  void endStage() {
    const std::size_t changes = changes_ + changesInSweep_;
    changes_ = 0;
    changesInSweep_ = 0;
    ++repeats_;
    switch (stage_) {
      case Stage::kBuild:
        return;
      case Stage::kFirst:
        repeats_ = 0;
        meanCost_ = meanCost();
        if (meanEdge() > kSparse) splitter_.splitAllAbove(kSplitAllOfSparse);
        stage_ = Stage::kRounds;
        sweeps_ = kRound;
        return beginRound();
      case Stage::kRounds:
        if (repeats_ < kMaxRounds && isRoundWorthwhile(changes)) return beginRound();
        return begin(Stage::kFinish, kFinishSweeps, ElementCost<Space>(Measure::kFinish));
      case Stage::kFinish:
        repairsBegan_ = complex_.pass() + 1;
        return beginRepair(Stage::kRepairLow);
      case Stage::kRepairLow:
      case Stage::kRepairHigh:
      case Stage::kRepairStrive:
        if (changes > 0 && repeats_ < kRepairPasses) return beginSweeps();
        if (!bad_.empty() && aim_ == RepairAim::kFewer) {
          aimAt(RepairAim::kLessBad);
          repeats_ = 0;
          return beginSweeps();
        }
        return endRepair();
      case Stage::kRescue:
        if (changes > 0 && repeats_ < kRepairPasses) return beginSweeps();
        return endRepair();
      case Stage::kJudgeRepaired:
        return beginEase();
      case Stage::kEase:
        if (repeats_ < easePasses_) return beginSweeps();
        return endDefault();
      case Stage::kJudgeDefault:
        judgedDefault_ = judgement_;
        defaultMesh_ = complex_.toMesh();
        return beginRepair(Stage::kRepairStrive);
      case Stage::kJudgeStrive:
        return begin(Stage::kPolish, kPolishSweeps, costWithinAngles());
      case Stage::kPolish:
        if (repeats_ < kPolishPasses) return beginSweeps();
        return beginJudging(Stage::kJudgePolished);
      case Stage::kJudgePolished:
        if (judgement_.isNoWorseThan(judgedDefault_)) defaultMesh_.reset();
        stage_ = Stage::kDone;
        return;
      case Stage::kDone:
        return;
    }
  }

  /// Whether the round that has just ended did enough for another one to be likely to.
  [[nodiscard]] bool isRoundWorthwhile(std::size_t changes) {
    const double before = std::exchange(meanCost_, meanCost());
    return static_cast<double>(changes) >= kQuietRound * static_cast<double>(freeNodes_) &&
           meanCost_ < before * (1.0 - kLeastRoundGain);
  }

  [[nodiscard]] double meanCost() const {
    double sum = 0.0;
    for (std::size_t t = 0; t < complex_.slotCount(); ++t) {
      if (complex_.isLive(TetId(t))) sum += complex_.cost(TetId(t));
    }
    return sum / static_cast<double>(complex_.elementCount());
  }

  /// By wanted lengths, of one element in so many.
  [[nodiscard]] double meanEdge() const {
    constexpr std::size_t kOneIn = 16;
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t t = 0; t < complex_.slotCount(); t += kOneIn) {
      if (!complex_.isLive(TetId(t))) continue;
      const Corners& nodes = complex_.element(TetId(t)).nodes;
      for (const auto& corners : kEdgeCorners) {
        sum += relativeLength<Space>(complex_, nodes[corners[0]], nodes[corners[1]]);
        count += 1.0;
      }
    }
    return sum / std::max(count, 1.0);
  }

  void beginRepair(Stage stage) {
    const DihedralTargets targets = stage == Stage::kRepairLow    ? kLowTargets[lowTarget_]
                                    : stage == Stage::kRepairHigh ? kTargets30And135
                                                                  : kTargets35And130;
    repair_.allowCompounds(kLeastCompounds + complex_.elementCount() / kElementsPerCompound);
    aimAt(RepairAim::kFewer);
    begin(stage, kRepairSweeps, ElementCost<Space>(Measure::kDihedral, targets));
  }

  void aimAt(RepairAim aim) {
    aim_ = aim;
    repair_.aimAt(aim);
  }

  /// Too many elements miss the target. So they would the higher ones.
  void giveUpTarget() {
    if (stage_ == Stage::kRepairLow && ++lowTarget_ < kLowTargets.size()) {
      return beginRepair(Stage::kRepairLow);
    }
    endRepairs();
  }

  /// The stage that follows when a repair has done what it can.
  void endRepair() {
    if (stage_ == Stage::kRepairLow && lowTarget_ == 0) return beginRepair(Stage::kRepairHigh);
    if (stage_ == Stage::kRepairHigh && isRescueWorthwhile()) {
      rescue_.allow(kLeastRescueTries + complex_.elementCount() / kElementsPerRescueTry);
      return begin(Stage::kRescue, kRepairSweeps, cost_);
    }
    endRepairs();
  }

  [[nodiscard]] bool isRescueWorthwhile() const {
    const auto left = std::ranges::count_if(bad_, [&](TetId tet) { return isToBeMended(tet); });
    return left > 0 && left <= static_cast<std::ptrdiff_t>(kMaxRescued);
  }

  void endRepairs() {
    beginJudging(stage_ == Stage::kRepairStrive ? Stage::kJudgeStrive : Stage::kJudgeRepaired);
  }

  /// What the repairs have changed may gain by other shapes with angles no worse.
  void beginEase() {
    const bool many = static_cast<double>(changedSince(repairsBegan_)) >
                      kMuchChanged * static_cast<double>(complex_.elementCount());
    easePasses_ = many ? kPolishPasses : 1;
    begin(Stage::kEase, kPolishSweeps, costWithinAngles(), repairsBegan_);
  }

  /// By shapes, and no angle worse than the worst at the last judgement.
  [[nodiscard]] ElementCost<Space> costWithinAngles() const {
    // A share of the squared tangents of half the angles: far more than an unchanged element, reckoned
    // anew, can differ by, and far less than any angle that is told.
    constexpr double kRounding = 1.0 + 1e-9;
    return ElementCost<Space>(Measure::kWithin,
                              judgement_.within(kTargets35And130).loweredBy(kRounding));
  }

  [[nodiscard]] std::size_t changedSince(std::uint32_t pass) const {
    std::size_t count = 0;
    for (std::size_t t = 0; t < complex_.slotCount(); ++t) {
      if (complex_.isLive(TetId(t)) && complex_.changedIn(TetId(t)) >= pass) ++count;
    }
    return count;
  }

  /// Striving goes on from the default, and may come back to it.
  void endDefault() {
    if (level_ == Optimization::kStrive) return beginJudging(Stage::kJudgeDefault);
    stage_ = Stage::kDone;
  }

  void beginJudging(Stage stage) {
    stage_ = stage;
    repeats_ = 0;
    sweeps_ = kJudgeSweeps;
    beginSweeps();
  }

  /// Above the low targets, elements between two sheets of the boundary without room for a node are
  /// left alone: nodes put there would only make more elements that miss.
  [[nodiscard]] bool isToBeMended(TetId tet) const {
    if (!complex_.isLive(tet) || complex_.cost(tet) <= 1.0) return false;
    return stage_ == Stage::kRepairLow || !isBetweenNearSheets<Space>(complex_, tet);
  }

  [[nodiscard]] double missing() const {
    double count = 0.0;
    for (std::size_t t = 0; t < complex_.slotCount(); ++t) {
      if (isToBeMended(TetId(t))) count += 1.0;
    }
    return count;
  }

  Optimization level_;
  const SizeField& field_;
  FieldHint hint_;
  std::size_t asked_ = 0;  ///< of the field: for nodes up to here
  std::size_t toAsk_;      ///< for nodes up to here
  std::size_t costed_ = 0;
  bool costing_ = false;
  TetComplex complex_;
  EdgeRemoval<Space> removal_;
  NodeMover<Space> mover_;
  EdgeSplitter<Space> splitter_;
  NodeCollapser<Space> collapser_;
  ElementRepair<Space> repair_;
  ElementRescue<Space> rescue_;
  ElementCost<Space> cost_{Measure::kBulk};
  Stage stage_ = Stage::kBuild;
  std::span<const Sweep> sweeps_;
  std::size_t sweep_ = 0;
  std::size_t next_ = 0;
  std::size_t sweepEnd_ = 0;
  std::uint32_t since_ = 0;
  std::array<std::uint32_t, kSweepKinds> lastRun_{};
  std::size_t changesInSweep_ = 0;
  std::size_t changes_ = 0;
  int repeats_ = 0;
  double meanCost_ = 0.0;      ///< of the elements, when the last round ended
  std::size_t lowTarget_ = 0;  ///< in kLowTargets
  std::size_t freeNodes_ = 0;  ///< when the last sweep ended: counting them is O(nodes)
  std::vector<TetId> bad_;
  RepairAim aim_ = RepairAim::kFewer;
  Judgement judgement_;  ///< as far as judged
  Judgement judgedDefault_;
  std::optional<VolumeMesh> defaultMesh_;  ///< what striving began with, unless it is no worse
  std::uint32_t repairsBegan_ = 0;         ///< the pass
  int easePasses_ = 1;
  bool isRescuing_ = false;
  std::size_t badBefore_ = 0;  ///< when the last pass of a repair began
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
