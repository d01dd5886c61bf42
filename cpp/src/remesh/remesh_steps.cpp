#include "remesh/remesh_steps.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "boundary/boundary.h"
#include "geom/angles.h"
#include "remesh/detail_merger.h"
#include "remesh/model_remeshing.h"
#include "remesh/reference_surface.h"
#include "remesh/rules.h"
#include "remesh/triangle_parts.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Returns true if the smallest angle is larger, without much poorer triangles on average.
bool isBetter(const SurfaceRemesh& one, const SurfaceRemesh& other) {
  return isComplete(one) && one.smallestAngle > other.smallestAngle &&
         one.meanRadiusRatio > std::min(other.meanRadiusRatio - kRatioCost, kFineRatio);
}

/// Returns true if triangles are poor, and not everywhere. If details are chosen, they may be poor everywhere.
bool isWorthSteps(const Remeshing& remeshing, const SurfaceRemesh& result,
                  double poorAngle = kPoorAngle) {
  return !remeshing.isStopped && isComplete(result) && result.smallestAngle < poorAngle &&
         (remeshing.options.dropDetails > 0.0 || result.meanRadiusRatio >= kPoorRatio);
}

/// Details to drop, and the shares of the tolerance of the remeshing after that.
struct DetailRule {
  double distance;
  DetailChoice choice;
  PassRules remeshing;
  double largestShare = 1.0;  ///< of the triangles: number of details
  /// Whether the surface has been remeshed: its well-shaped triangles away from the details then stay, and it is remeshed even
  /// if it has no details.
  bool isRemeshed = false;
  std::size_t unsettled = 0;  ///< number of the last triangles that do not stay
};

/// What came of dropping details: no surface, if there are none or too many, if none may be dropped, or if the work was stopped;
/// or one that has been remeshed.
enum class Dropped : std::uint8_t { kNone, kTooMany, kMade };

/// Unsettles all nodes of the triangles that have an unsettled one.
void spreadUnsettled(const SurfaceMesh& mesh, std::vector<std::uint8_t>& isSettled) {
  const std::vector<std::uint8_t> before = isSettled;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const NodeTriple nodes = nodesOf(mesh, t);
    if (std::ranges::all_of(nodes, [&](NodeId node) { return before[node.index()] != 0; }))
      continue;
    for (const NodeId node : nodes) isSettled[node.index()] = 0;
  }
}

/// Marks the nodes of a remeshed surface around which triangles are well-shaped, and where they were before details were
/// dropped. `parents`: per triangle, the one of `before` that it comes from. `unsettled`: as in the rule. O(triangles).
std::vector<std::uint8_t> settledNodes(const SurfaceMesh& mesh, const SurfaceMesh& before,
                                       std::span<const TriangleId> parents, std::size_t unsettled) {
  std::vector<std::uint8_t> isSettled(mesh.points.size() / 3, 1);
  const double largestCosine = cosineOfDegrees(kUnsettledAngle);
  const std::size_t settledCount = countTriangles(before) - unsettled;
  for (const TriangleId t : IdRange<TriangleId>(parents.size())) {
    const std::array<Vec3, 3> corners = cornersOf(mesh, t);
    const bool isWhereItWas = corners == cornersOf(before, parents[t.index()]);
    const bool mayStay = isWhereItWas && parents[t.index()].index() < settledCount;
    if (mayStay && largestCosineOf(corners) <= largestCosine) continue;
    for (const NodeId node : nodesOf(mesh, t)) isSettled[node.index()] = 0;
  }
  for (int i = 0; i < kUnsettledDepth; ++i) spreadUnsettled(mesh, isSettled);
  return isSettled;
}

/// Drops details of the given or a remeshed surface, and remeshes it, unless a given surface has none, or more than a share of
/// the triangles. Keeps all details if a region would be left without volume.
Task<Dropped> simplify(Work& work, const Remeshing& remeshing, const TrackedSurface& surface,
                       const DetailRule& rule, SimplifiedSurface& simplified) {
  work.beginPart(0.06);
  const RemeshOptions& options = remeshing.options;
  std::optional<ReferenceSurface> ofRemeshed;
  if (rule.isRemeshed) {
    ofRemeshed.emplace(remeshing.reference.of(surface.mesh));
    co_await ofRemeshed->prepare(work);
  }
  const ReferenceSurface& reference = rule.isRemeshed ? *ofRemeshed : remeshing.reference;
  DetailMerger merger(reference, rule.distance, rule.choice);
  Job<> merging([&](Work& inner) { return merger.run(inner); });
  if (!co_await finishUnlessStopped(work, merging, remeshing.isStopped)) co_return Dropped::kNone;
  const double largest =
      std::max(kFewDetails, rule.largestShare * static_cast<double>(surface.origin.size()));
  const auto count = static_cast<double>(merger.merged().size());
  const bool isUseless = count == 0.0 && !rule.isRemeshed;
  if (isUseless) co_return Dropped::kNone;
  if (count > largest) co_return Dropped::kTooMany;
  TrackedSurface made = surface;
  std::vector<TriangleId> parents;
  merger.copyTo(made.mesh, parents);
  inherit(made, parents);
  PassRules rules = rule.remeshing;
  if (rule.isRemeshed)
    rules.isSettled = settledNodes(made.mesh, surface.mesh, parents, rule.unsettled);
  SurfaceMesh checked = made.mesh;
  BoundaryCheck boundary(checked, BoundarySource::kGivenSurface, options.innerShells);
  boundary.setEmbedded();
  co_await work.finish(boundary);
  if (anyError(boundary.takeDiagnostics())) co_return Dropped::kNone;
  simplified.deviation += merger.deviation();
  simplified.merged.insert(simplified.merged.end(), merger.merged().begin(), merger.merged().end());
  work.beginPart(0.1);
  ReferenceSurface next = remeshing.reference.of(made.mesh);
  co_await next.prepare(work);
  work.beginPart(1.0);
  simplified.pass =
      co_await remeshOnce(work, next, made, remeshing.sizes, options, rules, remeshing.isStopped);
  // Between the surface of this step and the result, not between the given one and it.
  simplified.pass.remesh.triangleDeviation.clear();
  simplified.deviation += simplified.pass.remesh.deviation;
  co_return Dropped::kMade;
}

/// Simplifies a surface; if that makes none, the progress of this work is left to what follows.
Task<Dropped> simplifyOrLeave(Work& work, const Remeshing& remeshing, const TrackedSurface& surface,
                              const DetailRule& rule, SimplifiedSurface& simplified) {
  work.beginPart(1.0);
  const Dropped dropped = co_await simplify(work, remeshing, surface, rule, simplified);
  if (dropped != Dropped::kMade) work.leaveRest();
  co_return dropped;
}

/// Returns the rules of a step that has a share of the tolerance.
PassRules rulesOfShare(double share, double plannedShare, bool isOnFaces = false) {
  return {.toleranceShare = share,
          .plannedShare = plannedShare,
          .samples = false,
          .isOnFaces = isOnFaces};
}

/// Up to three times drops details across which triangles are poor, within the rest of the tolerance, and remeshes around them.
/// Keeps the surface if the last one is not better. `isOnFaces`: whether the triangles are on the faces of a model, where only poor
/// ones change.
Task<> dropPoorDetails(Work& work, const Remeshing& remeshing, SimplifiedSurface& surface,
                       bool isOnFaces = false) {
  const double poorAngle = isOnFaces ? kUnsettledAngle : kPoorAngle;
  if (!isWorthSteps(remeshing, surface.pass.remesh, poorAngle)) co_return;
  const double tolerance = remeshing.lengths.tolerance;
  SimplifiedSurface next = surface;
  Dropped dropped = Dropped::kMade;
  for (int i = 1; i <= kMaxPoorMerges && dropped == Dropped::kMade; ++i) {
    if (!isWorthSteps(remeshing, next.pass.remesh, poorAngle)) break;
    work.beginPart(static_cast<double>(i) / kMaxPoorMerges);
    const TrackedSurface from = next.pass.surface;
    const double left = (1.0 - kNextShare) * tolerance - (next.deviation - next.ofChosen);
    if (!(left > 0.0)) break;
    const DetailRule rule{.distance = std::min(left, kMergeShare * tolerance),
                          .choice = DetailChoice::kPoor,
                          .remeshing = rulesOfShare(kNextShare, kFirstShare, isOnFaces),
                          .isRemeshed = true};
    dropped = co_await simplify(work, remeshing, from, rule, next);
  }
  if (isBetter(next.pass.remesh, surface.pass.remesh)) surface = std::move(next);
}

/// Drops the details of the given surface below a distance, and remeshes it. Needs few triangles at a detail: if they are
/// needles along a strip, the nodes of both lines lie anywhere, and a merged line is ragged.
Task<Dropped> remeshWithoutGiven(Work& work, const Remeshing& remeshing,
                                 SimplifiedSurface& surface) {
  const DetailRule rule{
      .distance = kGivenMergeShare * remeshing.lengths.tolerance,
      .choice = DetailChoice::kAll,
      .remeshing = rulesOfShare(kFirstShareAfterMerges, kFirstShareAfterMerges),
      .largestShare = kNeedleShare,
  };
  work.beginPart(0.85);
  const Dropped dropped = co_await simplifyOrLeave(work, remeshing, remeshing.given, rule, surface);
  if (dropped == Dropped::kMade) {
    work.beginPart(1.0);
    co_await dropPoorDetails(work, remeshing, surface);
  } else {
    work.leaveRest();
  }
  co_return dropped;
}

/// Remeshes the given surface with a part of the tolerance first, which makes its triangles well-shaped, and then drops details:
/// all below RemeshOptions::dropDetails, then those across which triangles are poor. The deviations of all steps, except
/// the one of chosen details, add up to at most the tolerance.
Task<SimplifiedSurface> remeshInSteps(Work& work, const Remeshing& remeshing) {
  const RemeshOptions& options = remeshing.options;
  SimplifiedSurface surface;
  work.beginPart(0.6);
  surface.pass =
      co_await remeshOnce(work, remeshing.reference, remeshing.given, remeshing.sizes, options,
                          rulesOfShare(kFirstShare, kFirstShare), remeshing.isStopped);
  surface.deviation = surface.pass.remesh.deviation;
  if (options.dropDetails > 0.0 && isComplete(surface.pass.remesh)) {
    work.beginPart(0.7);
    const TrackedSurface from = surface.pass.surface;
    const DetailRule rule{.distance = options.dropDetails,
                          .choice = DetailChoice::kAll,
                          .remeshing = rulesOfShare(kNextShare, kFirstShare),
                          .isRemeshed = true};
    const double before = surface.deviation;
    if (co_await simplify(work, remeshing, from, rule, surface) == Dropped::kMade) {
      surface.ofChosen = surface.deviation - before - surface.pass.remesh.deviation;
    }
  }
  work.beginPart(1.0);
  co_await dropPoorDetails(work, remeshing, surface);
  co_return surface;
}

/// Remeshes a surface with all details.
Task<> remeshPlain(Work& work, const Remeshing& remeshing, SimplifiedSurface& surface) {
  work.beginPart(1.0);
  surface.pass = co_await remeshOnce(work, remeshing.reference, remeshing.given, remeshing.sizes,
                                     remeshing.options, {}, remeshing.isStopped);
  surface.deviation = surface.pass.remesh.deviation;
}

/// Remeshes a surface without the chosen details.
Task<Dropped> remeshWithoutChosen(Work& work, const Remeshing& remeshing,
                                  SimplifiedSurface& surface) {
  const DetailRule rule{.distance = remeshing.options.dropDetails,
                        .choice = DetailChoice::kAll,
                        .remeshing = rulesOfShare(1.0, 1.0)};
  work.beginPart(1.0);
  const Dropped dropped = co_await simplify(work, remeshing, remeshing.given, rule, surface);
  co_return dropped;
}

/// Triangulates the faces of the model, which must be known, and remeshes around their poor triangles.
Task<Dropped> remeshFaces(Work& work, const Remeshing& remeshing, SimplifiedSurface& surface) {
  work.beginPart(0.6);
  ModelRemesh made = co_await remeshModel(work, remeshing);
  if (made.pass) surface.pass = std::move(*made.pass);
  surface.pass.remesh.failedFaces = std::move(made.failedFaces);
  if (!made.pass) co_return Dropped::kNone;
  surface.deviation = surface.pass.remesh.deviation;
  if (made.givenTriangles > 0) {
    work.beginPart(0.8);
    const TrackedSurface from = surface.pass.surface;
    const DetailRule rule{.distance = 0.0,
                          .choice = DetailChoice::kAll,
                          .remeshing = rulesOfShare(kFirstShare, kFirstShare, true),
                          .isRemeshed = true,
                          .unsettled = made.givenTriangles};
    std::vector<std::uint32_t> failedFaces = std::move(surface.pass.remesh.failedFaces);
    const Dropped dropped = co_await simplify(work, remeshing, from, rule, surface);
    surface.pass.remesh.failedFaces = std::move(failedFaces);
    if (dropped != Dropped::kMade || !isComplete(surface.pass.remesh)) co_return Dropped::kNone;
  }
  work.beginPart(1.0);
  co_await dropPoorDetails(work, remeshing, surface, true);
  surface.pass.remesh.onFaces = true;
  co_return Dropped::kMade;
}

/// A way to remesh the given surface.
enum class Way : std::uint8_t { kFaces, kPlain, kWithoutGiven, kWithoutChosen, kInSteps };

/// When a way is tried, after the ones before it.
enum class When : std::uint8_t {
  kAlways,
  kUnlessFit,   ///< if there is no surface yet, or one that is worth it
  kIfNone,      ///< if there is no surface yet
  kIfUnusable,  ///< if there is none, or it has problems
  kIfTooMany,   ///< if the way before has found too many details
  kIfPoor,      ///< if the best surface has poor triangles that are worth it
};

struct Attempt {
  Way way;
  When when;
};

// Attempts in their order, each way at most once. The better one of two surfaces is kept.
constexpr std::array kKeepDetails{Attempt{Way::kFaces, When::kAlways},
                                  Attempt{Way::kPlain, When::kIfNone}};
constexpr std::array kDropChosen{Attempt{Way::kWithoutChosen, When::kAlways},
                                 Attempt{Way::kInSteps, When::kIfPoor},
                                 Attempt{Way::kPlain, When::kIfNone}};
/// If triangles of the smallest size would be poor across details of the given surface.
constexpr std::array kDropGivenFirst{
    Attempt{Way::kFaces, When::kAlways}, Attempt{Way::kWithoutGiven, When::kUnlessFit},
    Attempt{Way::kInSteps, When::kIfTooMany}, Attempt{Way::kPlain, When::kIfUnusable},
    Attempt{Way::kInSteps, When::kIfPoor}};
constexpr std::array kDropGivenIfPoor{
    Attempt{Way::kFaces, When::kAlways}, Attempt{Way::kPlain, When::kUnlessFit},
    Attempt{Way::kWithoutGiven, When::kIfPoor}, Attempt{Way::kInSteps, When::kIfPoor}};

/// Returns true if triangles of the smallest size are poor across the details that may be dropped. Automatic sizes
/// are smaller in narrow gaps, but would only fill these details with many small triangles.
bool areGivenDetailsPoor(const Remeshing& remeshing) {
  const BackgroundGrid& grid = remeshing.sizes.grid;
  if (!grid.nodes.empty() || !grid.sources.empty()) return false;
  const RemeshLengths& lengths = remeshing.lengths;
  const double smallest = std::min(lengths.minSize, remeshing.sizes.ofRegions.smallest());
  return kGivenMergeShare * lengths.tolerance < kPoorWidth * smallest;
}

std::span<const Attempt> attemptsFor(const Remeshing& remeshing) {
  if (remeshing.options.dropDetails > 0.0) return kDropChosen;
  if (!remeshing.options.dropPoorDetails) return kKeepDetails;
  if (areGivenDetailsPoor(remeshing)) return kDropGivenFirst;
  return kDropGivenIfPoor;
}

Task<Dropped> remeshBy(Work& work, Way way, const Remeshing& remeshing,
                       SimplifiedSurface& surface) {
  Dropped dropped = Dropped::kMade;
  work.beginPart(1.0);
  if (way == Way::kFaces) {
    dropped = co_await remeshFaces(work, remeshing, surface);
  } else if (way == Way::kPlain) {
    co_await remeshPlain(work, remeshing, surface);
  } else if (way == Way::kWithoutGiven) {
    dropped = co_await remeshWithoutGiven(work, remeshing, surface);
  } else if (way == Way::kWithoutChosen) {
    dropped = co_await remeshWithoutChosen(work, remeshing, surface);
  } else {
    surface = co_await remeshInSteps(work, remeshing);
  }
  if (dropped != Dropped::kMade) work.leaveRest();
  co_return dropped;
}

/// What the attempts so far have made.
struct Attempts {
  std::optional<SimplifiedSurface> best;
  Dropped last = Dropped::kNone;
  std::array<bool, 5> areTried{};  ///< by Way
  std::vector<std::uint32_t> failedFaces;
};

bool isDue(const Attempt& attempt, const Attempts& made, const Remeshing& remeshing) {
  if (made.areTried.at(static_cast<std::size_t>(attempt.way))) return false;
  if (attempt.way == Way::kFaces && !remeshing.model) return false;
  switch (attempt.when) {
    case When::kAlways:
      return true;
    case When::kUnlessFit:
      return !made.best || isWorthSteps(remeshing, made.best->pass.remesh);
    case When::kIfNone:
      return !made.best;
    case When::kIfUnusable:
      return !made.best || !made.best->pass.remesh.diagnostics.empty();
    case When::kIfTooMany:
      return made.last == Dropped::kTooMany;
    case When::kIfPoor:
      return made.best && isWorthSteps(remeshing, made.best->pass.remesh);
  }
  return false;
}

/// Work of the attempts that will follow one / work of it, for the progress: most are the last.
constexpr double kExpectedFurther = 0.25;

/// Returns true if a surface replaces the best one. One that keeps chosen details does not.
bool replacesBest(const Attempt& attempt, const SimplifiedSurface& surface, const Attempts& made,
                  const Remeshing& remeshing) {
  if (!made.best || attempt.when == When::kIfUnusable) return true;
  const bool keepsChosen = remeshing.options.dropDetails > 0.0 && surface.merged.empty();
  return isBetter(surface.pass.remesh, made.best->pass.remesh) && !keepsChosen;
}

}  // namespace

bool isComplete(const SurfaceRemesh& result) {
  return result.diagnostics.empty() && !result.isPartial;
}

Task<SimplifiedSurface> remeshAndDrop(Work& work, const Remeshing& remeshing) {
  const std::span<const Attempt> attempts = attemptsFor(remeshing);
  Attempts made;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const Attempt& attempt = attempts[i];
    if (!isDue(attempt, made, remeshing)) continue;
    const bool isLast = i + 1 == attempts.size();
    work.beginShare(1.0, isLast ? 1.0 : 1.0 + kExpectedFurther);
    SimplifiedSurface surface;
    made.last = co_await remeshBy(work, attempt.way, remeshing, surface);
    made.areTried.at(static_cast<std::size_t>(attempt.way)) = true;
    if (attempt.way == Way::kFaces) made.failedFaces = std::move(surface.pass.remesh.failedFaces);
    if (made.last != Dropped::kMade) continue;
    if (replacesBest(attempt, surface, made, remeshing)) made.best = std::move(surface);
  }
  SimplifiedSurface best = made.best ? std::move(*made.best) : SimplifiedSurface{};
  best.pass.remesh.failedFaces = std::move(made.failedFaces);
  co_return best;
}

}  // namespace tetrafront
