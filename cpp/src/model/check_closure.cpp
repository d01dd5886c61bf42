#include "model/check_closure.h"

#include <algorithm>
#include <utility>

#include "base/diagnostics.h"
#include "base/ids.h"
#include "geom/coordinates.h"

namespace tetrafront {
namespace {

/// One use of a line in a loop.
struct Use {
  PatchId patch;
  LineId line;
  bool reversed;
  bool inHole;
};

/// Two patches, or one patch with itself, that share a line.
struct Joint {
  PatchId first;
  PatchId second;
  LineId line;
  bool isKnown;     ///< the loops define the relative orientation of the two
  bool isOpposite;  ///< one of them must be flipped, if isKnown
};

class ClosureCheck {
 public:
  ClosureCheck(const Model& model, const CheckedModel& found)
      : model_(&model), found_(&found), uses_(model.lines.size()) {}

  Closure run() {
    gatherUses();
    result_.isPlain = true;
    for (const LineId line : IdRange<LineId>(uses_.size())) checkLine(line);
    const std::size_t count = model_->patches.size();
    std::vector<std::uint8_t> ignored(count, 0);
    result_.component = walk([](const Joint&) { return true; }, ignored);
    result_.isReversed.assign(count, 0);
    walk([](const Joint& joint) { return joint.isKnown; }, result_.isReversed);
    for (const Joint& joint : joints_) {
      result_.isPlain = result_.isPlain && joint.isKnown;
      const bool areOpposite =
          result_.isReversed[joint.first.index()] != result_.isReversed[joint.second.index()];
      if (joint.isKnown && areOpposite != joint.isOpposite) reportTwist(joint);
    }
    return std::move(result_);
  }

 private:
  void gatherUses() {
    for (const PatchId patch : IdRange<PatchId>(model_->patches.size())) {
      bool inHole = false;
      for (const Loop& loop : model_->patches[patch.index()].loops) {
        for (const OrientedLine& walked : loop) {
          if (walked.line >= uses_.size()) continue;
          uses_[found_->duplicates.lines[walked.line].index()].push_back(
              {patch, LineId(walked.line), walked.reversed, inHole});
        }
        inHole = true;
      }
    }
  }

  void checkLine(LineId line) {
    const std::vector<Use>& uses = uses_[line.index()];
    if (uses.size() == 1) reportOpen(line);
    if (uses.size() % 2 == 1) result_.isPlain = false;
    const auto isOuterSide = [&](const Use& use) {
      return !use.inHole && found_->usablePatches[use.patch.index()] != 0;
    };
    const bool isPlain =
        uses.size() == 2 && uses[0].line == uses[1].line && std::ranges::all_of(uses, isOuterSide);
    for (std::size_t i = 1; i < uses.size(); ++i) {
      joints_.push_back({uses[i - 1].patch, uses[i].patch, line, isPlain,
                         isPlain && uses[0].reversed == uses[1].reversed});
    }
  }

  /// Finds the components over the chosen joints, by their lowest patch; `isReversed` is the
  /// orientation of each patch relative to it.
  template <class Choose>
  std::vector<PatchId> walk(Choose choose, std::vector<std::uint8_t>& isReversed) const {
    const std::size_t count = model_->patches.size();
    std::vector<std::vector<std::uint32_t>> jointsOf(count);
    for (std::uint32_t j = 0; j < joints_.size(); ++j) {
      if (!choose(joints_[j])) continue;
      jointsOf[joints_[j].first.index()].push_back(j);
      jointsOf[joints_[j].second.index()].push_back(j);
    }
    std::vector<PatchId> lowest(count);
    std::vector<PatchId> waiting;
    for (const PatchId patch : IdRange<PatchId>(count)) {
      if (!lowest[patch.index()].isNone()) continue;
      lowest[patch.index()] = patch;
      waiting.push_back(patch);
      while (!waiting.empty()) {
        const PatchId from = waiting.back();
        waiting.pop_back();
        for (const std::uint32_t j : jointsOf[from.index()]) {
          const Joint& joint = joints_[j];
          const PatchId to = joint.first == from ? joint.second : joint.first;
          if (!lowest[to.index()].isNone()) continue;
          lowest[to.index()] = patch;
          isReversed[to.index()] = isReversed[from.index()] ^ (joint.isOpposite ? 1 : 0);
          waiting.push_back(to);
        }
      }
    }
    return lowest;
  }

  /// Reports a defect at a line.
  void report(Diagnostic found, LineId line) {
    if (const std::optional<Vec3> position = positionOn(line)) {
      found = std::move(found).at(*position);
    }
    result_.diagnostics.push_back(std::move(found));
  }

  [[nodiscard]] std::optional<Vec3> positionOn(LineId line) const {
    const std::vector<std::uint32_t>& points = model_->lines[line.index()].points;
    // The midpoint of a straight line; of others, a point on it.
    const std::size_t middle = points.size() / 2;
    if (points.empty()) return std::nullopt;
    const std::uint32_t from = points.size() == 2 ? points[0] : points[middle];
    const std::uint32_t to = points[middle];
    if (from >= model_->points.size() || to >= model_->points.size()) return std::nullopt;
    const Vec3 position = 0.5 * (model_->points[from] + model_->points[to]);
    return isFinite(position) ? std::optional(position) : std::nullopt;
  }

  void reportOpen(LineId line) {
    const Use& use = uses_[line.index()].front();
    report(diagnose<DiagnosticCode::kOpenEdge>(1).about({entityOf(use.line), entityOf(use.patch)}),
           line);
  }

  void reportTwist(const Joint& joint) {
    const auto [low, high] = std::minmax(joint.first, joint.second);
    std::vector<Entity> patches{entityOf(low)};
    if (high != low) patches.push_back(entityOf(high));
    report(diagnose<DiagnosticCode::kInconsistentOrientation>(1).about(std::move(patches)),
           joint.line);
  }

  const Model* model_;
  const CheckedModel* found_;
  std::vector<std::vector<Use>>
      uses_;  ///< per line; uses of duplicate lines are listed at the lowest of them
  std::vector<Joint> joints_;
  Closure result_;
};

}  // namespace

Closure checkClosure(const Model& model, const CheckedModel& found) {
  return ClosureCheck(model, found).run();
}

}  // namespace tetrafront
