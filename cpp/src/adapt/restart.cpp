#include "adapt/restart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "base/diagnostics.h"
#include "geom/box.h"
#include "optimize/given_mesh.h"
#include "sizing/expected_count.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// A node this near the boundary lies on it, in parts of the diagonal of the body: files with the eight digits of single precision
/// move nodes by about half as much.
constexpr double kOnBoundary = 1e-7;

/// Largest distance of a node of the boundary from the triangles that approximate it / their sag in their middles.
constexpr double kReachPerSag = 2.0;

/// Largest difference between the volumes of the two bodies, as a part of one: more than chords of a curved boundary differ.
constexpr double kSameVolume = 0.05;

bool haveSameVolume(const SurfaceMesh& one, const SurfaceMesh& other) {
  const double volume = enclosedVolume(one);
  return std::fabs(volume - enclosedVolume(other)) <= kSameVolume * std::fabs(volume);
}

/// Finds the patch of each face and the place of each node of the boundary of a mesh.
class PlaceFinder {
 public:
  PlaceFinder(const SurfaceMesh& boundary, const BoundaryGuide& guide)
      : boundary_(boundary),
        guide_(guide),
        tolerance_(kOnBoundary * guide.reference().diagonal()),
        reach_(std::max(tolerance_, kReachPerSag * guide.sag())),
        nodes_(countNodes(boundary)) {
    places_.nodes.resize(countNodes(boundary));
  }

  /// Returns false if the boundary is another one.
  Task<bool> run(Work& work) {
    for (const std::uint32_t node : boundary_.triangles) {
      if (nodes_[node].end > 0) continue;
      if (!findTriangles(NodeId(node))) co_return false;
      co_await work.spend(4);
    }
    for (const TriangleId t : IdRange<TriangleId>(countTriangles(boundary_))) {
      const SmoothPatchId patch = patchOf(t);
      if (patch.isNone()) co_return false;
      places_.patches.push_back(patch);
      for (const NodeId node : nodesOf(boundary_, t)) addPatch(node, patch);
      co_await work.spend(1);
    }
    std::size_t fixed = 0;
    for (const NodeId node : IdRange<NodeId>(nodes_.size())) {
      if (nodes_[node.index()].end == 0) continue;
      if (!findPlace(node)) co_return false;
      co_await work.spend(4);
      fixed += places_.nodes[node.index()].kind == PlaceKind::kFixed ? 1 : 0;
    }
    co_return fixed == guide_.fixedCount() && hasAllPatches();
  }

  BoundaryPlaces take() { return std::move(places_); }

 private:
  /// A node of the boundary.
  struct Found {
    std::uint32_t begin = 0;  ///< of the reference triangles at the node in `near_`
    std::uint32_t end = 0;
    std::uint32_t patchCount = 0;            ///< number of patches of its faces
    std::array<SmoothPatchId, 2> patches{};  ///< the first of them
  };

  [[nodiscard]] std::span<const TriangleId> near(NodeId node) const {
    const Found& found = nodes_[node.index()];
    return std::span(near_).subspan(found.begin, found.end - found.begin);
  }

  /// Finds the triangles of the reference at a node. Returns false if there is none.
  bool findTriangles(NodeId node) {
    const ReferenceSurface& reference = guide_.reference();
    const Vec3 at = pointOf(boundary_, node);
    const Vec3 margin(reach_);
    const std::size_t begin = near_.size();
    const auto isKnown = [&](TriangleId t) {
      return std::find(near_.begin() + static_cast<std::ptrdiff_t>(begin), near_.end(), t) !=
             near_.end();
    };
    reference.tree().visitOverlaps(Box::of(at - margin, at + margin, at), [&](std::uint32_t piece) {
      const TriangleId t = reference.pieces()[piece].triangle;
      if (reference.squaredDistance(at, t) <= reach_ * reach_ && !isKnown(t) && isOnPatch(at, t))
        near_.push_back(t);
    });
    Found& found = nodes_[node.index()];
    found.begin = static_cast<std::uint32_t>(begin);
    found.end = static_cast<std::uint32_t>(near_.size());
    return found.end > found.begin;
  }

  /// Returns whether a position near a triangle of the reference is on the boundary that this approximates.
  [[nodiscard]] bool isOnPatch(const Vec3& position, TriangleId triangle) const {
    if (reach_ == tolerance_) return true;
    const SmoothPatchId patch = guide_.reference().patchOf(triangle);
    Vec3 nearest = position;
    const Place hint{.kind = PlaceKind::kPatch, .entity = patch.value, .near = triangle};
    static_cast<void>(guide_.onPatch(patch, hint, nearest));
    return isAt(nearest, position);
  }

  [[nodiscard]] bool isNear(NodeId node, SmoothPatchId patch) const {
    return std::ranges::any_of(
        near(node), [&](TriangleId t) { return guide_.reference().patchOf(t) == patch; });
  }

  /// Returns the patch that all nodes of a triangle lie on: of several, one that faces as the triangle does. None if there is none.
  [[nodiscard]] SmoothPatchId patchOf(TriangleId triangle) const {
    const auto [a, b, c] = nodesOf(boundary_, triangle);
    SmoothPatchId only{};
    bool areSeveral = false;
    SmoothPatchId facing{};
    for (const TriangleId t : near(a)) {
      const SmoothPatchId patch = guide_.reference().patchOf(t);
      if (!isNear(b, patch) || !isNear(c, patch)) continue;
      areSeveral = areSeveral || (!only.isNone() && only != patch);
      only = patch;
      if (facing.isNone() && guide_.isFacing(cornersOf(boundary_, triangle), patch, t))
        facing = patch;
    }
    return areSeveral ? facing : only;
  }

  void addPatch(NodeId node, SmoothPatchId patch) {
    Found& found = nodes_[node.index()];
    const std::size_t known = std::min<std::size_t>(found.patchCount, 2);
    for (std::size_t i = 0; i < known; ++i) {
      if (found.patches[i] == patch) return;
    }
    if (known < 2) found.patches[known] = patch;
    ++found.patchCount;
  }

  /// Returns false if the node can be nowhere.
  bool findPlace(NodeId node) {
    Place& place = places_.nodes[node.index()];
    const Vec3 at = pointOf(boundary_, node);
    const ReferenceSurface& reference = guide_.reference();
    for (const TriangleId t : near(node)) {
      for (const NodeId corner : nodesOf(reference.mesh(), t)) {
        const Place& known = guide_.placeOf(corner);
        if (known.kind != PlaceKind::kFixed || !isAt(pointOf(reference.mesh(), corner), at))
          continue;
        place = known;
        return true;
      }
    }
    const Found& found = nodes_[node.index()];
    const auto [one, other] = found.patches;
    if (found.patchCount == 2) return findLine(node, one, other);
    if (found.patchCount != 1) return false;
    const auto isOnPatch = [&](TriangleId t) { return reference.patchOf(t) == one; };
    place = {.kind = PlaceKind::kPatch,
             .entity = one.value,
             .near = *std::ranges::find_if(near(node), isOnPatch)};
    return true;
  }

  /// Finds the line between two patches on which a node lies.
  bool findLine(NodeId node, SmoothPatchId one, SmoothPatchId other) {
    const SurfaceMesh& mesh = guide_.reference().mesh();
    const Vec3 at = pointOf(boundary_, node);
    for (const TriangleId t : near(node)) {
      const NodeTriple corners = nodesOf(mesh, t);
      for (std::size_t k = 0; k < 3; ++k) {
        const NodeId from = corners[k];
        const NodeId to = corners[(k + 1) % 3];
        const FeatureLineId line =
            guide_.commonLine(guide_.placeOf(from), guide_.placeOf(to), one, other, at);
        if (line.isNone()) continue;
        Vec3 position(0.0);
        Place place = guide_.onLine(line, guide_.placeOf(from), guide_.placeOf(to), 0.5, position);
        position = at;
        if (!guide_.follow(place, position) || !isAt(position, at)) continue;
        places_.nodes[node.index()] = place;
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool isAt(const Vec3& one, const Vec3& other) const {
    const Vec3 off = one - other;
    return glm::dot(off, off) <= tolerance_ * tolerance_;
  }

  [[nodiscard]] bool hasAllPatches() const {
    std::vector<std::uint8_t> isUsed(guide_.reference().patchCount(), 0);
    for (const SmoothPatchId patch : places_.patches) isUsed[patch.index()] = 1;
    return std::ranges::find(isUsed, std::uint8_t{0}) == isUsed.end();
  }

  const SurfaceMesh& boundary_;
  const BoundaryGuide& guide_;
  double tolerance_;
  double reach_;  ///< of the reference triangles around a node of the boundary
  std::vector<Found> nodes_;
  std::vector<TriangleId> near_;
  BoundaryPlaces places_;
};

}  // namespace

Task<RestartMesh> findRestart(Work& work, const MetricMesh& background,
                              const BoundaryGuide& guide) {
  RestartMesh out;
  VolumeMesh mesh;
  mesh.points = background.points;
  mesh.tetrahedra = background.tetrahedra;
  mesh.regions.assign(countTetrahedra(mesh), 0);
  work.beginPart(0.4);
  out.given = co_await prepareGivenMesh(work, mesh, {});
  if (anyError(out.given.diagnostics) || out.given.regionOfPart.size() != 1)
    co_return RestartMesh{};
  work.beginPart(0.7);
  out.faces = co_await findStartFaces(work, out.given, {}, {});
  const std::vector<std::uint8_t> isRepeated = nodesInSeveralSets(out.given, out.faces);
  if (std::ranges::find(isRepeated, std::uint8_t{1}) != isRepeated.end() ||
      !haveSameVolume(guide.reference().mesh(), out.faces.boundary))
    co_return RestartMesh{};
  work.beginPart(1.0);
  PlaceFinder finder(out.faces.boundary, guide);
  out.fits = co_await finder.run(work);
  if (!out.fits) co_return RestartMesh{};
  out.places = finder.take();
  co_return std::move(out);
}

}  // namespace tetrafront
