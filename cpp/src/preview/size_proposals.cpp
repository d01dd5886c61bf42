// Sizes proposed from a model's shape. All three questions are put to the polylines and triangles
// of the preview:
//
//   uniform    a share of the diagonal of everything drawn
//   curvature  the turn from one piece of a line, or one triangle, to the next, per distance
//   gap        the first opposite triangle met along a triangle's normal, across the inside
//
// Each answer smaller than the uniform size would be a source; a source whose place the smaller
// ones before it already serve is left out, so that a bend gets about one per element, not one
// per sample.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "base/sort.h"
#include "field/size_sources.h"
#include "search/box_tree.h"
#include "preview/model_sampling.h"
#include "tetrafront/grid_tools.h"

namespace tetrafront {
namespace {

constexpr double kSmallestPerUniform = 1.0 / 50.0;

/// A place is served where the sources so far ask for no more than this times its own size.
constexpr double kServed = 1.25;

/// A turn of less than this between neighbours, as the length of the difference of two unit
/// vectors, is flat: the rounding of samples.
constexpr double kFlatTurn = 1e-6;
/// A turn of more than this (about 60 degrees) is a corner of the model, not a bend.
constexpr double kCornerTurn = 1.0;

/// An opposite wall looks back: the cosine between the normals is below the negative of this.
constexpr double kOpposite = 0.5;

/// So many sources are kept in a list before they all go into a tree.
constexpr std::size_t kBatch = 64;

/// To search around a triangle or a source costs as much as so many steps of other kinds.
constexpr std::uint32_t kBudgetPerSearch = 16;

/// Parts of a ray's length at which it starts, so as not to meet its own triangle.
constexpr double kRayStart = 1e-6;

Vec3 unitOf(const Vec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v * (1.0 / length) : Vec3(0.0);
}

struct Facet {
  std::array<Vec3, 3> corners;
  Vec3 centre;
  Vec3 normal;  ///< unit; zero where the facet has no area

  explicit Facet(const std::array<Vec3, 3>& c)
      : corners(c),
        centre((c[0] + c[1] + c[2]) * (1.0 / 3.0)),
        normal(unitOf(glm::cross(c[1] - c[0], c[2] - c[0]))) {}

  /// How far along the ray from `origin` the facet is met, or nothing.
  [[nodiscard]] std::optional<double> distanceAlong(const Vec3& origin, const Vec3& ray) const {
    const Vec3 u = corners[1] - corners[0];
    const Vec3 v = corners[2] - corners[0];
    const Vec3 cross = glm::cross(ray, v);
    const double determinant = glm::dot(u, cross);
    if (determinant == 0.0) return std::nullopt;
    const Vec3 from = origin - corners[0];
    const double a = glm::dot(from, cross) / determinant;
    const Vec3 other = glm::cross(from, u);
    const double b = glm::dot(ray, other) / determinant;
    if (!(a >= 0.0 && b >= 0.0 && a + b <= 1.0)) return std::nullopt;
    const double t = glm::dot(v, other) / determinant;
    return t > 0.0 ? std::optional<double>(t) : std::nullopt;
  }
};

}  // namespace

class SizeProposer::Impl {
 public:
  Impl(Model model, const ProposalOptions& options)
      : options_(options), model_(std::move(model)), sampler_(model_) {}

  bool advance(std::uint32_t budget) {
    if (stage_ == Stage::kDone || !step(budget)) return stage_ == Stage::kDone;
    stage_ = nextStage();
    next_ = 0;
    return stage_ == Stage::kDone;
  }

  [[nodiscard]] double fraction() const {
    if (stage_ == Stage::kDone) return 1.0;
    const std::size_t steps = std::max<std::size_t>(stepsOf(stage_), 1);
    const double within = stage_ == Stage::kSample
                              ? sampler_.fraction()
                              : static_cast<double>(next_) / static_cast<double>(steps);
    return (static_cast<double>(stage_) + within) / static_cast<double>(Stage::kDone);
  }

  [[nodiscard]] const SizeProposal& result() const { return proposal_; }

 private:
  enum class Stage : std::uint8_t {
    kSample,
    kFacets,
    kTree,
    kLines,
    kBends,
    kGaps,
    kSort,
    kThin,
    kDone
  };

  /// Lines, facets or offers that a stage goes through; 0 for those of one step and for the sampling.
  [[nodiscard]] std::size_t stepsOf(Stage stage) const {
    switch (stage) {
      case Stage::kFacets:
        return preview_.patchTriangles.size() / 3;
      case Stage::kLines:
        return std::max<std::size_t>(preview_.lineOffsets.size(), 1) - 1;
      case Stage::kBends:
      case Stage::kGaps:
        return facets_.size();
      case Stage::kThin:
        return offers_.size();
      default:
        return 0;
    }
  }

  /// Some of the present stage; whether that is over.
  bool step(std::uint32_t budget) {
    switch (stage_) {
      case Stage::kSample:
        return sample(budget);
      case Stage::kTree:
        buildTree();
        return true;
      case Stage::kSort:
        sortOffers();
        return true;
      default:
        break;
    }
    const std::size_t steps = stepsOf(stage_);
    const bool isSearch = stage_ == Stage::kGaps || stage_ == Stage::kThin;
    const std::uint32_t affordable = isSearch ? std::max(budget / kBudgetPerSearch, 1U) : budget;
    const std::size_t last = next_ + std::min<std::size_t>(affordable, steps - next_);
    for (; next_ < last; ++next_) workOn(next_);
    return next_ == steps;
  }

  void workOn(std::size_t i) {
    switch (stage_) {
      case Stage::kFacets:
        return addFacet(i);
      case Stage::kLines:
        return proposeAlong(i);
      case Stage::kBends:
        return proposeOnBendsOf(i);
      case Stage::kGaps:
        return proposeInGapsAt(facets_[i]);
      default:
        if (!isServed(offers_[order_[i]])) keep(offers_[order_[i]]);
    }
  }

  /// The one after the present that the model and the options ask for.
  Stage nextStage() {
    const bool looksAtBends = options_.elementsPerCircle > 0.0;
    switch (stage_) {
      case Stage::kSample:
        return proposal_.size > 0.0 ? Stage::kFacets : Stage::kDone;
      case Stage::kTree:
        if (looksAtBends) return Stage::kLines;
        [[fallthrough]];
      case Stage::kBends:
        facetAt_.clear();
        return options_.elementsPerGap > 0.0 ? Stage::kGaps : Stage::kSort;
      case Stage::kThin:
        proposal_.sources = std::move(kept_);
        return Stage::kDone;
      default:
        return static_cast<Stage>(static_cast<std::uint8_t>(stage_) + 1);
    }
  }

  bool sample(std::uint32_t budget) {
    if (!sampler_.advance(budget)) return false;
    preview_ = sampler_.take();
    if (const std::optional<Extent> extent = extentOf(preview_))
      diagonal_ = glm::length(extent->high - extent->low);
    largest_ = options_.uniform > 0.0 ? options_.uniform : kUniformPerDiagonal * diagonal_;
    smallest_ = options_.smallest > 0.0 ? options_.smallest : kSmallestPerUniform * largest_;
    proposal_.size = largest_ > 0.0 && std::isfinite(largest_) ? largest_ : 0.0;
    return true;
  }

  void addFacet(std::size_t triangle) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = sampleAt(preview_.patchPoints, preview_.patchTriangles[3 * triangle + k]);
    facets_.emplace_back(corners);
  }

  void buildTree() {
    std::vector<Box> boxes;
    boxes.reserve(facets_.size());
    for (const Facet& facet : facets_)
      boxes.push_back(Box::of(facet.corners[0], facet.corners[1], facet.corners[2]));
    tree_ = BoxTree(boxes);
  }

  void sortOffers() {
    order_.resize(offers_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    stableSort(order_, [this](std::uint32_t a, std::uint32_t b) {
      return offers_[a].size < offers_[b].size;
    });
  }

  void offer(SourceType type, const std::array<Vec3, 3>& points, double size) {
    if (!(size < largest_)) return;
    SizeSource source;
    source.type = type;
    source.points = points;
    source.size = std::max(size, smallest_);
    source.growth = options_.growth;
    offers_.push_back(source);
  }

  /// Two directions that differ by the chord `turn` over a distance bend with the radius
  /// distance / turn; as many elements as asked for go around a full turn of it.
  void offerBend(SourceType type, const std::array<Vec3, 3>& points, double turn, double distance) {
    if (!(turn > kFlatTurn && turn < kCornerTurn)) return;
    const double radius = distance / turn;
    offer(type, points, 2.0 * std::numbers::pi * radius / options_.elementsPerCircle);
  }

  void proposeAlong(std::size_t line) {
    const std::size_t last = preview_.lineOffsets[line + 1];
    for (std::size_t i = preview_.lineOffsets[line] + 1; i + 1 < last; ++i) {
      const Vec3 before = sampleAt(preview_.linePoints, i - 1);
      const Vec3 at = sampleAt(preview_.linePoints, i);
      const Vec3 after = sampleAt(preview_.linePoints, i + 1);
      const double turn = glm::length(unitOf(after - at) - unitOf(at - before));
      const double distance = 0.5 * (glm::length(at - before) + glm::length(after - at));
      offerBend(SourceType::kSegment, {before, at, at}, turn, distance);
      offerBend(SourceType::kSegment, {at, after, after}, turn, distance);
    }
  }

  /// Across those of its edges that earlier facets have too, the inner ones of a patch: the distance is
  /// that of the two corners opposite to the edge from it, halved, as normals belong to the middle of
  /// their facets.
  void proposeOnBendsOf(std::size_t facet) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = preview_.patchTriangles[3 * facet + k];
      const std::uint32_t b = preview_.patchTriangles[3 * facet + (k + 1) % 3];
      const auto [at, isNew] = facetAt_.try_emplace(std::minmax(a, b), facet);
      if (!isNew)
        offerAcross(sampleAt(preview_.patchPoints, a), sampleAt(preview_.patchPoints, b),
                    facets_[at->second], facets_[facet]);
    }
  }

  void offerAcross(const Vec3& a, const Vec3& b, const Facet& left, const Facet& right) {
    const Vec3 along = unitOf(b - a);
    const auto width = [&](const Facet& facet) {
      const Vec3 d = facet.centre - a;
      return 1.5 * glm::length(d - along * glm::dot(along, d));
    };
    const double turn = glm::length(left.normal - right.normal);
    const double distance = width(left) + width(right);
    offerBend(SourceType::kTriangle, left.corners, turn, distance);
    offerBend(SourceType::kTriangle, right.corners, turn, distance);
  }

  void proposeInGapsAt(const Facet& facet) {
    if (facet.normal == Vec3(0.0)) return;
    for (const double side : {1.0, -1.0}) {
      const std::optional<double> gap = gapAlong(facet, side * facet.normal);
      if (gap) offer(SourceType::kTriangle, facet.corners, *gap / options_.elementsPerGap);
    }
  }

  /// The distance to the next facet, if that looks back and what is between is inside the model.
  [[nodiscard]] std::optional<double> gapAlong(const Facet& facet, const Vec3& ray) const {
    const double reach = largest_ * options_.elementsPerGap;
    const Vec3 start = facet.centre + ray * (kRayStart * reach);
    const Vec3 end = facet.centre + ray * reach;
    std::optional<double> nearest;
    double cosine = 0.0;
    tree_.visitOverlaps(Box::of(start, end, end), [&](std::uint32_t item) {
      const std::optional<double> t = facets_[item].distanceAlong(start, ray);
      if (!t || *t > reach || (nearest && *t >= *nearest)) return;
      nearest = t;
      cosine = glm::dot(facets_[item].normal, ray);
    });
    if (!nearest || std::fabs(cosine) < kOpposite) return std::nullopt;
    return isInside(facet.centre + ray * (0.5 * *nearest)) ? nearest : std::nullopt;
  }

  /// By the number of facets met on the way out along x, slightly turned so as to meet no edges.
  [[nodiscard]] bool isInside(const Vec3& place) const {
    const Vec3 ray = unitOf(Vec3(1.0, 1.234567e-3, 2.345678e-3));
    const Vec3 end = place + ray * (2.0 * diagonal_);
    std::uint32_t met = 0;
    tree_.visitOverlaps(Box::of(place, end, end), [&](std::uint32_t item) {
      if (facets_[item].distanceAlong(place, ray)) ++met;
    });
    return met % 2 == 1;
  }

  [[nodiscard]] static std::size_t pointsOf(SourceType type) {
    return static_cast<std::size_t>(type) + 1;
  }

  /// Whether the sources kept ask for about this size at every corner and in the middle already.
  [[nodiscard]] bool isServed(const SizeSource& source) const {
    const std::size_t count = pointsOf(source.type);
    const double enough = kServed * source.size;
    std::array<Vec3, 4> places;
    Vec3 middle(0.0);
    for (std::size_t k = 0; k < count; ++k) {
      places[k] = source.points[k];
      middle += source.points[k] * (1.0 / static_cast<double>(count));
    }
    places[count] = middle;
    return std::all_of(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count) + 1,
                       [&](const Vec3& place) { return isServedAt(place, enough); });
  }

  [[nodiscard]] bool isServedAt(const Vec3& place, double enough) const {
    if (enlisted_.cappedSize(place, 2.0 * enough) <= enough) return true;
    return std::any_of(kept_.begin() + static_cast<std::ptrdiff_t>(enlistedCount_), kept_.end(),
                       [&](const SizeSource& other) { return sizeOf(other, place) <= enough; });
  }

  void keep(const SizeSource& source) {
    kept_.push_back(source);
    if (kept_.size() - enlistedCount_ < kBatch) return;
    enlisted_ = SizeSources(kept_);
    enlistedCount_ = kept_.size();
  }

  ProposalOptions options_;
  Model model_;
  ModelSampler sampler_;
  Stage stage_ = Stage::kSample;
  std::size_t next_ = 0;  ///< line, facet or offer of the present stage
  ModelPreview preview_;
  double diagonal_ = 0.0;
  double largest_ = 0.0;
  double smallest_ = 0.0;
  std::vector<Facet> facets_;
  BoxTree tree_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> facetAt_;  ///< an edge's first
  std::vector<SizeSource> offers_;
  std::vector<std::uint32_t> order_;  ///< of the offers, by size
  std::vector<SizeSource> kept_;
  SizeSources enlisted_;  ///< the first `enlistedCount_` of kept_
  std::size_t enlistedCount_ = 0;
  SizeProposal proposal_;
};

SizeProposer::SizeProposer(Model model, const ProposalOptions& options)
    : impl_(std::make_unique<Impl>(std::move(model), options)) {}
SizeProposer::SizeProposer(SizeProposer&&) noexcept = default;
SizeProposer& SizeProposer::operator=(SizeProposer&&) noexcept = default;
SizeProposer::~SizeProposer() = default;

bool SizeProposer::advance(std::uint32_t budget) { return impl_->advance(std::max(budget, 1U)); }
double SizeProposer::fraction() const { return impl_->fraction(); }
const SizeProposal& SizeProposer::result() const { return impl_->result(); }

SizeProposal proposeSizes(const Model& model, const ProposalOptions& options) {
  SizeProposer proposer(model, options);
  while (!proposer.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return proposer.result();
}

}  // namespace tetrafront
