#include "sizing/achievable_sizes.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/diagnostics.h"
#include "field/grid_access.h"
#include "field/size_octree_builder.h"
#include "field/size_sites.h"
#include "sizing/target_sizes.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Inwards from coarse triangles, sizes fall by the growth per unit of distance, but no faster than the front can
/// follow. If the growth is 0, they fall by the default growth.
constexpr double kMaxDescent = 0.5;
constexpr double kDefaultDescent = 0.3;
/// Triangles with a longer edge are reported; length / target length.
constexpr double kTooCoarse = 2.0;

double minTargetSize(const SurfaceMesh& surface, const BackgroundGrid& grid,
                     const MeshOptions& options, const SizeField& field) {
  double smallest = options.size > 0.0 ? options.size : std::numeric_limits<double>::max();
  smallest = std::min(smallest, field.capOf(FieldHint::kAnyRegion));
  if (field.hasRegionCaps()) {
    for (const std::uint32_t region : surface.triangleRegions) {
      smallest = std::min(smallest, field.capOf(region));
    }
  }
  if (usesGrid(grid, options)) {
    for (const BackgroundNode& node : grid.nodes) smallest = std::min(smallest, node.size);
  }
  for (const SizeSource& source : grid.sources) smallest = std::min(smallest, source.size);
  return smallest;
}

Vec3 centroidOf(const SurfaceMesh& surface, TriangleId triangle) {
  const auto [a, b, c] = cornersOf(surface, triangle);
  return (a + b + c) / 3.0;
}

}  // namespace

AchievableSizes::AchievableSizes(const SurfaceMesh& surface, const BackgroundGrid& grid,
                                 const MeshOptions& options, SizeField& field)
    : surface_(surface),
      grid_(grid),
      options_(options),
      field_(field),
      explicit_(explicitTargetSizes(grid, options)),
      usesGrid_(usesGrid(grid, options)),
      minTarget_(minTargetSize(surface, grid, options, field)) {}

Task<> AchievableSizes::fitField(Work& work) {
  if (!hasTargetSizes(grid_, options_) && !field_.hasRegionCaps()) co_return;
  work.beginPart(0.2);
  co_await work.forEachBlock(surface_.triangles.size() / 3,
                             [this](std::size_t first, std::size_t last) {
                               for (std::size_t t = first; t < last; ++t)
                                 checkTriangle(TriangleId(t));
                             });
  work.beginPart(0.3);
  const std::vector<Vec3> points = pointsOf(surface_);
  const std::vector<double> lengths = co_await measureEdges(work, points);
  work.beginPart(0.6);
  co_await capField(work, points, lengths);
  work.beginPart(1.0);
  co_await raiseField(work, points, lengths);
}

/// Returns the mean length of the edges at each point. In a stretched field, the edges are measured after a linear map
/// that makes the target element regular.
Task<std::vector<double>> AchievableSizes::measureEdges(Work& work,
                                                        const std::vector<Vec3>& points) {
  std::vector<SymmetricTensor> maps;
  const std::size_t count = field_.isStretched() ? points.size() : 0;
  co_await work.forEachBlock(count, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const SymmetricTensor target = field_.targetTensorAt(points[i], hint_);
      maps.push_back(target.inverse().scaledBy(meanSizeOf(target)));
    }
  });
  std::vector<double> lengths = averagedEdgeLengths(points, surface_.triangles, maps);
  co_await work.yield();
  co_return lengths;
}

/// Caps the sizes of a grid by the lengths of the edges, unless all edges are longer than the grid's sizes.
Task<> AchievableSizes::capField(Work& work, const std::vector<Vec3>& points,
                                 const std::vector<double>& lengths) {
  if (!usesGrid_) co_return;
  const double cap = largestSizeOf(grid_);
  const auto isShorter = [&](double length) { return length > 0.0 && length < cap; };
  if (std::ranges::none_of(lengths, isShorter)) co_return;
  SizeOctreeBuilder builder(points, lengths, options_.growth, cap);
  co_await work.finish(builder);
  field_.capTo(builder.take());
}

/// Raises the sizes near edges that are longer than the smallest target size.
Task<> AchievableSizes::raiseField(Work& work, const std::vector<Vec3>& points,
                                   const std::vector<double>& lengths) {
  const auto isLonger = [&](double length) { return length > minTarget_; };
  if (std::ranges::none_of(lengths, isLonger)) co_return;
  const double descent =
      options_.growth > 0.0 ? std::min(options_.growth, kMaxDescent) : kDefaultDescent;
  work.beginPart(0.5);
  Floor floor = co_await findFloor(work, points, lengths, descent);
  work.beginPart(1.0);
  SizeOctreeBuilder builder(floor.positions, floor.sizes, SizeDescent{descent, minTarget_});
  floor = {};  // free its memory
  co_await work.finish(builder);
  field_.raiseTo(builder.take());
}

/// Returns the smallest achievable sizes at the nodes and at the centroids of the triangles. If the lengths at two
/// nodes differ by more than the descent allows, the longer one is reduced.
Task<AchievableSizes::Floor> AchievableSizes::findFloor(Work& work, const std::vector<Vec3>& points,
                                                        const std::vector<double>& lengths,
                                                        double descent) {
  SizeSites shortest(points, lengths, descent);
  work.beginPart(0.5);
  co_await shortest.build(work, 1);
  work.beginPart(1.0);
  Floor floor;
  SiteId nearest(0U);
  const auto add = [&](const Vec3& position) {
    // The next position is usually close to the last one. With its site as a guess, few sites are visited.
    const SizeSites::Value found = shortest.at(position, nearest);
    floor.positions.push_back(position);
    floor.sizes.push_back(found.size);
    nearest = found.site;
  };
  co_await work.forEachBlock(points.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (lengths[i] > 0.0) add(points[i]);
  });
  co_await work.forEachBlock(surface_.triangles.size() / 3,
                             [&](std::size_t first, std::size_t last) {
                               for (std::size_t t = first; t < last; ++t)
                                 add(centroidOf(surface_, TriangleId(t)));
                             });
  co_return floor;
}

void AchievableSizes::checkTriangle(TriangleId triangle) {
  const double coarseness = coarsenessOf(triangle);
  if (!(coarseness > kTooCoarse)) return;
  ++coarseCount_;
  if (!(coarseness > maxCoarseness_)) return;
  maxCoarseness_ = coarseness;
  coarsest_ = triangle;
}

/// Returns the largest ratio of a triangle's edge length / target length; 0 if it is certainly below kTooCoarse.
double AchievableSizes::coarsenessOf(TriangleId triangle) {
  const std::array<Vec3, 3> corners = cornersOf(surface_, triangle);
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, glm::length(corners[(k + 1) % 3] - corners[k]));
  if (!(longest > kTooCoarse * minTarget_)) return 0.0;
  const SizeField& target = usesGrid_ ? field_ : explicit_;
  const Vec3 centroid = centroidOf(surface_, triangle);
  double coarseness = 0.0;
  if (field_.hasRegionCaps()) {
    const std::uint32_t* regions = &surface_.triangleRegions[2 * triangle.index()];
    coarseness = longest / std::min(field_.capOf(regions[0]), field_.capOf(regions[1]));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = corners[k];
    const Vec3& b = corners[(k + 1) % 3];
    coarseness = std::max({coarseness, metricLength(target, a, b, hint_),
                           metricLengthAt(target, centroid, b - a, hint_)});
  }
  return coarseness;
}

std::vector<Diagnostic> AchievableSizes::diagnostics() const {
  if (coarseCount_ == 0) return {};
  // Ratios overflow for tiny sizes; files and messages need finite numbers.
  constexpr double kMaxRatio = 1e15;
  return {
      diagnose<DiagnosticCode::kCoarseSurface>(coarseCount_, std::min(maxCoarseness_, kMaxRatio))
          .withSeverity(Severity::kWarning)
          .about({entityOf(coarsest_)})
          .at(centroidOf(surface_, coarsest_))};
}

}  // namespace tetrafront
