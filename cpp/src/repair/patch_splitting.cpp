#include "repair/patch_splitting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "base/tolerance.h"
#include "boundary/boundary_report.h"
#include "boundary/surface_checks.h"
#include "geom/angles.h"
#include "sizing/check_options.h"
#include "topology/edge_table.h"
#include "topology/smooth_triangles.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// What places a patch among others, in the order of importance; all of them are lengths. They belong to the shape: neither
/// the triangles nor their order change them by more than rounding.
constexpr std::size_t kKeys = 16;
using PatchKeys = std::array<double, kKeys>;

/// Coordinates in the order in which positions are compared: the height first.
constexpr std::array<int, 3> kAxes{2, 1, 0};

/// Measures the patch of some triangles.
PatchKeys keysOf(const SurfaceMesh& mesh, std::span<const TriangleId> members) {
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const TriangleId triangle : members) {
    for (const Vec3& corner : cornersOf(mesh, triangle)) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  // Relative to the box, so that far from the origin nothing cancels.
  const Vec3 middle = 0.5 * (low + high);
  double area = 0.0;
  Vec3 sum(0.0);
  Vec3 normal(0.0);
  Vec3 mixed(0.0);
  for (const TriangleId triangle : members) {
    const std::array<Vec3, 3> corners = cornersOf(mesh, triangle);
    const double own = areaOf(corners);
    area += own;
    normal += 0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    sum += own * (centroidOf(corners) - middle);
    // The integral of a product is exact at the midpoints of the edges.
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 at = 0.5 * (corners[k] + corners[(k + 1) % 3]) - middle;
      mixed += (own / 3.0) * Vec3(at.y * at.z, at.z * at.x, at.x * at.y);
    }
  }
  const double size = glm::length(high - low);
  const double perArea = area > 0.0 ? 1.0 / area : 0.0;
  const double perSize = size > 0.0 ? 1.0 / size : 0.0;
  const std::array<Vec3, 5> vectors{low, high, perArea * sum, size * perArea * normal,
                                    perArea * perSize * mixed};
  PatchKeys keys{};
  std::size_t key = 0;
  for (const Vec3& vector : vectors) {
    for (const int axis : kAxes) keys[key++] = vector[axis];
  }
  keys[key] = std::sqrt(area);
  return keys;
}

/// Sorts patches by their keys. Runs of keys that differ by rounding only are equal and sorted by the next key; comparing
/// two patches alone with a tolerance would not be transitive.
class PatchOrder {
 public:
  PatchOrder(const std::vector<PatchKeys>& keys, double tolerance)
      : keys_(keys), tolerance_(tolerance) {}

  /// Returns the patches in their order.
  std::vector<std::uint32_t> sorted() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t patch = 0; patch < keys_.size(); ++patch) order.push_back(patch);
    std::vector<Range> ranges{{0, order.size(), 0}};
    while (!ranges.empty()) {
      const Range range = ranges.back();
      ranges.pop_back();
      sortRange(order, range, ranges);
    }
    return order;
  }

 private:
  struct Range {
    std::size_t begin;
    std::size_t end;
    std::size_t key;
  };

  void sortRange(std::vector<std::uint32_t>& order, const Range& range,
                 std::vector<Range>& equals) const {
    const auto keyOf = [&](std::size_t i) { return keys_[order[i]][range.key]; };
    stableSort(std::span(order).subspan(range.begin, range.end - range.begin),
               [&](std::uint32_t a, std::uint32_t b) {
                 return keys_[a][range.key] < keys_[b][range.key];
               });
    std::size_t begin = range.begin;
    for (std::size_t i = range.begin + 1; i <= range.end; ++i) {
      if (i < range.end && keyOf(i) - keyOf(i - 1) <= tolerance_) continue;
      if (i - begin > 1 && range.key + 1 < kKeys) equals.push_back({begin, i, range.key + 1});
      begin = i;
    }
  }

  const std::vector<PatchKeys>& keys_;
  double tolerance_;
};

/// Returns the diagnostics of numbers that are invalid.
std::vector<Diagnostic> checkSplitting(const SurfaceMesh& mesh, double angle) {
  const std::array<OptionValue, 1> options{
      {{CheckedOption::kFeatureAngle, angle, angle >= kMinPatchAngle && angle <= kMaxPatchAngle}}};
  std::vector<Diagnostic> found = optionsOutOfRange(options);
  BoundaryReport report(mesh, BoundarySource::kGivenSurface);
  checkNumbers(mesh, report);
  const std::vector<Diagnostic> ofNumbers = report.take();
  found.insert(found.end(), ofNumbers.begin(), ofNumbers.end());
  return found;
}

}  // namespace

Task<PatchSplit> splitPatches(Work& work, const SurfaceMesh& mesh,
                              std::span<const std::uint32_t> groups, double angle) {
  PatchSplit split;
  split.diagnostics = checkSplitting(mesh, angle);
  if (!split.diagnostics.empty()) co_return split;
  if (groups.size() != countTriangles(mesh)) groups = {};
  work.beginPart(0.1);
  co_await work.yield();
  work.beginPart(0.4);
  const EdgeTable edges(mesh.triangles, countNodes(mesh), {});
  co_await work.yield();
  work.beginPart(0.7);
  const Bounds bounds = boundsOf(mesh);
  const Vec3 largest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  const double coordinate = std::max({largest.x, largest.y, largest.z});
  const SmoothTriangles smooth =
      findSmoothTriangles(mesh, edges, groups, cosineOfDegrees(angle), coordinate);
  co_await work.yield();

  work.beginPart(0.9);
  std::vector<PatchKeys> keys;
  std::vector<std::uint32_t> firstOf;
  split.trianglePatch.resize(countTriangles(mesh));
  forEachSmoothPatch(smooth.neighbours, [&](std::span<const TriangleId> members) {
    for (const TriangleId t : members) {
      split.trianglePatch[t.index()] = static_cast<std::uint32_t>(keys.size());
    }
    keys.push_back(keysOf(mesh, members));
    firstOf.push_back(members[0].value);
  });
  co_await work.yield();

  work.beginPart(1.0);
  const double tolerance = Tolerance::ofSingle(glm::length(bounds.high - bounds.low), coordinate);
  const std::vector<std::uint32_t> order = PatchOrder(keys, tolerance).sorted();
  std::vector<std::uint32_t> rankOf(order.size());
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
    rankOf[order[rank]] = rank;
    split.patchGroup.push_back(groups.empty() ? 0 : groups[firstOf[order[rank]]]);
  }
  for (std::uint32_t& patch : split.trianglePatch) patch = rankOf[patch];
  co_return split;
}

}  // namespace tetrafront
