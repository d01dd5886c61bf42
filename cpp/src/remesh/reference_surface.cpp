#include "remesh/reference_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/sort.h"
#include "base/tolerance.h"
#include "geom/measure.h"
#include "topology/mesh_access.h"
#include "topology/smooth_triangles.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Rounding of double precision / rounding of single precision.
constexpr double kDoublePerSingle = 0x1p-29;
/// Largest rounding / diagonal that counts as such. A surface that is rounded more has no planar patches to recognize.
constexpr double kLargestNoise = 1e-3;
/// A node counts as the tip of a cone if the cosine between the normal of one of its triangles and
/// the mean normal is below this.
constexpr double kApexCosine = 0.70710678;
/// Longest piece of a triangle in the tree / diagonal, and the largest number of halvings of a
/// triangle.
constexpr double kPieceLength = 1.0 / 60.0;
constexpr int kMaxHalvings = 8;
/// Number of pieces beside one per triangle above which pieces are made longer: a hundred thousand needles would have
/// millions.
constexpr std::size_t kMaxPieces = 1'000'000;
/// Steps of a walk between neighbouring triangles, after which the tree is faster.
constexpr int kMaxSteps = 24;

/// Returns the weight of a triangle in the normal at its corner k; it grows with the angle there
/// and does not depend on the area.
double cornerWeight(const std::array<Vec3, 3>& corners, std::size_t k) {
  const Vec3 u = unitOf(corners[(k + 1) % 3] - corners[k]);
  const Vec3 v = unitOf(corners[(k + 2) % 3] - corners[k]);
  return glm::length(u - v);
}

/// Returns whether all coordinates are numbers of single precision in the user's coordinates.
bool isSinglePrecision(const SurfaceMesh& mesh, const Vec3& centre) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double coordinate = mesh.points[i] + centre[static_cast<int>(i % 3)];
    if (static_cast<double>(static_cast<float>(coordinate)) != coordinate) return false;
  }
  return true;
}

}  // namespace

ReferenceSurface::ReferenceSurface(const SurfaceMesh& mesh, const FeatureRules& rules,
                                   const Vec3& centre)
    : mesh_(mesh), rules_(rules), centre_(centre) {
  const Bounds bounds = boundsOf(mesh);
  diagonal_ = glm::length(bounds.high - bounds.low);
  for (int k = 0; k < 3; ++k) {
    largestCoordinate_ =
        std::max({largestCoordinate_, std::fabs(bounds.low[k]), std::fabs(bounds.high[k])});
  }
  if (centre == Vec3(0.0)) return;
  // Nodes are rounded to the digits that they have in the user's coordinates.
  const double far = magnitudeOf(centre);
  const double rounded =
      isSinglePrecision(mesh, centre)
          ? std::min(far, kLargestNoise * diagonal_ / Tolerance::kSinglePerCoordinate)
          : kDoublePerSingle * far;
  largestCoordinate_ = std::max(largestCoordinate_, rounded);
}

Task<> ReferenceSurface::prepare(Work& work) {
  const EdgeTable edges(mesh_.triangles, countNodes(mesh_), {});
  co_await work.yield();
  frames_.reserve(countTriangles(mesh_));
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh_))) {
    frames_.emplace_back(cornersOf(mesh_, t));
  }
  SmoothTriangles smooth = findSmoothTriangles(mesh_, edges, mesh_.trianglePatch,
                                               rules_.creaseCosine, largestCoordinate_);
  normals_ = std::move(smooth.normals);
  neighbours_ = std::move(smooth.neighbours);
  isFeatureEdge_ = std::move(smooth.isSharp);
  co_await work.yield();
  findPatches();
  findFacets();
  co_await work.yield();
  findCorners(edges);
  traceLines(edges);
  co_await work.yield();
  std::vector<Box> boxes;
  pieceLength_ = kPieceLength * diagonal_;
  for (;;) {
    const bool isDivided = co_await divideAll(work, boxes);
    if (isDivided) break;
    pieceLength_ *= 2.0;
  }
  tree_ = co_await BoxTree::build(work, std::move(boxes), 32);
}

void ReferenceSurface::findPatches() {
  patchOf_.assign(normals_.size(), SmoothPatchId{});
  forEachSmoothPatch(neighbours_, [this](std::span<const TriangleId> members) {
    for (const TriangleId t : members) patchOf_[t.index()] = SmoothPatchId(patches_.size());
    patches_.push_back(describePatch(members));
  });
}

double ReferenceSurface::planarTolerance() const {
  return Tolerance::ofSingle(diagonal_, largestCoordinate_);
}

SmoothPatch ReferenceSurface::describePatch(std::span<const TriangleId> members) const {
  SmoothPatch patch;
  Vec3 sum(0.0);
  for (const TriangleId t : members) {
    const std::array<Vec3, 3> corners = cornersOf(mesh_, t);
    sum += glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  }
  patch.normal = unitOf(sum);
  patch.group = mesh_.trianglePatch.empty() ? 0 : mesh_.trianglePatch[members[0].index()];
  const double tolerance = planarTolerance();
  const Vec3 origin = cornersOf(mesh_, members[0])[0];
  patch.isPlanar = glm::length(patch.normal) > 0.5;
  for (std::size_t i = 0; i < members.size() && patch.isPlanar; ++i) {
    // A fold can lie in one plane, with triangles that face both ways.
    patch.isPlanar = glm::dot(normalOf(members[i]), patch.normal) > 0.0;
    for (const Vec3& corner : cornersOf(mesh_, members[i])) {
      patch.isPlanar =
          patch.isPlanar && std::fabs(glm::dot(corner - origin, patch.normal)) <= tolerance;
    }
  }
  return patch;
}

/// Divides the curved patches into facets, around their largest triangles first.
void ReferenceSurface::findFacets() {
  struct Seed {
    double area;
    TriangleId triangle;
    std::uint32_t unused = 0;
  };
  std::vector<Seed> seeds;
  for (const TriangleId t : IdRange<TriangleId>(normals_.size())) {
    if (!patch(patchOf(t)).isPlanar) seeds.push_back({areaOf(cornersOf(mesh_, t)), t});
  }
  stableSort(seeds, [](const Seed& a, const Seed& b) { return a.area > b.area; });
  facetOf_.assign(normals_.size(), PatchFacetId{});
  std::vector<TriangleId> members;
  for (const Seed& seed : seeds) {
    if (facetOf(seed.triangle).isNone()) growFacet(seed.triangle, members);
  }
  std::vector<Box> boxes;
  for (Facet& facet : facets_) {
    if (facet.edgeCount <= kFewEdges) continue;
    boxes.clear();
    for (std::uint32_t i = facet.firstEdge; i < facet.firstEdge + facet.edgeCount; ++i) {
      const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, facetEdges_[i]);
      const Vec3 from = pointOf(mesh_, nodes.from);
      boxes.push_back(Box::of(from, pointOf(mesh_, nodes.to), from));
    }
    facet.tree = static_cast<std::uint32_t>(facetTrees_.size());
    facetTrees_.emplace_back(std::span<const Box>(boxes));
  }
}

void ReferenceSurface::growFacet(TriangleId seed, std::vector<TriangleId>& members) {
  const PatchFacetId id(facets_.size());
  Facet facet;
  facet.normal = normalOf(seed);
  facet.origin = cornersOf(mesh_, seed)[0];
  facet.firstEdge = static_cast<std::uint32_t>(facetEdges_.size());
  const double tolerance = planarTolerance();
  const auto heightOf = [&](TriangleId triangle) {
    double largest = 0.0;
    for (const Vec3& corner : cornersOf(mesh_, triangle)) {
      largest = std::max(largest, std::fabs(glm::dot(corner - facet.origin, facet.normal)));
    }
    return largest;
  };
  members.assign(1, seed);
  facetOf_[seed.index()] = id;
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const TriangleId next = smoothNeighbour(halfEdgeOf(members[i], k));
      if (next.isNone() || !facetOf(next).isNone()) continue;
      const double height = heightOf(next);
      if (height > tolerance || glm::dot(normalOf(next), facet.normal) <= 0.0) continue;
      facet.flatness = std::max(facet.flatness, height);
      facetOf_[next.index()] = id;
      members.push_back(next);
    }
  }
  for (const TriangleId t : members) {
    facet.area += areaOf(cornersOf(mesh_, t));
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfEdgeId halfEdge = halfEdgeOf(t, k);
      const TriangleId next = smoothNeighbour(halfEdge);
      if (next.isNone() || facetOf(next) != id) facetEdges_.push_back(halfEdge);
    }
  }
  facet.edgeCount = static_cast<std::uint32_t>(facetEdges_.size()) - facet.firstEdge;
  facets_.push_back(facet);
}

/// Counts the parts into which feature lines divide the triangles at each node.
std::vector<std::uint32_t> ReferenceSurface::countSectors() const {
  std::vector<std::uint32_t> sectors(countNodes(mesh_), 0);
  std::vector<std::uint8_t> isCounted(mesh_.triangles.size(), 0);
  const auto cornerAt = [this](TriangleId triangle, NodeId node) {
    std::uint32_t k = 0;
    while (NodeId(mesh_.triangles[halfEdgeOf(triangle, k).index()]) != node) ++k;
    return halfEdgeOf(triangle, k);
  };
  for (const HalfEdgeId corner : IdRange<HalfEdgeId>(mesh_.triangles.size())) {
    if (isCounted[corner.index()] != 0) continue;
    const NodeId node(mesh_.triangles[corner.index()]);
    ++sectors[node.index()];
    isCounted[corner.index()] = 1;
    // Go around the node in one direction and then, unless this closes the circle, in the other
    // one.
    for (const std::uint32_t turns : {0U, 2U}) {
      HalfEdgeId at = corner;
      for (;;) {
        const HalfEdgeId edge = turns == 0 ? at : nextOf(nextOf(at));
        const TriangleId next = smoothNeighbour(edge);
        if (next.isNone()) break;
        at = cornerAt(next, node);
        if (isCounted[at.index()] != 0) break;
        isCounted[at.index()] = 1;
      }
    }
  }
  return sectors;
}

void ReferenceSurface::findCorners(const EdgeTable& edges) {
  const std::size_t nodes = countNodes(mesh_);
  isCorner_.assign(nodes, 0);
  armBegins_.assign(nodes + 1, 0);
  const auto endsOf = [&](EdgeId edge) {
    return nodesOf(mesh_.triangles, edges.halfEdgesOf(edge)[0]);
  };
  for (const EdgeId edge : IdRange<EdgeId>(edges.edgeCount())) {
    if (isFeatureEdge_[edge.index()] == 0) continue;
    ++armBegins_[endsOf(edge).from.index() + 1];
    ++armBegins_[endsOf(edge).to.index() + 1];
  }
  for (std::size_t i = 0; i < nodes; ++i) armBegins_[i + 1] += armBegins_[i];
  arms_.resize(armBegins_[nodes]);
  std::vector<std::uint32_t> next(armBegins_.begin(), armBegins_.end() - 1);
  for (const EdgeId edge : IdRange<EdgeId>(edges.edgeCount())) {
    if (isFeatureEdge_[edge.index()] == 0) continue;
    const HalfEdgeNodes ends = endsOf(edge);
    arms_[next[ends.from.index()]++] = {ends.to, edge};
    arms_[next[ends.to.index()]++] = {ends.from, edge};
  }

  const std::vector<std::uint32_t> sectors = countSectors();
  for (const NodeId node : IdRange<NodeId>(nodes)) {
    const std::span<const Arm> arms = armsOf(node);
    bool isCorner = true;
    if (arms.empty()) {
      isCorner = sectors[node.index()] > 1;
    } else if (arms.size() == 2) {
      const std::size_t sheets = edges.halfEdgesOf(arms[0].edge).size();
      const Vec3 here = pointOf(mesh_, node);
      const Vec3 before = unitOf(here - pointOf(mesh_, arms[0].to));
      const Vec3 after = unitOf(pointOf(mesh_, arms[1].to) - here);
      isCorner = sheets != edges.halfEdgesOf(arms[1].edge).size() ||
                 sheets != sectors[node.index()] || glm::dot(before, after) < rules_.cornerCosine;
    }
    if (isCorner) isCorner_[node.index()] = 1;
  }
  findApexes();
}

/// Marks nodes at the tips of cones as corners: the normals of their triangles differ much from the
/// mean normal.
void ReferenceSurface::findApexes() {
  std::vector<Vec3> normals(countNodes(mesh_), Vec3(0.0));
  for (const TriangleId t : IdRange<TriangleId>(normals_.size())) {
    const std::array<Vec3, 3> corners = cornersOf(mesh_, t);
    const NodeTriple nodes = nodesOf(mesh_, t);
    for (std::size_t k = 0; k < 3; ++k) {
      normals[nodes[k].index()] += normalOf(t) * cornerWeight(corners, k);
    }
  }
  for (Vec3& normal : normals) normal = unitOf(normal);
  for (const TriangleId t : IdRange<TriangleId>(normals_.size())) {
    for (const NodeId node : nodesOf(mesh_, t)) {
      if (armsOf(node).empty() && glm::dot(normals[node.index()], normalOf(t)) < kApexCosine) {
        isCorner_[node.index()] = 1;
      }
    }
  }
}

void ReferenceSurface::traceLines(const EdgeTable& edges) {
  isTraced_.assign(edges.edgeCount(), 0);
  for (const bool fromCorners : {true, false}) {
    for (const NodeId node : IdRange<NodeId>(countNodes(mesh_))) {
      if (isCorner(node) != fromCorners) continue;
      for (const Arm& arm : armsOf(node)) {
        if (isTraced_[arm.edge.index()] == 0) traceLine(node, arm, edges);
      }
    }
  }
}

void ReferenceSurface::traceLine(NodeId from, const Arm& first, const EdgeTable& edges) {
  std::vector<NodeId> nodes{from};
  std::vector<Vec3> points{pointOf(mesh_, from)};
  double creaseCosine = -1.0;
  Arm arm = first;
  for (;;) {
    isTraced_[arm.edge.index()] = 1;
    nodes.push_back(arm.to);
    points.push_back(pointOf(mesh_, arm.to));
    const std::span<const HalfEdgeId> on = edges.halfEdgesOf(arm.edge);
    if (on.size() == 2) {
      creaseCosine = std::max(creaseCosine,
                              glm::dot(normalOf(triangleOf(on[0])), normalOf(triangleOf(on[1]))));
    }
    if (isCorner(arm.to) || arm.to == from) break;
    const std::span<const Arm> arms = armsOf(arm.to);
    arm = arms[0].edge == arm.edge ? arms[1] : arms[0];
  }
  const bool isClosed = arm.to == from && !isCorner(from);
  FeatureLine line(std::move(nodes), std::move(points), isClosed);
  line.creaseCosine = creaseCosine;
  for (const HalfEdgeId halfEdge : edges.halfEdgesOf(first.edge)) {
    line.patches.push_back(patchOf(triangleOf(halfEdge)).value);
  }
  lines_.push_back(std::move(line));
}

/// Divides all triangles into pieces. Returns false if the pieces are too many.
Task<bool> ReferenceSurface::divideAll(Work& work, std::vector<Box>& boxes) {
  boxes.clear();
  pieces_.clear();
  bool areFew = true;
  co_await work.forEachBlock(countTriangles(mesh_), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last && areFew; ++t) {
      divide(TriangleId(t), cornersOf(mesh_, TriangleId(t)), kMaxHalvings, boxes);
      areFew = pieces_.size() <= kMaxPieces + t;
    }
  });
  co_return areFew;
}

void ReferenceSurface::divide(TriangleId triangle, const std::array<Vec3, 3>& corners, int depth,
                              std::vector<Box>& boxes) {
  const std::uint32_t k = longestEdgeOf(corners);
  const Vec3& a = corners[k];
  const Vec3& b = corners[(k + 1) % 3];
  const Vec3& c = corners[(k + 2) % 3];
  if (depth == 0 || glm::length(b - a) <= pieceLength_) {
    Box box = Box::of(a, b, c);
    // Midpoints are rounded, but the boxes of the pieces must contain the whole triangle.
    const Vec3 margin(1e-15 * largestCoordinate_);
    for (const Vec3& corner : corners) box.include(corner, margin);
    boxes.push_back(box);
    pieces_.push_back({triangle, (a + b + c) / 3.0, 0.5 * glm::length(glm::cross(b - a, c - a))});
    return;
  }
  const Vec3 middle = 0.5 * (a + b);
  divide(triangle, {a, middle, c}, depth - 1, boxes);
  divide(triangle, {middle, b, c}, depth - 1, boxes);
}

/// Walks to a triangle that is nearer than its neighbours across the edges beyond which the position lies; returns it with
/// its nearest point.
NearestPoint ReferenceSurface::walk(const Vec3& position, TriangleId from) const {
  TriangleId here = from;
  TriangleId last{};
  TriangleFrame::Distance distance = frames_[here.index()].measure(position);
  for (int step = 0; step < kMaxSteps; ++step) {
    const TriangleId current = here;
    const std::uint32_t beyond = distance.beyond;
    for (std::uint32_t k = 0; k < 3; ++k) {
      if ((beyond >> k & 1U) == 0) continue;
      const TriangleId next = smoothNeighbour(halfEdgeOf(current, k));
      if (next.isNone() || next == last) continue;
      const TriangleFrame::Distance other = frames_[next.index()].measure(position);
      if (other.squared >= distance.squared) continue;
      distance = other;
      here = next;
    }
    if (here == current) break;
    last = current;
  }
  return {here, distance.squared, frames_[here.index()].nearestPoint(position, distance)};
}

NearestPoint ReferenceSurface::nearest(const Vec3& position, SmoothPatchId patch, double limit,
                                       TriangleId hint) const {
  NearestPoint best{{}, limit * limit, position};
  if (!hint.isNone() && patchOf(hint) == patch) {
    const NearestPoint found = walk(position, hint);
    if (found.squaredDistance <= best.squaredDistance) return found;
  }
  TriangleId last{};
  TriangleFrame::Distance distance;
  tree_.visitNear(position, best.squaredDistance, [&](std::uint32_t item) {
    const TriangleId t = pieces_[item].triangle;
    if (t == last || t == best.triangle || patchOf(t) != patch) return;
    last = t;
    const TriangleFrame::Distance other = frames_[t.index()].measure(position);
    if (other.squared >= best.squaredDistance) return;
    distance = other;
    best.squaredDistance = other.squared;
    best.triangle = t;
  });
  if (!best.triangle.isNone()) {
    best.position = frames_[best.triangle.index()].nearestPoint(position, distance);
  }
  return best;
}

}  // namespace tetrafront
