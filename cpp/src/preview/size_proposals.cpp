// Sizes proposed from the samples of a model's shape:
//
//   uniform    a fraction of the diagonal of the whole model
//   curvature  the angle between neighbouring segments of a line, or neighbouring triangles, per distance
//   gap        the distance to the first opposite triangle along a normal, through the inside
//
// Each answer smaller than the uniform size proposes a source; SourceSelection keeps those that are needed.
//
// Remeshing measures the shape of a surface in another way (remesh/automatic_sizes.h), because it knows more: its triangles are
// closed and oriented. The samples of a model that is being drawn need not be, but their points lie on its true shape.

#include "tetrafront/size_proposals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "base/resumable.h"
#include "base/sort.h"
#include "base/task.h"
#include "base/tool_job.h"
#include "geom/measure.h"
#include "preview/model_sampler.h"
#include "preview/sampled_triangles.h"
#include "preview/source_selection.h"
#include "preview/surface_sampler.h"

namespace tetrafront {
namespace {

/// Smallest proposed size / uniform size, by default.
constexpr double kSmallestPerUniform = 1.0 / 50.0;
/// Limits of the angle between neighbours, as the length of the difference of two unit vectors. Below the first, it is
/// the rounding of samples. Above the second (about 60 degrees), it is a corner of the model.
constexpr double kMinBend = 1e-6;
constexpr double kMaxBend = 1.0;
/// Units of the budget for a search around a triangle or a source.
constexpr std::uint32_t kUnitsPerSearch = 16;

class Proposals {
 public:
  Proposals(Model model, const ProposalOptions& options)
      : options_(options), model_(std::move(model)) {}

  /// Call this once.
  Task<SizeProposal> propose(Work& work) {
    work.beginPart(0.3);
    const ModelPreview preview = co_await sampleModel(work, model_);
    if (!chooseLimits(preview)) co_return std::move(proposal_);
    work.beginPart(0.4);
    SampledTriangles triangles;
    co_await collectTriangles(work, preview, triangles);
    if (options_.elementsPerCircle > 0.0) {
      work.beginPart(0.5);
      co_await proposeForBends(work, preview, triangles);
    }
    if (options_.elementsPerGap > 0.0) {
      work.beginPart(0.75);
      co_await proposeForGaps(work, triangles);
    }
    work.beginPart(1.0);
    co_await selectSources(work);
    co_return std::move(proposal_);
  }

 private:
  /// Returns false if there is nothing to propose a size for.
  bool chooseLimits(const ModelPreview& preview) {
    const std::optional<Bounds> bounds = boundsOf(preview);
    const double diagonal = bounds ? glm::length(bounds->high - bounds->low) : 0.0;
    largest_ = options_.uniform > 0.0 ? options_.uniform : kUniformPerDiagonal * diagonal;
    smallest_ = options_.smallest > 0.0 ? options_.smallest : kSmallestPerUniform * largest_;
    proposal_.size = largest_ > 0.0 && std::isfinite(largest_) ? largest_ : 0.0;
    return proposal_.size > 0.0;
  }

  static Task<> collectTriangles(Work& work, const ModelPreview& preview,
                                 SampledTriangles& triangles) {
    const std::vector<std::uint32_t>& corners = preview.patchTriangles;
    co_await work.forEachBlock(corners.size() / 3, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        triangles.add({sampleAt(preview.patchPoints, corners[3 * t]),
                       sampleAt(preview.patchPoints, corners[3 * t + 1]),
                       sampleAt(preview.patchPoints, corners[3 * t + 2])});
    });
    triangles.buildTree();
    co_await work.yield();
  }

  void addCandidate(SourceType type, const std::array<Vec3, 3>& points, double size) {
    if (!(size < largest_)) return;
    SizeSource& source = candidates_.emplace_back();
    source.type = type;
    source.points = points;
    source.size = std::max(size, smallest_);
    source.growth = options_.growth;
  }

  // ---- curvature -------------------------------------------------------------------------------

  Task<> proposeForBends(Work& work, const ModelPreview& preview,
                         const SampledTriangles& triangles) {
    const std::size_t lines = std::max<std::size_t>(preview.lineOffsets.size(), 1) - 1;
    co_await work.forEachBlock(lines, [&](std::size_t first, std::size_t last) {
      for (std::size_t line = first; line < last; ++line) proposeAlongLine(preview, line);
    });
    std::map<Edge, std::size_t> firstTriangleAt;
    co_await work.forEachBlock(triangles.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        proposeAtEdgesOf(preview, triangles, t, firstTriangleAt);
    });
  }

  /// Two directions whose difference has the length `bend` over a distance belong to a curve of radius distance / bend.
  void addCandidateForBend(SourceType type, const std::array<Vec3, 3>& points, double bend,
                           double distance) {
    if (!(bend > kMinBend && bend < kMaxBend)) return;
    const double radius = distance / bend;
    addCandidate(type, points, 2.0 * std::numbers::pi * radius / options_.elementsPerCircle);
  }

  void proposeAlongLine(const ModelPreview& preview, std::size_t line) {
    const std::size_t last = preview.lineOffsets[line + 1];
    for (std::size_t i = preview.lineOffsets[line] + 1; i + 1 < last; ++i) {
      const Vec3 before = sampleAt(preview.linePoints, i - 1);
      const Vec3 at = sampleAt(preview.linePoints, i);
      const Vec3 after = sampleAt(preview.linePoints, i + 1);
      const double bend = glm::length(unitOf(after - at) - unitOf(at - before));
      const double distance = 0.5 * (glm::length(at - before) + glm::length(after - at));
      addCandidateForBend(SourceType::kSegment, {before, at, at}, bend, distance);
      addCandidateForBend(SourceType::kSegment, {at, after, after}, bend, distance);
    }
  }

  /// Two points of the samples, the lower index first.
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  /// Compares a triangle with earlier ones at the same edges: the interior edges of a patch.
  void proposeAtEdgesOf(const ModelPreview& preview, const SampledTriangles& triangles,
                        std::size_t triangle, std::map<Edge, std::size_t>& firstTriangleAt) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = preview.patchTriangles[3 * triangle + k];
      const std::uint32_t b = preview.patchTriangles[3 * triangle + (k + 1) % 3];
      const auto [entry, isNew] = firstTriangleAt.try_emplace(std::minmax(a, b), triangle);
      if (isNew) continue;
      proposeAcrossEdge(sampleAt(preview.patchPoints, a), sampleAt(preview.patchPoints, b),
                        triangles[entry->second], triangles[triangle]);
    }
  }

  /// The normals belong to the middles of the triangles, half their heights away from the edge. Half the height is 1.5
  /// times the distance of the centroid from the edge.
  void proposeAcrossEdge(const Vec3& a, const Vec3& b, const SampledTriangle& left,
                         const SampledTriangle& right) {
    const Vec3 along = unitOf(b - a);
    const auto halfHeight = [&](const SampledTriangle& triangle) {
      const Vec3 d = triangle.centroid - a;
      return 1.5 * glm::length(d - along * glm::dot(along, d));
    };
    const double bend = glm::length(left.normal - right.normal);
    const double distance = halfHeight(left) + halfHeight(right);
    addCandidateForBend(SourceType::kTriangle, left.corners, bend, distance);
    addCandidateForBend(SourceType::kTriangle, right.corners, bend, distance);
  }

  // ---- gaps ------------------------------------------------------------------------------------

  Task<> proposeForGaps(Work& work, const SampledTriangles& triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      proposeInGapsAt(triangles, triangles[t]);
      work.setFraction(static_cast<double>(t + 1) / static_cast<double>(triangles.size()));
      co_await work.spend(kUnitsPerSearch);
    }
  }

  void proposeInGapsAt(const SampledTriangles& triangles, const SampledTriangle& triangle) {
    if (triangle.normal == Vec3(0.0)) return;
    const double reach = largest_ * options_.elementsPerGap;
    for (const double side : {1.0, -1.0}) {
      const std::optional<double> gap = triangles.gapAlong(triangle, side * triangle.normal, reach);
      if (gap)
        addCandidate(SourceType::kTriangle, triangle.corners, *gap / options_.elementsPerGap);
    }
  }

  // ---- selection -------------------------------------------------------------------------------

  Task<> selectSources(Work& work) {
    std::vector<std::uint32_t> bySize(candidates_.size());
    std::iota(bySize.begin(), bySize.end(), 0U);
    stableSort(bySize, [this](std::uint32_t a, std::uint32_t b) {
      return candidates_[a].size < candidates_[b].size;
    });
    co_await work.yield();
    SourceSelection selection;
    for (std::size_t i = 0; i < bySize.size(); ++i) {
      selection.add(candidates_[bySize[i]]);
      work.setFraction(static_cast<double>(i + 1) / static_cast<double>(bySize.size()));
      co_await work.spend(kUnitsPerSearch);
    }
    proposal_.sources = selection.take();
  }

  ProposalOptions options_;
  Model model_;
  double largest_ = 0.0;
  double smallest_ = 0.0;
  std::vector<SizeSource> candidates_;
  SizeProposal proposal_;
};

}  // namespace

SizeProposer::SizeProposer(Model model, const ProposalOptions& options)
    : SlicedTool(makeToolJob<SizeProposal>(
          Proposals(std::move(model), options),
          [](Work& work, Proposals& proposals) { return proposals.propose(work); })) {}

SizeProposal proposeSizes(const Model& model, const ProposalOptions& options) {
  SizeProposer proposer(model, options);
  finish(proposer);
  return proposer.result();
}

}  // namespace tetrafront
