#include "arrangement/enclosed_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <ranges>
#include <span>
#include <utility>

#include "arrangement/arrangement.h"
#include "arrangement/low_triangles.h"
#include "arrangement/part_shells.h"
#include "boundary/weld.h"
#include "geom/coordinates.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Distances within which points of intersecting triangles are welded / extent of the surface, one per attempt.
constexpr std::array<double, 6> kWeldDistances{0.0, 0x1p-44, 0x1p-38, 0x1p-32, 0x1p-26, 0x1p-20};
/// Spacing of the coordinates of points that are welded within a wanted distance / extent of the surface, at least.
constexpr double kWeldedSpacing = 0x1p-38;
/// Wanted distances that are tried, each a quarter of the one before: welded within a large one, thin walls change their volume.
constexpr int kWeldAttempts = 3;
constexpr int kWeldAttemptBits = 2;
/// Rounds of an attempt in which points are welded within the distance of encloseSurface(); within that of the attempt in others.
constexpr std::uint32_t kWeldingRounds = 3;
/// Triangles after a round that are allowed per given one.
constexpr std::size_t kMaxGrowth = 20;
/// Largest number of triangles and pairs of all rounds / number of given triangles, for another attempt. 24 rounds of a part with
/// 35 000 triangles count 29; a soup with hundreds of pairs per triangle gets one attempt.
constexpr std::size_t kMaxWork = 100;
/// Number of triangles that is added to the given one, so that small surfaces get all attempts.
constexpr std::size_t kFreeTriangles = 1000;

/// Largest change of the volume by welding / volume.
constexpr double kMaxVolumeChange = 1e-3;

/// Returns six times the enclosed volume. `isInterface`: per triangle, whether there is inside on either side.
double sixfoldVolumeOf(const SurfaceMesh& mesh, std::span<const std::uint8_t> isInterface) {
  if (mesh.triangles.empty()) return 0.0;
  const Vec3 origin = pointOf(mesh, NodeId(mesh.triangles[0]));
  double sum = 0.0;
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    if (isInterface[t] != 0) continue;
    const auto [a, b, c] = cornersOf(mesh, TriangleId(t));
    sum += sixVolumesBelow(origin, a, b, c);
  }
  return sum;
}

/// Returns six times the volume of each region.
std::map<std::uint32_t, double> sixfoldRegionVolumes(const SurfaceMesh& mesh) {
  std::map<std::uint32_t, double> volumes;
  if (mesh.triangles.empty()) return volumes;
  const Vec3 origin = pointOf(mesh, NodeId(mesh.triangles[0]));
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    const auto [a, b, c] = cornersOf(mesh, TriangleId(t));
    const double sixfold = sixVolumesBelow(origin, a, b, c);
    volumes[mesh.triangleRegions[2 * std::size_t{t}]] += sixfold;
    volumes[mesh.triangleRegions[2 * std::size_t{t} + 1]] -= sixfold;
  }
  return volumes;
}

/// Returns the largest magnitude of the coordinates, rounded up to a power of two.
double extentOf(const SurfaceMesh& mesh) {
  double largest = 0.0;
  for (const std::uint32_t node : mesh.triangles) {
    largest = std::max(largest, magnitudeOf(pointOf(mesh, NodeId(node))));
  }
  int exponent = 0;
  static_cast<void>(std::frexp(largest, &exponent));
  return std::ldexp(1.0, exponent);
}

class Enclosing {
 public:
  Enclosing(const SurfaceMesh& given, const EnclosingLimits& limits)
      : given_(given), limits_(limits), extent_(extentOf(given)) {
    result_.isCut.assign(countTriangles(given), 0);
  }

  /// `weldDistance`: as encloseSurface().
  Task<std::vector<EnclosedSurface>> run(Work& work, double weldDistance) {
    for (std::size_t attempt = 0; attempt < kWeldDistances.size(); ++attempt) {
      work.beginPart(1.0 - std::ldexp(0.5, -static_cast<int>(attempt)));
      weldDistance_ = kWeldDistances[attempt] * extent_;
      spacing_ = weldDistance_;
      co_await resolve(work);
      if (result_.isResolved || isHopeless_) break;
      if (isTooMuchWork() && attempt + 1 < kWeldDistances.size()) {
        result_.reason = Unresolved::kTooMuchWork;
        result_.limit = workLimit();
        break;
      }
    }
    std::vector<EnclosedSurface> results;
    EnclosedSurface exact = std::move(result_);
    const double volume = hasRegions() ? 0.0 : sixfoldVolumeOf(exact.mesh, isInterface_);
    for (int i = 0; i < kWeldAttempts && exact.isResolved && results.empty(); ++i) {
      const double distance = weldDistance * std::ldexp(1.0, -kWeldAttemptBits * i);
      if (!(distance > std::max(spacing_, kWeldedSpacing * extent_)) || isTooMuchWork()) break;
      work.beginPart(1.0 - std::ldexp(0.5, -1 - i));
      co_await simplify(work, exact, distance);
      if (isSimplified(exact, volume)) results.push_back(std::move(result_));
    }
    results.push_back(std::move(exact));
    co_return results;
  }

 private:
  /// Resolves the surface again, with the points of intersecting triangles welded within a distance.
  Task<> simplify(Work& work, const EnclosedSurface& exact, double weldDistance) {
    result_.isCut = exact.isCut;
    result_.rounds = exact.rounds;
    result_.shared = exact.shared;
    weldDistance_ = weldDistance;
    spacing_ = std::max(spacing_, kWeldedSpacing * extent_);
    co_await resolve(work);
  }

  /// Returns whether the result is resolved, with the volume of the exact one: six times this volume is known.
  [[nodiscard]] bool isSimplified(const EnclosedSurface& exact, double sixfoldVolume) const {
    if (!result_.isResolved) return false;
    if (hasRegions()) {
      std::map<std::uint32_t, double> after = sixfoldRegionVolumes(result_.mesh);
      return std::ranges::all_of(sixfoldRegionVolumes(exact.mesh), [&](const auto& region) {
        const auto& [number, volume] = region;
        return std::fabs(after[number] - volume) <= kMaxVolumeChange * std::fabs(volume);
      });
    }
    const double change = sixfoldVolumeOf(result_.mesh, isInterface_) - sixfoldVolume;
    return std::fabs(change) <= kMaxVolumeChange * std::fabs(sixfoldVolume);
  }

  [[nodiscard]] std::size_t workLimit() const {
    return kMaxWork * (countTriangles(given_) + kFreeTriangles);
  }
  [[nodiscard]] bool isTooMuchWork() const { return spent_ > workLimit(); }

  void fail(Unresolved reason, TriangleId triangle, std::size_t limit = 0) {
    result_.reason = reason;
    result_.where = triangle.isNone() ? TriangleId{} : result_.origin[triangle.index()];
    result_.limit = limit;
  }

  Task<> resolve(Work& work) {
    begin();
    std::size_t pairsBefore = limits_.pairs;
    for (std::uint32_t round = 0; round <= limits_.rounds; ++round) {
      work.beginPart(1.0 - std::ldexp(0.5, -static_cast<int>(round)));
      // Welding within a large distance makes triangles intersect again, now and then the same ones.
      const double distance = round < kWeldingRounds ? weldDistance_ : spacing_;
      co_await weld(work, distance);
      removeDegenerateTriangles();
      if (result_.mesh.triangles.empty()) {
        fail(Unresolved::kNothingEnclosed, {});
        co_return;
      }
      Arrangement arrangement(result_.mesh);
      const bool isDone = co_await arrangement.run(work, pairsBefore);
      spent_ += countTriangles(result_.mesh) + arrangement.pairCount();
      result_.pairs = arrangement.pairCount();
      isHopeless_ = !isDone && round == 0;
      if (!isDone) {
        if (isHopeless_)
          fail(Unresolved::kTooManyPairs, arrangement.firstOfPair(), limits_.pairs);
        else
          fail(Unresolved::kRounding, arrangement.firstOfPair());
        co_return;
      }
      result_.isResolved = round > 0 && arrangement.pairCount() == 0;
      if (result_.isResolved) {
        fail(Unresolved::kNone, {});
        co_return;
      }
      fail(Unresolved::kRounding, arrangement.firstOfPair());
      ++result_.rounds;
      take(arrangement);
      if (hasRegions() && (areRegionsInconsistent_ || result_.shared.empty())) {
        isHopeless_ = true;
        co_return;
      }
      if (round == 0) {
        markGiven(arrangement);
      } else {
        pairsBefore = arrangement.pairCount();
      }
      const std::size_t most = kMaxGrowth * countTriangles(given_) + limits_.freeTriangles;
      if (countTriangles(result_.mesh) > most) {
        result_.reason = Unresolved::kTooMuchWork;
        result_.limit = most;
        isHopeless_ = round == 0;
        co_return;
      }
      co_await work.yield();
    }
  }

  /// Begins with the given surface. In later attempts, the points of triangles that intersect are welded first.
  void begin() {
    static_cast<TrackedSurface&>(result_) = trackedFrom(given_);
    result_.isResolved = false;
    areRegionsInconsistent_ = false;
    result_.deviation = 0.0;
    result_.sheetShare = 0.0;
    result_.reason = Unresolved::kNone;
    result_.where = {};
    result_.limit = 0;
    isInterface_.assign(countTriangles(given_), 0);
    isWeldable_.assign(countNodes(given_), 0);
    for (std::uint32_t t = 0; t < countTriangles(given_); ++t) {
      if (result_.isCut[t] == 0) continue;
      for (const NodeId node : nodesOf(given_, TriangleId(t))) isWeldable_[node.index()] = 1;
    }
  }

  /// Rounds the coordinates of weldable nodes to multiples of the spacing. Faces in one plane across an axis whose coordinates differ
  /// by roundings then coincide. Returns how far a node was moved at most.
  double roundToGrid() {
    double farthest = 0.0;
    if (!(spacing_ > 0.0)) return farthest;
    for (std::size_t i = 0; i < isWeldable_.size(); ++i) {
      if (isWeldable_[i] == 0) continue;
      const Vec3 before = pointOf(result_.mesh, NodeId(i));
      // Zero has one sign.
      for (std::size_t k = 0; k < 3; ++k) {
        double& x = result_.mesh.points[3 * i + k];
        x = std::round(x / spacing_) * spacing_ + 0.0;
      }
      farthest = std::max(farthest, glm::length(pointOf(result_.mesh, NodeId(i)) - before));
    }
    return farthest;
  }

  /// Welds used nodes with equal positions, and weldable ones within the distance of this attempt. What moves in several steps
  /// moves by at most the sum of their largest distances.
  Task<> weld(Work& work, double weldDistance) {
    SurfaceMesh& mesh = result_.mesh;
    result_.deviation += roundToGrid();
    std::vector<std::uint8_t> isUsed(countNodes(mesh), 0);
    for (const std::uint32_t node : mesh.triangles) isUsed[node] = 1;
    std::vector<NodeId> target(isUsed.size());
    for (std::uint32_t i = 0; i < target.size(); ++i) target[i] = NodeId(i);
    for (const double distance : {0.0, weldDistance}) {
      std::vector<NodeId> nodes;
      std::vector<double> points;
      for (std::uint32_t i = 0; i < isUsed.size(); ++i) {
        if (isUsed[i] == 0 || target[i] != NodeId(i) || (distance > 0.0 && isWeldable_[i] == 0))
          continue;
        nodes.emplace_back(i);
        const Vec3 p = pointOf(mesh, NodeId(i));
        points.insert(points.end(), {p.x, p.y, p.z});
      }
      const std::vector<NodeId> found = co_await findWeldTargets(work, points, distance);
      double farthest = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const NodeId onto = nodes[found[i].index()];
        target[nodes[i].index()] = onto;
        farthest = std::max(farthest, glm::length(pointOf(mesh, onto) - pointOf(mesh, nodes[i])));
      }
      result_.deviation += farthest;
    }
    for (std::uint32_t& node : mesh.triangles) node = target[target[node].index()].value;
    if (!(weldDistance > 0.0)) co_return;
    removeTrianglesWithRepeatedNodes();
    const LowTriangles left = co_await removeLowTriangles(work, mesh, weldDistance, isWeldable_);
    result_.deviation += left.deviation;
    inherit(result_, left.parents);
    isInterface_ = inherited(isInterface_, left.parents);
  }

  void removeTrianglesWithRepeatedNodes() { removeIf(hasRepeatedNode<NodeId>); }

  /// A closed surface stays closed, as a set of points: corners on one line enclose nothing.
  void removeDegenerateTriangles() {
    removeTrianglesWithRepeatedNodes();
    removeIf([this](const NodeTriple& nodes) {
      const auto [a, b, c] = nodes;
      return collinear(pointOf(result_.mesh, a), pointOf(result_.mesh, b),
                       pointOf(result_.mesh, c));
    });
  }

  /// Removes the triangles for whose nodes the condition holds.
  template <class Condition>
  void removeIf(const Condition& condition) {
    const std::vector<TriangleId> kept =
        removeTriangles(result_, [&](TriangleId t) { return condition(nodesOf(result_.mesh, t)); });
    isInterface_ = inherited(isInterface_, kept);
  }

  void markGiven(const Arrangement& arrangement) {
    for (std::uint32_t t = 0; t < givenTriangleOf_.size(); ++t) {
      if (arrangement.isCut(TriangleId(t))) result_.isCut[givenTriangleOf_[t].index()] = 1;
    }
  }

  /// Replaces the surface by the boundary of its inside, with rounded points.
  void take(const Arrangement& arrangement) {
    SurfaceMesh& mesh = result_.mesh;
    const CutPoints& points = arrangement.points();
    InsideBoundary inside = boundaryOfInside(mesh, arrangement, isInterface_);
    if (hasRegions()) takeShared(inside);
    result_.sheetShare = std::max(result_.sheetShare, inside.sheetArea / inside.area);
    givenTriangleOf_ = result_.origin;
    std::vector<std::uint32_t> nodeOf(points.size(), kNoIndex);
    std::vector<TriangleId> parents;
    mesh.triangles.clear();
    mesh.triangleRegions.clear();
    isInterface_.clear();
    for (const BoundaryPart& part : inside.parts) {
      const bool isCut = arrangement.isCut(part.origin);
      for (const CutPointId point : part.points) {
        std::uint32_t& node = nodeOf[point.index()];
        if (node == kNoIndex) node = points.isNode(point) ? point.value : addNode(points, point);
        mesh.triangles.push_back(node);
        if (isCut) isWeldable_[node] = 1;
      }
      parents.push_back(part.origin);
      isInterface_.push_back(part.isInterface ? 1 : 0);
    }
    inherit(result_, parents);
    if (!hasRegions()) return;
    for (const auto& [a, b] : std::views::transform(inside.parts, &BoundaryPart::regions)) {
      mesh.triangleRegions.insert(mesh.triangleRegions.end(), {a, b});
    }
  }

  [[nodiscard]] bool hasRegions() const { return !given_.triangleRegions.empty(); }

  /// Keeps the volumes that several of the given regions share.
  void takeShared(InsideBoundary& inside) {
    areRegionsInconsistent_ = areRegionsInconsistent_ || inside.areRegionsInconsistent;
    if (result_.rounds > 1) return;
    result_.shared = std::move(inside.shared);
  }

  std::uint32_t addNode(const CutPoints& points, CutPointId point) {
    const Vec3 p = points.rounded(point);
    const std::uint32_t node = countNodes(result_.mesh);
    result_.mesh.points.insert(result_.mesh.points.end(), {p.x, p.y, p.z});
    isWeldable_.push_back(0);
    return node;
  }

  const SurfaceMesh& given_;
  EnclosingLimits limits_;
  double extent_;
  double weldDistance_ = 0.0;
  double spacing_ =
      0.0;  ///< of the grid of coordinates: a power of two, or 0 if they are not rounded
  bool isHopeless_ = false;  ///< another attempt would fail alike
  bool areRegionsInconsistent_ = false;
  std::size_t spent_ = 0;  ///< triangles and pairs of all rounds
  EnclosedSurface result_;
  std::vector<std::uint8_t> isInterface_;    ///< per triangle
  std::vector<std::uint8_t> isWeldable_;     ///< per node
  std::vector<TriangleId> givenTriangleOf_;  ///< per triangle before the last change
};

}  // namespace

Task<std::vector<EnclosedSurface>> encloseSurface(Work& work, const SurfaceMesh& mesh,
                                                  double weldDistance, EnclosingLimits limits) {
  Enclosing enclosing(mesh, limits);
  std::vector<EnclosedSurface> results = co_await enclosing.run(work, weldDistance);
  co_return results;
}

TriangleId firstLeftOut(std::size_t givenTriangles, const EnclosedSurface& enclosed) {
  std::vector<std::uint8_t> isLeft(givenTriangles, 0);
  for (const TriangleId from : enclosed.origin) isLeft[from.index()] = 1;
  const auto first = std::ranges::find(isLeft, 0);
  if (first == isLeft.end()) return {};
  return TriangleId(static_cast<std::size_t>(first - isLeft.begin()));
}

}  // namespace tetrafront
