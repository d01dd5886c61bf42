#include "preview/intersecting_patches.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "base/sort.h"
#include "geom/intersect.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "model/resolved_model.h"
#include "search/box_tree.h"

namespace tetrafront {
namespace {

/// How much more finely suspects are sampled, one after the other. Chords of the last stray from
/// their curves by 1/81 of what those of the picture do.
constexpr std::array<std::uint32_t, 2> kRefinements{3, 9};
/// How many suspects are sampled so finely. The others share the fate of those before them: they
/// are believed if any of these was found guilty, and left to the check of the mesh otherwise.
constexpr std::array<int, 2> kMostLooks{16, 2};
/// So many findings are told: patches drawn many times over all meet one another.
constexpr std::size_t kMostReported = 1000;
/// So many pairs of triangles are compared in all, and so many more for each triangle: more than any
/// sensible model has. Beyond, all triangles are long and near all others, as of a curve with a point
/// flung far away.
constexpr std::size_t kMostCompared = 2'000'000;
constexpr std::size_t kMostComparedEach = 100;

Box boxOf(const std::array<Vec3, 3>& corners) {
  return Box::of(corners[0], corners[1], corners[2]);
}

bool overlap(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

/// Pairs of triangles that may still be compared.
struct Allowance {
  std::size_t left = kMostCompared;

  void take(std::size_t pairs) { left -= std::min(left, pairs); }
};

/// The triangles of a sampled model, by patches.
class SampledPatches {
 public:
  SampledPatches(const SampledModel& sampled, Allowance& allowance)
      : sampled_(&sampled), allowance_(&allowance), trees_(sampled.isJoined.size()) {
    const std::vector<std::uint32_t>& corners = sampled.preview.patchTriangles;
    boxes_.reserve(corners.size() / 3);
    for (std::uint32_t t = 0; t < corners.size() / 3; ++t) boxes_.push_back(boxOf(cornersOf(t)));
    for (std::uint32_t patch = 0; patch < trees_.size(); ++patch) {
      if (sampled.isJoined[patch] == 0 || begin(patch) == end(patch)) continue;
      patches_.push_back(patch);
      Box box = boxes_[begin(patch)];
      for (std::uint32_t t = begin(patch); t < end(patch); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
          box.low[k] = std::min(box.low[k], boxes_[t].low[k]);
          box.high[k] = std::max(box.high[k], boxes_[t].high[k]);
        }
      }
      patchBoxes_.push_back(box);
    }
    patchTree_ = BoxTree(patchBoxes_);
  }

  /// The patches that take part, ascending.
  [[nodiscard]] std::span<const std::uint32_t> patches() const { return patches_; }

  /// Of those from the one at `position` on, itself included, the ones whose boxes overlap its own;
  /// ascending.
  [[nodiscard]] std::vector<std::uint32_t> nearPatches(std::size_t position) const {
    std::vector<std::uint32_t> near;
    patchTree_.visitOverlaps(patchBoxes_[position], [&](std::uint32_t k) {
      if (k >= position) near.push_back(patches_[k]);
    });
    stableSort(near);
    return near;
  }

  /// Where the triangles of two patches, or of one, meet as they should not. In the corner of two
  /// common lines bent patches have one triangle, however much they part beyond it. Nothing more is
  /// found once the allowance is used up.
  [[nodiscard]] std::optional<Vec3> meetingPlace(std::uint32_t a, std::uint32_t b, bool areBent) {
    const Box& regionA = boxOfPatch(a);
    const Box& regionB = boxOfPatch(b);
    const BoxTree& tree = treeOf(b);
    std::vector<std::uint32_t> near;
    for (std::uint32_t t = begin(a); t < end(a) && allowance_->left > 0; ++t) {
      if (!overlap(boxes_[t], regionB) || isFlat(t)) continue;
      near.clear();
      tree.visitOverlaps(boxes_[t], [&](std::uint32_t i) {
        const std::uint32_t other = begin(b) + i;
        if ((a != b || other > t) && overlap(boxes_[other], regionA)) near.push_back(other);
      });
      stableSort(near);
      allowance_->take(near.size());
      for (const std::uint32_t other : near) {
        if (isFlat(other) || !meetImproperly(numbered(t), numbered(other))) continue;
        if (areBent && haveSameNodes(t, other)) continue;
        return tetrafront::meetingPlace(cornersOf(t), cornersOf(other));
      }
    }
    return std::nullopt;
  }

  /// False if all triangles of the patch face one way: then it cannot come round to itself.
  [[nodiscard]] bool mayMeetItself(std::uint32_t patch) const {
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

  [[nodiscard]] bool isFlat(std::uint32_t t) const {
    const NumberedTriangle triangle = numbered(t);
    const auto& [a, b, c] = triangle.nodes;
    return a == b || b == c || c == a ||
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
  Allowance* allowance_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> patches_;  ///< that take part, ascending
  std::vector<Box> patchBoxes_;         ///< of those
  BoxTree patchTree_;
  std::vector<std::optional<BoxTree>> trees_;
};

class MeetingSearch {
 public:
  MeetingSearch(const Model& model, const CheckedModel& found, const SampledModel& sampled)
      : model_(&model), found_(&found), coarse_(sampled, allowance_) {
    allowance_.left += kMostComparedEach * (sampled.preview.patchTriangles.size() / 3);
    const ResolvedModel resolved(model, found.usableLines);
    for (std::size_t patch = 0; patch < model.patches.size(); ++patch) {
      bool flat = found.usablePatches[patch] != 0 && isPlanar(patch);
      if (flat) {
        for (const Loop& loop : model.patches[patch].loops)
          for (const OrientedLine& walked : loop)
            flat = flat && resolved.curve(walked.line).isStraight();
      }
      isFlat_.push_back(flat ? 1 : 0);
    }
  }

  std::vector<Diagnostic> run() {
    const std::span<const std::uint32_t> patches = coarse_.patches();
    for (std::size_t i = 0; i < patches.size(); ++i) {
      for (const std::uint32_t other : coarse_.nearPatches(i)) {
        if (isEnough()) return std::move(diagnostics_);
        if (const std::optional<Vec3> place = meetingPlace(patches[i], other))
          report(patches[i], other, *place);
      }
    }
    return std::move(diagnostics_);
  }

 private:
  [[nodiscard]] bool isEnough() const {
    return diagnostics_.size() == kMostReported || allowance_.left == 0;
  }

  std::optional<Vec3> meetingPlace(std::uint32_t a, std::uint32_t b) {
    if (a == b && (isPlanar(a) || !coarse_.mayMeetItself(a))) return std::nullopt;
    const bool areBent = isFlat_[a] == 0 || isFlat_[b] == 0;
    const std::optional<Vec3> place = coarse_.meetingPlace(a, b, areBent);
    return place && areBent ? lookCloser(a, b, *place) : place;
  }

  void report(std::uint32_t a, std::uint32_t b, const Vec3& place) {
    Diagnostic& meeting = diagnostics_.emplace_back();
    meeting.code = a == b ? DiagnosticCode::kSelfIntersection : DiagnosticCode::kPatchesIntersect;
    meeting.entities = {{EntityKind::kPatch, a}};
    if (a != b) meeting.entities.push_back({EntityKind::kPatch, b});
    meeting.hasPlace = true;
    meeting.place = place;
    meeting.values = {1.0};
  }

  [[nodiscard]] bool isPlanar(std::size_t patch) const {
    return model_->patches[patch].type == PatchType::kPlanar;
  }

  /// Samples of bent patches may cross where the patches do not.
  std::optional<Vec3> lookCloser(std::uint32_t a, std::uint32_t b, const Vec3& before) {
    std::optional<Vec3> place = before;
    const std::array<std::uint32_t, 2> both{a, b};
    for (std::size_t step = 0; step < kRefinements.size(); ++step) {
      if (++looks_[step] > kMostLooks[step]) return asThoseBefore(place);
      const SampledModel finer = sampleFinely(*model_, *found_, kRefinements[step], both);
      // A patch whose finer samples cannot be made is given the benefit of the doubt.
      if (finer.isJoined[a] == 0 || finer.isJoined[b] == 0) return std::nullopt;
      const std::optional<Vec3> closer = SampledPatches(finer, allowance_).meetingPlace(a, b, true);
      if (!closer) return allowance_.left == 0 ? asThoseBefore(place) : std::nullopt;
      place = closer;
    }
    anyGuilty_ = true;
    return place;
  }

  /// For suspects that are not looked at any more closely.
  [[nodiscard]] std::optional<Vec3> asThoseBefore(const std::optional<Vec3>& place) const {
    return anyGuilty_ ? place : std::nullopt;
  }

  const Model* model_;
  const CheckedModel* found_;
  Allowance allowance_;
  SampledPatches coarse_;
  std::vector<std::uint8_t> isFlat_;  ///< planar within straight lines: the samples are the patch
  std::array<int, kRefinements.size()> looks_{};
  bool anyGuilty_ = false;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace

std::vector<Diagnostic> findIntersectingPatches(const Model& model, const CheckedModel& found,
                                                const SampledModel& sampled) {
  return MeetingSearch(model, found, sampled).run();
}

}  // namespace tetrafront
