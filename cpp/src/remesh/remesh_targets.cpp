#include "remesh/remesh_targets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "field/size_sites.h"
#include "geom/angles.h"
#include "remesh/automatic_sizes.h"
#include "remesh/cusps.h"
#include "sizing/expected_count.h"
#include "sizing/target_sizes.h"
#include "sizing/volume_sizes.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

// Automatic lengths / diagonal of the surface, or / size.
constexpr double kMaxSizePerDiagonal = 1.0 / 15.0;
constexpr double kMinSizePerDiagonal = 1.0 / 150.0;
/// As kMinSizePerDiagonal, if a background grid gives the sizes: it may ask for smaller ones than the shape.
constexpr double kMinGridSizePerDiagonal = 1.0 / 300.0;
constexpr double kMinSizePerSize = 0.1;
/// Smallest sizes at short feature lines and at narrow gaps / smallest automatic size. Triangles around a short line grow
/// quickly and are few; along a gap there are many.
constexpr double kLineSizePerMinSize = 1.0 / 1000.0;
constexpr double kGapSizePerMinSize = 1.0 / 25.0;
/// Largest number of triangles for which thin places get one good layer: a disc of 1/1000 of its radius has about 700 000 of them.
/// Thinner ones would have millions of elements.
constexpr double kMaxThinTriangles = 8e5;
/// Pieces of the given surface by which this number is estimated.
constexpr std::size_t kCountedPieces = 20'000;
/// Upper bound of the triangles that one size below the smallest one adds. Around a point at which the size is 1/1000 of
/// the smallest, and from which it grows by 0.3 per unit of distance, there are about 900.
constexpr double kTrianglesPerDetail = 1000.0;
constexpr double kTolerancePerDiagonal = 1.0 / 250.0;
/// As kTolerancePerDiagonal, if sizes are given.
constexpr double kCoarseTolerancePerDiagonal = 1.0 / 700.0;
constexpr double kTolerancePerSize = 0.05;
constexpr double kDegreesPerEdge = 36.0;
/// Angle per edge if sizes are given: a coarse limit that keeps round shapes round.
constexpr double kCoarseDegreesPerEdge = 60.0;
/// Tested tolerance / tolerance.
constexpr double kTestedTolerance = 0.85;
/// Deviation that automatic sizes aim at / tolerance. Edges may be 1.4 times as long as their size, and then deviate twice as
/// much. If that were beyond the tolerance, triangles would be short around a cylinder and long along its axis.
constexpr double kPlannedTolerance = 0.43;
/// As kPlannedTolerance, if sizes are given, so that they are reduced in few places.
constexpr double kCoarsePlannedTolerance = 0.7;
/// Deviation of the longest edges at a cusp from their feature lines / tested tolerance. Edges are between .75 and 1.4 times
/// their target length, and those that would leave the tolerance are not made.
constexpr double kCuspTolerance = 1.25;
/// Largest edge at a cusp / size that follows from the shape without gaps.
constexpr double kCuspPerSize = 1.6;
/// With a size factor f above 1, flat faces get coarser before curved ones: their largest size grows with this power of f, up to
/// a part of the diagonal; curved ones with f itself. Thin walls and gaps follow last, with a smaller power, up to a limit.
constexpr double kFlatPower = 1.5;
constexpr double kMaxFlatSizePerDiagonal = 1.0 / 2.0;
constexpr double kDetailPower = 0.5;
constexpr double kMaxDetailFactor = 1.5;
/// Limits of the angle per edge and of the tolerance, as a part of the diagonal, that a size factor may lead to.
constexpr double kMaxDegreesPerEdge = 100.0;
constexpr double kMaxTolerancePerDiagonal = 1.0 / 16.0;
/// Relative error of the sizes that the shape asks for.
constexpr float kSlack = 0.01F;
/// Upper bound of the sizes placed along lines where regions with a largest volume end.
constexpr double kMaxRimSites = 1e6;
/// Sizes sorted per unit of budget.
constexpr std::size_t kSitesPerUnit = 32;
/// Area of an equilateral triangle, in squared edge lengths.
constexpr double kTriangleArea = 0.4330127018922193;

double areaOf(const ReferenceSurface& reference) {
  double sum = 0.0;
  for (const ReferenceSurface::Piece& piece : reference.pieces()) sum += piece.area;
  return sum;
}

/// Returns 1 / h^2 in a plane with this unit normal, where h^2 is the product of the two principal sizes in the plane:
/// H^-1 scales areas in it by |H n| / det H.
double triangleDensity(const SymmetricTensor& h, const Vec3& normal) {
  return glm::length(h * normal) / h.determinant();
}

/// Returns the number of triangles that the sizes ask for on a piece of the surface.
double expectedOn(const ReferenceSurface& reference, const ReferenceSurface::Piece& piece,
                  const RemeshSizes& sizes, RemeshSizes::Hint& hint) {
  hint.field.region = sizes.regionOf(reference.patchOf(piece.triangle));
  if (!sizes.isStretched()) return trianglesOn(piece.area, sizes.sizeAt(piece.centroid, hint));
  const Vec3 normal = reference.normalOf(piece.triangle);
  return trianglesOn(piece.area, 1.0) *
         triangleDensity(sizes.tensorAt(piece.centroid, hint), normal);
}

/// Counts the triangles that the sizes ask for, per given triangle. O(pieces).
std::vector<double> countExpected(const ReferenceSurface& reference, const RemeshSizes& sizes) {
  std::vector<double> expected(countTriangles(reference.mesh()), 0.0);
  RemeshSizes::Hint hint;
  for (const ReferenceSurface::Piece& piece : reference.pieces())
    expected[piece.triangle.index()] += expectedOn(reference, piece, sizes, hint);
  return expected;
}

/// Estimates the number of all triangles that the sizes ask for, by every n-th piece.
double estimateExpected(const ReferenceSurface& reference, const RemeshSizes& sizes) {
  const std::vector<ReferenceSurface::Piece>& pieces = reference.pieces();
  const std::size_t stride = 1 + pieces.size() / kCountedPieces;
  RemeshSizes::Hint hint;
  double expected = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < pieces.size(); i += stride) {
    expected += expectedOn(reference, pieces[i], sizes, hint);
    area += pieces[i].area;
  }
  return area > 0.0 ? expected * areaOf(reference) / area : 0.0;
}

double sumOf(std::span<const double> counts) {
  return std::accumulate(counts.begin(), counts.end(), 0.0);
}

/// Caps the sizes by those of the shape.
Task<> capToShape(Work& work, const ShapeSizes& ofShape, const RemeshOptions& options,
                  RemeshSizes& sizes) {
  SizeSites sites(ofShape.positions, ofShape.sizes, options.growth, kSlack);
  co_await sites.build(work, kSitesPerUnit);
  sizes.capTo(std::move(sites), ofShape.axes);
}

/// Returns kTooManyElements if the sizes ask for more triangles than the limit, and than there are.
std::vector<Diagnostic> checkTriangleCount(const ReferenceSurface& reference,
                                           std::span<const double> expected,
                                           std::uint32_t maxTriangles) {
  const double total = sumOf(expected);
  const double limit = std::max(static_cast<double>(maxTriangles),
                                static_cast<double>(countTriangles(reference.mesh())));
  if (total <= limit) return {};
  const auto most = std::max_element(expected.begin(), expected.end()) - expected.begin();
  return {tooManyElements(total, limit)
              .about({{EntityKind::kTriangle, static_cast<std::uint32_t>(most)}})};
}

/// Returns the cusps. Their edges may exceed the sizes that curvature, thickness and short lines ask for by a factor only:
/// a small hole near the tip keeps its triangles.
Task<std::vector<Cusp>> findLimitedCusps(Work& work, const ReferenceSurface& reference,
                                         const ShapeSizes& sizes, const RemeshOptions& options,
                                         const RemeshLengths& lengths) {
  const CuspRules rules{lengths.minSize, lengths.maxSize, kCuspTolerance * lengths.testedTolerance};
  std::vector<Cusp> cusps = findCusps(reference, rules);
  co_await work.yield();
  const std::size_t count = sizes.countWithoutGaps;
  if (cusps.empty() || count == 0) co_return cusps;
  SizeSites sites(std::span(sizes.positions).first(count), std::span(sizes.sizes).first(count),
                  options.growth, kSlack);
  co_await sites.build(work, kSitesPerUnit);
  for (Cusp& cusp : cusps) {
    cusp.reach = std::min(cusp.reach, kCuspPerSize * sites.at(cusp.tip, SiteId(0U)).size);
  }
  co_return cusps;
}

/// Adds the sizes of regions at the feature lines where patches with larger sizes begin, so that sizes grow from there.
void addRegionSizes(const ReferenceSurface& reference, const RemeshSizes& given,
                    ShapeSizes& sizes) {
  struct Rim {
    const FeatureLine* line;
    double size;
  };
  std::vector<Rim> rims;
  double length = 0.0;
  for (const FeatureLine& line : reference.lines()) {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (const std::uint32_t patch : line.patches) {
      const double cap = given.capOf(given.regionOf(SmoothPatchId(patch)));
      smallest = std::min(smallest, cap);
      largest = std::max(largest, cap);
    }
    if (!(smallest < largest)) continue;
    rims.push_back({&line, smallest});
    length += line.length();
  }
  for (const auto& [line, size] : rims) {
    const double step = std::max(size, length / kMaxRimSites);
    for (double arc = 0.0; arc <= line->length(); arc += step) {
      sizes.positions.push_back(line->at(arc));
      sizes.sizes.push_back(size);
      sizes.axes.emplace_back(0.0);
    }
  }
}

}  // namespace

namespace {

/// The effect of RemeshOptions::sizeFactor on the automatic values.
struct SizeFactors {
  explicit SizeFactors(double f)
      : flat(f > 1.0 ? std::pow(f, kFlatPower) : f),
        curved(f),
        detail(f > 1.0 ? std::min(std::pow(f, kDetailPower), kMaxDetailFactor) : f),
        tolerance(f > 1.0 ? f * f : f) {}

  double flat;
  double curved;
  double detail;
  double tolerance;
};

}  // namespace

double automaticTolerance(const RemeshOptions& options, bool hasTargets, double diagonal) {
  const double factor = SizeFactors(options.sizeFactor).tolerance;
  const double share = hasTargets ? kCoarseTolerancePerDiagonal : kTolerancePerDiagonal;
  const double tolerance = std::min(factor * share, kMaxTolerancePerDiagonal) * diagonal;
  return options.size > 0.0 ? std::min(tolerance, kTolerancePerSize * options.size) : tolerance;
}

RemeshLengths remeshLengthsOf(const RemeshOptions& options, bool hasTargets, double diagonal,
                              double plannedShare) {
  const bool hasSize = options.size > 0.0;
  const SizeFactors factors(options.sizeFactor);
  RemeshLengths lengths{};
  lengths.maxSize =
      std::min(factors.flat * kMaxSizePerDiagonal, kMaxFlatSizePerDiagonal) * diagonal;
  if (options.maxSize > 0.0) lengths.maxSize = options.maxSize;
  if (hasTargets) lengths.maxSize = hasSize ? options.size : diagonal;
  if (options.maxVolume > 0.0) {
    lengths.maxSize = std::min(lengths.maxSize, sizeForVolume(options.maxVolume));
  }
  const double least = hasTargets ? kMinGridSizePerDiagonal : kMinSizePerDiagonal;
  lengths.minSize = factors.curved * (hasSize ? kMinSizePerSize * options.size : least * diagonal);
  if (options.minSize > 0.0) lengths.minSize = options.minSize;
  lengths.minSize = std::min(lengths.minSize, lengths.maxSize);
  const bool isExact = options.minSize > 0.0;
  lengths.minSizeAtLines = (isExact ? 1.0 : kLineSizePerMinSize) * lengths.minSize;
  lengths.minSizeAtGaps = (isExact ? 1.0 : kGapSizePerMinSize) * lengths.minSize;
  lengths.minSizeAtThinPlaces = isExact ? lengths.minSize : 0.0;
  lengths.tolerance = options.tolerance > 0.0 ? options.tolerance
                                              : automaticTolerance(options, hasTargets, diagonal);
  lengths.testedTolerance = kTestedTolerance * lengths.tolerance;
  lengths.plannedTolerance =
      (hasTargets ? kCoarsePlannedTolerance : kPlannedTolerance) * plannedShare * lengths.tolerance;
  // Curved faces then shrink by the factor, as all others do: an edge deviates by the square of its length.
  lengths.plannedTolerance *= std::min(1.0, options.sizeFactor);
  const double automatic = hasTargets ? kCoarseDegreesPerEdge : kDegreesPerEdge;
  const double degrees =
      std::min(factors.curved * automatic, std::max(kMaxDegreesPerEdge, automatic));
  lengths.radiansPerEdge = radians(options.anglePerEdge > 0.0 ? options.anglePerEdge : degrees);
  lengths.layers = options.layers;
  if (options.layers < 0.0) lengths.layers = hasTargets ? 0.0 : 1.0 / factors.detail;
  lengths.detailFactor = factors.detail;
  return lengths;
}

MeshOptions targetOptions(const RemeshOptions& options) {
  MeshOptions targets;
  targets.size = options.size;
  targets.growth = options.growth;
  targets.maxVolume = options.maxVolume;
  return targets;
}

double trianglesOn(double area, double size) { return area / (kTriangleArea * size * size); }

void setRegions(RemeshSizes& sizes, const ReferenceSurface& reference,
                std::span<const TriangleId> origin, const RegionSizes& ofRegions) {
  if (!ofRegions.areGiven()) return;
  // All triangles of a patch have the same regions beside them: more than two triangles meet where others begin.
  std::vector<std::uint32_t> regions(reference.patchCount(), FieldHint::kAnyRegion);
  for (std::size_t t = 0; t < origin.size(); ++t) {
    regions[reference.patchOf(TriangleId(t)).index()] = ofRegions.regionOf(origin[t].index());
  }
  sizes.setRegions(std::move(regions));
}

Task<TargetField> findTargetField(Work& work, const ReferenceSurface& reference,
                                  std::span<const TriangleId> origin, const GivenSizes& sizes,
                                  const RemeshOptions& options, const RemeshLengths& lengths) {
  MeshOptions targets = targetOptions(options);
  if (!usesGrid(sizes.grid, targets)) targets.size = lengths.maxSize;
  work.beginPart(0.2);
  TargetSizes given(reference.mesh(), sizes.grid, targets, EdgeSizes::kIgnored);
  co_await work.finish(given);
  TargetField found;
  found.diagnostics = given.diagnostics();
  if (anyError(found.diagnostics)) co_return found;
  SizeField field = given.take();
  const bool hasRegions = sizes.ofRegions.areGiven();
  if (hasRegions) sizes.ofRegions.cap(field, options.maxVolume);
  found.sizes.emplace(std::move(field));
  setRegions(*found.sizes, reference, origin, sizes.ofRegions);
  const std::vector<double> ofGiven = countExpected(reference, *found.sizes);
  found.diagnostics = checkTriangleCount(reference, ofGiven, options.maxTriangles);
  if (!found.diagnostics.empty()) co_return found;
  co_await work.yield();

  work.beginPart(0.7);
  const ShapeSizeRules rules{.maxSize = lengths.maxSize,
                             .minSize = lengths.minSize,
                             .minSizeAtLines = lengths.minSizeAtLines,
                             .minSizeAtGaps = lengths.minSizeAtGaps,
                             .minSizeAtThinPlaces = lengths.minSizeAtThinPlaces,
                             .tolerance = lengths.plannedTolerance,
                             .anglePerEdge = lengths.radiansPerEdge,
                             .layers = lengths.layers,
                             .detailFactor = lengths.detailFactor};
  found.ofShape = co_await findShapeSizes(work, reference, rules);
  ShapeSizes& ofShape = found.ofShape;
  if (hasRegions) addRegionSizes(reference, *found.sizes, ofShape);
  if (ofShape.positions.empty()) co_return found;
  work.beginPart(0.8);
  std::vector<Cusp> cusps = co_await findLimitedCusps(work, reference, ofShape, options, lengths);
  work.beginPart(1.0);
  const std::size_t belowMin = ofShape.countBelowMin;
  co_await capToShape(work, ofShape, options, *found.sizes);
  if (!ofShape.thinPlaces.empty()) {
    const double total = estimateExpected(reference, *found.sizes);
    const double limit = std::min(kMaxThinTriangles, static_cast<double>(options.maxTriangles));
    if (total > limit) {
      for (const ThinPlace& place : ofShape.thinPlaces) ofShape.sizes[place.index] = place.coarse;
      co_await capToShape(work, ofShape, options, *found.sizes);
    }
  }
  found.sizes->raiseTo(CuspSizes(std::move(cusps)));
  // Counting takes longer than this bound, which only very many small details exceed without need.
  const double most = sumOf(ofGiven) + trianglesOn(areaOf(reference), lengths.minSize) +
                      kTrianglesPerDetail * static_cast<double>(belowMin);
  if (most > static_cast<double>(options.maxTriangles)) {
    found.diagnostics =
        checkTriangleCount(reference, countExpected(reference, *found.sizes), options.maxTriangles);
  }
  co_await work.yield();
  co_return found;
}

}  // namespace tetrafront
