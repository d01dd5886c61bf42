#include "preview/intersecting_patches.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "base/sort.h"
#include "geom/intersect.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "model/resolved_model.h"
#include "search/box_tree.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// A finer sampling at which an intersection of curved patches must persist.
struct Confirmation {
  std::uint32_t refinement;  ///< of the samples
  int maxPairs;              ///< pairs of patches that are sampled this finely
};
/// One after the other. At refinement 9, the distance of chords from their curves is 1/81 of that in the first samples.
/// Pairs beyond the limit are reported if an earlier pair was confirmed, and else left to the check of the mesh.
constexpr std::array<Confirmation, 2> kConfirmations{{{3, 16}, {9, 2}}};
/// Patches that were drawn many times all intersect each other.
constexpr std::size_t kMaxReported = 1000;
/// Pairs of triangles that are compared: this many, and this many more per triangle. Sensible models need far fewer.
/// More of them mean that all triangles are long and close to all others, as if a point of a curve is very far away.
constexpr std::size_t kMaxPairs = 2'000'000;
constexpr std::size_t kMaxPairsPerTriangle = 100;

Box boxOf(const std::array<Vec3, 3>& corners) {
  return Box::of(corners[0], corners[1], corners[2]);
}

bool overlap(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// Number of pairs of triangles that may still be compared.
struct PairBudget {
  std::size_t remaining = kMaxPairs;

  void spend(std::size_t pairs) { remaining -= std::min(remaining, pairs); }
};

/// The triangles of a sampled model, in a tree per patch.
class SampledPatches {
 public:
  SampledPatches(const SampledModel& sampled, PairBudget& budget)
      : sampled_(&sampled), budget_(&budget), trees_(sampled.isConforming.size()) {
    const std::vector<std::uint32_t>& corners = sampled.preview.patchTriangles;
    boxes_.reserve(corners.size() / 3);
    for (std::uint32_t t = 0; t < corners.size() / 3; ++t) boxes_.push_back(boxOf(cornersOf(t)));
    for (std::uint32_t patch = 0; patch < trees_.size(); ++patch) {
      if (sampled.isConforming[patch] == 0 || begin(patch) == end(patch)) continue;
      patches_.push_back(patch);
      Box box = boxes_[begin(patch)];
      for (std::uint32_t t = begin(patch); t < end(patch); ++t) box.include(boxes_[t]);
      patchBoxes_.push_back(box);
    }
    patchTree_ = BoxTree(patchBoxes_);
  }

  /// The patches that are tested, ascending.
  [[nodiscard]] std::span<const std::uint32_t> patches() const { return patches_; }

  /// Returns the patches, from entry `index` of patches() on, whose boxes overlap the box of this entry; ascending.
  [[nodiscard]] std::vector<std::uint32_t> nearPatches(std::size_t index) const {
    std::vector<std::uint32_t> near;
    patchTree_.visitOverlaps(patchBoxes_[index], [&](std::uint32_t k) {
      if (k >= index) near.push_back(patches_[k]);
    });
    stableSort(near);
    return near;
  }

  /// Returns a position at which the triangles of two patches, or of one, intersect; nothing if they do not, or if the
  /// budget is spent. Two curved patches may have the same triangle in the corner between two common lines: this is no
  /// intersection.
  [[nodiscard]] std::optional<Vec3> findIntersection(std::uint32_t a, std::uint32_t b,
                                                     bool areCurved) {
    const Box& regionA = boxOfPatch(a);
    const Box& regionB = boxOfPatch(b);
    const BoxTree& tree = treeOf(b);
    std::vector<std::uint32_t> near;
    for (std::uint32_t t = begin(a); t < end(a) && budget_->remaining > 0; ++t) {
      if (!overlap(boxes_[t], regionB) || isDegenerate(t)) continue;
      near.clear();
      tree.visitOverlaps(boxes_[t], [&](std::uint32_t i) {
        const std::uint32_t other = begin(b) + i;
        if ((a != b || other > t) && overlap(boxes_[other], regionA)) near.push_back(other);
      });
      stableSort(near);
      budget_->spend(near.size());
      for (const std::uint32_t other : near) {
        if (isDegenerate(other) || !intersectImproperly(numbered(t), numbered(other))) continue;
        if (areCurved && haveSameNodes(t, other)) continue;
        return intersectionPosition(cornersOf(t), cornersOf(other));
      }
    }
    return std::nullopt;
  }

  /// Returns false if no two triangles of the patch face in opposite directions: it then does not intersect itself.
  [[nodiscard]] bool canIntersectItself(std::uint32_t patch) const {
    Vec3 sum(0.0);
    for (std::uint32_t t = begin(patch); t < end(patch); ++t) sum += areaVector(t);
    for (std::uint32_t t = begin(patch); t < end(patch); ++t) {
      if (!(glm::dot(areaVector(t), sum) >= 0.0)) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] std::uint32_t begin(std::uint32_t patch) const {
    return sampled_->preview.patchOffsets[patch];
  }
  [[nodiscard]] std::uint32_t end(std::uint32_t patch) const {
    return sampled_->preview.patchOffsets[patch + 1];
  }

  [[nodiscard]] std::array<Vec3, 3> cornersOf(std::uint32_t t) const {
    const std::uint32_t* corner = &sampled_->preview.patchTriangles[3 * std::size_t{t}];
    const std::vector<double>& points = sampled_->preview.patchPoints;
    return {sampleAt(points, corner[0]), sampleAt(points, corner[1]), sampleAt(points, corner[2])};
  }

  [[nodiscard]] NumberedTriangle numbered(std::uint32_t t) const {
    const std::uint32_t* corner = &sampled_->preview.patchTriangles[3 * std::size_t{t}];
    const std::vector<std::uint32_t>& nodes = sampled_->nodes;
    return {{nodes[corner[0]], nodes[corner[1]], nodes[corner[2]]}, cornersOf(t)};
  }

  [[nodiscard]] bool haveSameNodes(std::uint32_t t, std::uint32_t other) const {
    return sorted(numbered(t).nodes) == sorted(numbered(other).nodes);
  }

  [[nodiscard]] bool isDegenerate(std::uint32_t t) const {
    const NumberedTriangle triangle = numbered(t);
    return hasRepeatedNode(triangle.nodes) ||
           collinear(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
  }

  [[nodiscard]] Vec3 areaVector(std::uint32_t t) const {
    const std::array<Vec3, 3> p = cornersOf(t);
    return glm::cross(p[1] - p[0], p[2] - p[0]);
  }

  [[nodiscard]] const Box& boxOfPatch(std::uint32_t patch) const {
    const auto at = std::ranges::lower_bound(patches_, patch);
    return patchBoxes_[static_cast<std::size_t>(at - patches_.begin())];
  }

  const BoxTree& treeOf(std::uint32_t patch) {
    if (!trees_[patch])
      trees_[patch].emplace(std::span(boxes_).subspan(begin(patch), end(patch) - begin(patch)));
    return *trees_[patch];
  }

  const SampledModel* sampled_;
  PairBudget* budget_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> patches_;  ///< see patches()
  std::vector<Box> patchBoxes_;         ///< per entry of patches_
  BoxTree patchTree_;
  std::vector<std::optional<BoxTree>> trees_;
};

class IntersectionSearch {
 public:
  IntersectionSearch(const Model& model, const CheckedModel& found, const SampledModel& sampled)
      : model_(&model), found_(&found), coarse_(sampled, budget_) {
    budget_.remaining += kMaxPairsPerTriangle * (sampled.preview.patchTriangles.size() / 3);
    const ResolvedModel resolved(model, found.usableLines);
    for (std::size_t patch = 0; patch < model.patches.size(); ++patch) {
      bool isExact = found.usablePatches[patch] != 0 && isPlanar(patch);
      if (isExact) {
        for (const Loop& loop : model.patches[patch].loops)
          for (const OrientedLine& walked : loop)
            isExact = isExact && resolved.curve(LineId(walked.line)).isStraight();
      }
      isExact_.push_back(isExact ? 1 : 0);
    }
  }

  std::vector<Diagnostic> run() {
    const std::span<const std::uint32_t> patches = coarse_.patches();
    for (std::size_t i = 0; i < patches.size(); ++i) {
      for (const std::uint32_t other : coarse_.nearPatches(i)) {
        if (diagnostics_.size() == kMaxReported || budget_.remaining == 0)
          return std::move(diagnostics_);
        if (const std::optional<Vec3> position = findIntersection(patches[i], other))
          report(patches[i], other, *position);
      }
    }
    return std::move(diagnostics_);
  }

 private:
  std::optional<Vec3> findIntersection(std::uint32_t a, std::uint32_t b) {
    if (a == b && (isPlanar(a) || !coarse_.canIntersectItself(a))) return std::nullopt;
    const bool areCurved = isExact_[a] == 0 || isExact_[b] == 0;
    const std::optional<Vec3> position = coarse_.findIntersection(a, b, areCurved);
    return position && areCurved ? confirm(a, b, *position) : position;
  }

  void report(std::uint32_t a, std::uint32_t b, const Vec3& position) {
    Diagnostic found = a == b ? diagnose<DiagnosticCode::kSelfIntersection>(1)
                              : diagnose<DiagnosticCode::kPatchesIntersect>(1);
    std::vector<Entity> patches{{EntityKind::kPatch, a}};
    if (a != b) patches.push_back({EntityKind::kPatch, b});
    diagnostics_.push_back(std::move(found).about(std::move(patches)).at(position));
  }

  [[nodiscard]] bool isPlanar(std::size_t patch) const {
    return model_->patches[patch].type == PatchType::kPlanar;
  }

  /// Samples of curved patches may intersect where the patches do not: tests finer samples.
  std::optional<Vec3> confirm(std::uint32_t a, std::uint32_t b, const Vec3& suspected) {
    std::optional<Vec3> position = suspected;
    const std::array<std::uint32_t, 2> both{a, b};
    for (std::size_t step = 0; step < kConfirmations.size(); ++step) {
      const auto [refinement, maxPairs] = kConfirmations[step];
      if (++sampledPairs_[step] > maxPairs) return ifAnyConfirmed(position);
      const SampledModel finer = sampleFinely(*model_, *found_, refinement, both);
      // Without finer samples, nothing is reported.
      if (finer.isConforming[a] == 0 || finer.isConforming[b] == 0) return std::nullopt;
      const std::optional<Vec3> found = SampledPatches(finer, budget_).findIntersection(a, b, true);
      if (!found) return budget_.remaining == 0 ? ifAnyConfirmed(position) : std::nullopt;
      position = found;
    }
    hasConfirmed_ = true;
    return position;
  }

  /// The result for pairs that are not tested further.
  [[nodiscard]] std::optional<Vec3> ifAnyConfirmed(const std::optional<Vec3>& position) const {
    return hasConfirmed_ ? position : std::nullopt;
  }

  const Model* model_;
  const CheckedModel* found_;
  PairBudget budget_;
  SampledPatches coarse_;
  /// Per patch: 1 if it is planar within straight lines, so that its samples are the patch itself.
  std::vector<std::uint8_t> isExact_;
  std::array<int, kConfirmations.size()> sampledPairs_{};  ///< per confirmation
  bool hasConfirmed_ = false;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace

std::vector<Diagnostic> findIntersectingPatches(const Model& model, const CheckedModel& found,
                                                const SampledModel& sampled) {
  return IntersectionSearch(model, found, sampled).run();
}

}  // namespace tetrafront
