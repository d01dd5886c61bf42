#include "sizing/achievable_sizes.h"

#include <algorithm>
#include <array>
#include <limits>

#include "field/size_sites.h"
#include "boundary/surface_access.h"
#include "sizing/target_sizes.h"

namespace tetrafront {
namespace {

/// Inwards from coarse triangles sizes fall by the growth per unit of distance, but no faster than
/// the front can follow, and by the usual one where sizes shall not grow at all.
constexpr double kMostDescent = 0.5;
constexpr double kUsualDescent = 0.3;
/// Triangles are told of whose edges are so many times as long as wanted.
constexpr double kTooCoarse = 2.0;

double leastAskedFor(const BackgroundGrid& grid, const MeshOptions& options) {
  double least = options.size > 0.0 ? options.size : std::numeric_limits<double>::max();
  if (usesGrid(grid, options)) {
    for (const BackgroundNode& node : grid.nodes) least = std::min(least, node.size);
  }
  for (const SizeSource& source : grid.sources) least = std::min(least, source.size);
  return least;
}

}  // namespace

AchievableSizes::AchievableSizes(const SurfaceMesh& surface, const BackgroundGrid& grid,
                                 const MeshOptions& options, SizeField& field)
    : surface_(surface),
      grid_(grid),
      options_(options),
      field_(field),
      asked_(explicitTargetSizes(grid, options)),
      usesGrid_(usesGrid(grid, options)),
      least_(leastAskedFor(grid, options)),
      stage_(hasTargetSizes(grid, options) ? Stage::kLook : Stage::kDone) {}

bool AchievableSizes::advance(std::uint32_t budget) {
  switch (stage_) {
    case Stage::kLook: {
      const auto triangles = static_cast<std::uint32_t>(surface_.triangles.size() / 3);
      const std::uint32_t last = next_ + std::min(budget, triangles - next_);
      for (; next_ < last; ++next_) look(next_);
      if (next_ < triangles) return false;
      points_ = pointsOf(surface_);
      stage_ = field_.isStretched() ? Stage::kView : Stage::kMeasure;
      return false;
    }
    case Stage::kView:
      viewSome(budget);
      if (views_.size() == points_.size()) stage_ = Stage::kMeasure;
      return false;
    case Stage::kMeasure:
      lengths_ = averagedEdgeLengths(points_, surface_.triangles, views_);
      views_ = {};
      startCeiling();
      stage_ = Stage::kCeiling;
      return false;
    case Stage::kCeiling:
      if (builder_ && !builder_->advance(budget)) return false;
      if (builder_) field_.cutTo(builder_->take());
      builder_.reset();
      stage_ = startFloor() ? Stage::kGiveWay : Stage::kDone;
      return stage_ == Stage::kDone;
    case Stage::kGiveWay:
      if (!giveWay(budget)) return false;
      builder_.emplace(places_, held_, SizeDescent{descent_, least_});
      shortest_.reset();
      places_ = {};
      held_ = {};
      stage_ = Stage::kFloor;
      return false;
    case Stage::kFloor:
      if (!builder_->advance(budget)) return false;
      field_.liftTo(builder_->take());
      builder_.reset();
      stage_ = Stage::kDone;
      break;
    case Stage::kDone:
      break;
  }
  return true;
}

void AchievableSizes::look(std::uint32_t triangle) {
  const double coarseness = coarsenessOf(triangle);
  if (!(coarseness > kTooCoarse)) return;
  ++coarse_;
  if (!(coarseness > coarseness_)) return;
  coarseness_ = coarseness;
  coarsest_ = triangle;
}

double AchievableSizes::coarsenessOf(std::uint32_t triangle) {
  const std::array<Vec3, 3> corners = cornersOf(surface_, TriangleId(triangle));
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, glm::length(corners[(k + 1) % 3] - corners[k]));
  }
  if (!(longest > kTooCoarse * least_)) return 0.0;
  const SizeField& asked = usesGrid_ ? field_ : asked_;
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  double coarseness = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = corners[k];
    const Vec3& b = corners[(k + 1) % 3];
    coarseness = std::max({coarseness, metricLength(asked, a, b, hint_),
                           metricLengthAt(asked, middle, b - a, hint_)});
  }
  return coarseness;
}

/// A stretched field's edges are measured as if it were not stretched.
void AchievableSizes::viewSome(std::uint32_t budget) {
  const std::size_t last =
      views_.size() + std::min<std::size_t>(budget, points_.size() - views_.size());
  while (views_.size() < last) {
    const SymmetricTensor wanted = field_.wantedTensorAt(points_[views_.size()], hint_);
    views_.push_back(wanted.inverse().scaledBy(meanSizeOf(wanted)));
  }
}

/// Where the grid asks for no more than the surface has, there is nothing to cut.
void AchievableSizes::startCeiling() {
  if (!usesGrid_) return;
  double most = 0.0;
  for (const BackgroundNode& node : grid_.nodes) {
    most = std::max(most, node.size * std::max(1.0, node.stretching));
  }
  const auto isShorter = [&](double length) { return length > 0.0 && length < most; };
  if (std::ranges::none_of(lengths_, isShorter)) return;
  builder_.emplace(points_, lengths_, options_.growth, most);
}

/// False where nobody asks for less than the surface has: there is nothing to lift.
bool AchievableSizes::startFloor() {
  if (std::ranges::none_of(lengths_, [&](double length) { return length > least_; })) return false;
  const double growth = options_.growth;
  descent_ = growth > 0.0 ? std::min(growth, kMostDescent) : kUsualDescent;
  shortest_.emplace(points_, lengths_, descent_);
  next_ = 0;
  return true;
}

/// At nodes and in the middle of triangles: as lengths at nodes differ by more than the descent, the
/// longer ones give way. True when all have.
bool AchievableSizes::giveWay(std::uint32_t budget) {
  if (!shortest_->advance(budget)) return false;
  const auto nodes = static_cast<std::uint32_t>(points_.size());
  const auto all = static_cast<std::uint32_t>(nodes + surface_.triangles.size() / 3);
  const std::uint32_t last = next_ + std::min(budget, all - next_);
  for (; next_ < last; ++next_) {
    if (next_ < nodes && !(lengths_[next_] > 0.0)) continue;
    if (next_ < nodes) {
      places_.push_back(points_[next_]);
    } else {
      const std::array<Vec3, 3> corners = cornersOf(surface_, TriangleId(next_ - nodes));
      places_.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
    }
    // The next place is mostly near the last one: asked from there, few sites are looked at.
    const SizeSites::Value found = shortest_->at(places_.back(), nearest_);
    held_.push_back(found.size);
    nearest_ = found.site;
  }
  return next_ == all;
}

std::vector<Diagnostic> AchievableSizes::diagnostics() const {
  if (coarse_ == 0) return {};
  Diagnostic found;
  found.code = DiagnosticCode::kCoarseSurface;
  found.severity = Severity::kWarning;
  found.entities = {{EntityKind::kTriangle, coarsest_}};
  found.hasPlace = true;
  const std::array<Vec3, 3> corners = cornersOf(surface_, TriangleId(coarsest_));
  found.place = (corners[0] + corners[1] + corners[2]) / 3.0;
  found.values = {static_cast<double>(coarse_), std::min(coarseness_, 1e15)};
  return {found};
}

}  // namespace tetrafront
