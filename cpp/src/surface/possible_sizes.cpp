#include "surface/possible_sizes.h"

#include <algorithm>
#include <array>
#include <limits>

#include "field/size_sites.h"
#include "surface/surface_access.h"
#include "surface/wanted_sizes.h"

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

/// A size or nothing, and the sources.
SizeField askedBeside(const BackgroundGrid& grid, const MeshOptions& options) {
  constexpr double kAnySize = 1e300;
  SizeField asked = SizeField::uniform(options.size > 0.0 ? options.size : kAnySize);
  asked.addSources(grid.sources);
  return asked;
}

}  // namespace

PossibleSizes::PossibleSizes(const SurfaceMesh& surface, const BackgroundGrid& grid,
                             const MeshOptions& options, SizeField& field)
    : surface_(surface),
      options_(options),
      field_(field),
      asked_(askedBeside(grid, options)),
      usesGrid_(usesGrid(grid, options)),
      least_(leastAskedFor(grid, options)),
      isLooking_(asksForSizes(grid, options)) {}

bool PossibleSizes::advance(std::uint32_t budget) {
  if (isLooking_) {
    const auto triangles = static_cast<std::uint32_t>(surface_.triangles.size() / 3);
    const std::uint32_t last = next_ + std::min(budget, triangles - next_);
    for (; next_ < last; ++next_) look(next_);
    if (next_ < triangles) return false;
    isLooking_ = false;
    startFloor();
    return !builder_.has_value();
  }
  if (!builder_) return true;
  if (!builder_->advance(budget)) return false;
  field_.liftTo(builder_->take());
  builder_.reset();
  return true;
}

void PossibleSizes::look(std::uint32_t triangle) {
  const double coarseness = coarsenessOf(triangle);
  if (!(coarseness > kTooCoarse)) return;
  ++coarse_;
  if (!(coarseness > coarseness_)) return;
  coarseness_ = coarseness;
  coarsest_ = triangle;
}

double PossibleSizes::coarsenessOf(std::uint32_t triangle) {
  const std::array<Vec3, 3> corners = cornersOf(surface_, triangle);
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
    coarseness = std::max({coarseness, wantedLength(asked, a, b, hint_),
                           wantedLengthAt(asked, middle, b - a, hint_)});
  }
  return coarseness;
}

/// Where nobody asks for less than the surface has, there is nothing to lift.
void PossibleSizes::startFloor() {
  const std::vector<Vec3> points = pointsOf(surface_);
  std::vector<SymmetricTensor> views;
  if (usesGrid_ && field_.isStretched()) {
    views.reserve(points.size());
    for (const Vec3& point : points) {
      const SymmetricTensor wanted = field_.wantedTensorAt(point, hint_);
      views.push_back(wanted.inverse().scaledBy(meanSizeOf(wanted)));
    }
  }
  const std::vector<double> lengths = averagedEdgeLengths(points, surface_.triangles, views);
  if (std::ranges::none_of(lengths, [&](double length) { return length > least_; })) return;
  const double growth = options_.growth;
  const double descent = growth > 0.0 ? std::min(growth, kMostDescent) : kUsualDescent;
  // As lengths at nodes differ by more than that, the longer ones give way.
  const SizeSites shortest(points, lengths, descent);
  std::vector<Vec3> places;
  std::vector<double> held;
  const auto add = [&](const Vec3& place) {
    places.push_back(place);
    held.push_back(shortest.at(place, 0).size);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (lengths[i] > 0.0) add(points[i]);
  }
  for (std::uint32_t t = 0; t < surface_.triangles.size() / 3; ++t) {
    const std::array<Vec3, 3> corners = cornersOf(surface_, t);
    add((corners[0] + corners[1] + corners[2]) / 3.0);
  }
  builder_.emplace(places, held, SizeDescent{descent, least_});
}

std::vector<Diagnostic> PossibleSizes::diagnostics() const {
  if (coarse_ == 0) return {};
  Diagnostic found;
  found.code = DiagnosticCode::kCoarseSurface;
  found.severity = Severity::kWarning;
  found.entities = {{EntityKind::kTriangle, coarsest_}};
  found.hasPlace = true;
  const std::array<Vec3, 3> corners = cornersOf(surface_, coarsest_);
  found.place = (corners[0] + corners[1] + corners[2]) / 3.0;
  found.values = {static_cast<double>(coarse_), std::min(coarseness_, 1e15)};
  return {found};
}

}  // namespace tetrafront
