#include "quality/verify_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "base/resumable.h"
#include "base/sort.h"
#include "geom/predicates.h"
#include "tetrafront/vec3.h"
#include "topology/mesh_access.h"
#include "topology/node_lists.h"
#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

/// The two volumes are sums of rounded terms. A difference is a defect if it exceeds this fraction
/// of them and also exceeds what rounding can cause, which is a much larger fraction for long and
/// thin shapes.
constexpr double kVolumeTolerance = 1e-10;
/// Bound on the rounding error of the differences and products of one term, with a margin. The sums are compensated.
constexpr double kRoundingPerTerm = 16.0 * std::numeric_limits<double>::epsilon();

double sixVolumes(const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

/// A bucket of nodes whose positions have similar hashes.
using PositionBucketId = Id<struct PositionBucketTag>;

/// Equal for equal positions, although 0 and -0 differ in their bits.
std::uint64_t hashOf(const Vec3& position) {
  // Any odd constant with well-mixed bits works: here 2^64 divided by the golden ratio.
  constexpr std::uint64_t kMultiplier = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = 0;
  for (const double x : {position.x, position.y, position.z}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * kMultiplier;
    hash ^= hash >> 32U;
  }
  return hash;
}

/// Nodes in ascending order, and whether the permutation is even.
struct SortedFace {
  NodeTriple nodes;
  bool isEven;
};

SortedFace sortedFace(const NodeTriple& nodes) {
  SortedFace face{nodes, true};
  const auto order = [&](std::size_t i, std::size_t j) {
    if (face.nodes[i] <= face.nodes[j]) return;
    std::swap(face.nodes[i], face.nodes[j]);
    face.isEven = !face.isEven;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return face;
}

/// Three edges of the tetrahedron of an origin and a triangle. If the origin is far away, the volume
/// of a small triangle is then a small product with a small rounding error; most triangles are small.
struct Spanned {
  Vec3 toTriangle;
  Vec3 first;
  Vec3 second;
};

Spanned spannedBy(const SurfaceMesh& surface, const Vec3& origin, TriangleId triangle) {
  const auto [a, b, c] = cornersOf(surface, triangle);
  return {a - origin, b - a, c - a};
}

/// Returns the common origin of the volumes under the triangles; there must be one.
Vec3 originOf(const SurfaceMesh& surface) {
  return pointOf(surface, NodeId(surface.triangles.front()));
}

}  // namespace

std::uint64_t MeshDefects::count() const {
  return invalidNumbers + movedNodes + coincidentNodes + invertedTetrahedra + duplicateTetrahedra +
         nonManifoldFaces + overlappingFaces + extraBoundaryFaces + missingTriangles +
         wrongRegions + wrongVolume;
}

MeshVerifier::MeshVerifier(const MeshView& mesh, const SurfaceMesh& surface, std::size_t maxFaces)
    : mesh_(mesh),
      surface_(surface),
      maxFaces_(maxFaces),
      tetrahedra_(mesh.elementCount()),
      job_([this](Work& work) { return verify(work); }) {}

void MeshVerifier::report(std::uint64_t& count, Entity entity) {
  if (count == 0) defects_.examples.push_back(entity);
  ++count;
}

/// Owners are tetrahedra, then triangles of the surface.
std::size_t MeshVerifier::elementCount() const { return tetrahedra_ + countTriangles(surface_); }

Task<> MeshVerifier::verify(Work& work) {
  work.beginPart(0.1);
  isUsed_.assign(countNodes(mesh_), 0);
  const std::size_t numbers =
      std::max({std::size_t{countNodes(mesh_)}, std::size_t{countNodes(surface_)}, elementCount()});
  co_await work.forEachBlock(
      numbers, [this](std::size_t first, std::size_t last) { checkNumbers(first, last); });
  if (defects_.invalidNumbers > 0) co_return;

  work.beginPart(0.4);
  co_await findCoincidentNodes(work);

  // Reading elements may mean making them, so their faces are counted in this pass too.
  NodeListPasses<Face> faces(countNodes(mesh_), elementCount(), maxFaces_);
  work.beginPart(0.5);
  co_await work.forEachBlock(tetrahedra_, [&](std::size_t first, std::size_t last) {
    mesh_.forEachElement(first, last, [&](TetId tet, const ElementSource::Element& element) {
      checkTetrahedron(tet, element.corners);
      for (const auto& [a, b, c] : kFaceCorners)
        faces.count(std::min({element.nodes[a], element.nodes[b], element.nodes[c]}));
    });
  });
  for (const TriangleId triangle : IdRange<TriangleId>(countTriangles(surface_)))
    faces.count(std::ranges::min(nodesOf(surface_, triangle)));
  faces.endCounting();

  work.beginPart(1.0);
  co_await matchFaces(work, faces);
  findDuplicateTetrahedra();
  compareVolumes();
}

Task<> MeshVerifier::findCoincidentNodes(Work& work) {
  const std::size_t nodes = countNodes(mesh_);
  const auto bucketOf = [&](NodeId node) {
    return PositionBucketId(static_cast<std::size_t>(hashOf(pointOf(mesh_, node)) % nodes));
  };
  NodeLists<NodeId, PositionBucketId> buckets(nodes);
  work.beginPart(0.4);
  co_await work.forEachId<NodeId>(nodes, [&](NodeId node) {
    if (isUsed_[node.index()] != 0) buckets.count(bucketOf(node));
  });
  buckets.endCounting();
  work.beginPart(0.7);
  co_await work.forEachId<NodeId>(nodes, [&](NodeId node) {
    if (isUsed_[node.index()] != 0) buckets.add(bucketOf(node), node);
  });
  work.beginPart(1.0);
  co_await work.forEachId<PositionBucketId>(
      nodes, [&](PositionBucketId bucket) { comparePositions(buckets.at(bucket)); });
}

Task<> MeshVerifier::matchFaces(Work& work, NodeListPasses<Face>& faces) {
  const double perPass = 1.0 / static_cast<double>(faces.passCount());
  for (double done = 0.0; faces.beginPass(); done += perPass) {
    work.beginPart(done + 0.4 * perPass);
    co_await work.forEachId<FaceId>(faces.chunks().size(), [&](FaceId i) {
      const std::uint32_t chunk = faces.chunks()[i.index()];
      forEachFace(faces.firstOf(chunk), faces.lastOf(chunk),
                  [&](const SortedFace& face, std::uint32_t owner) {
                    const auto [lowest, middle, highest] = face.nodes;
                    faces.add(chunk, lowest,
                              {middle, highest, owner << 1U | (face.isEven ? 1U : 0U)});
                  });
    });
    work.beginPart(done + perPass);
    co_await work.forEachId<NodeId>(faces.nodeCount(), [&](NodeId i) {
      matchFacesOf(faces.at(NodeId(faces.firstNode() + i.index())));
    });
  }
}

/// Checks the numbers of nodes, surface nodes, tetrahedra and triangles in [first, last).
void MeshVerifier::checkNumbers(std::size_t first, std::size_t last) {
  const std::uint32_t nodes = countNodes(mesh_);
  const std::uint32_t surfaceNodes = std::min(nodes, countNodes(surface_));
  const auto check = [&](const auto& numbers, std::size_t perItem, EntityKind kind,
                         auto isInvalid) {
    const std::size_t end = std::min(perItem * last, numbers.size());
    for (std::size_t i = perItem * first; i < end; ++i) {
      if (!isInvalid(numbers[i])) continue;
      report(defects_.invalidNumbers, {kind, static_cast<std::uint32_t>(i / perItem)});
    }
  };
  for (std::size_t i = first; i < std::min<std::size_t>(last, nodes); ++i) {
    const Vec3 p = pointOf(mesh_, NodeId(i));
    const bool isFinite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    if (!isFinite) report(defects_.invalidNumbers, NodeId(i));
  }
  mesh_.forEachNodes(std::min(first, tetrahedra_), std::min(last, tetrahedra_),
                     [&](TetId tet, const NodeQuad& own) {
                       for (const NodeId node : own) {
                         if (node.value >= nodes) {
                           report(defects_.invalidNumbers, tet);
                         } else {
                           isUsed_[node.index()] = 1;
                         }
                       }
                     });
  check(surface_.triangles, 3, EntityKind::kTriangle,
        [&](std::uint32_t node) { return node >= surfaceNodes; });
  if (first == 0 && !surface_.triangleRegions.empty() && !mesh_.hasRegions()) {
    report(defects_.invalidNumbers, TetId(std::size_t{0}));
  }
  checkKept(first, last);
}

void MeshVerifier::checkKept(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < std::min<std::size_t>(last, countNodes(surface_)); ++i) {
    const NodeId node(i);
    const bool isKept = i < countNodes(mesh_) && pointOf(mesh_, node) == pointOf(surface_, node);
    if (!isKept) report(defects_.movedNodes, node);
  }
}

/// Reports the nodes of a bucket that have the position of another.
void MeshVerifier::comparePositions(std::span<NodeId> nodes) {
  const auto positionOf = [this](NodeId node) {
    const Vec3 p = pointOf(mesh_, node);
    return std::array{p.x, p.y, p.z};
  };
  sortFew(nodes, [&](NodeId a, NodeId b) { return positionOf(a) < positionOf(b); });
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (positionOf(nodes[i]) == positionOf(nodes[i - 1]))
      report(defects_.coincidentNodes, nodes[i]);
  }
}

void MeshVerifier::checkTetrahedron(TetId tet, const std::array<Vec3, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  if (orient3d(a, b, c, d) <= 0) report(defects_.invertedTetrahedra, tet);
  volume_.add(sixVolumes(b - a, c - a, d - a) / 6.0);
}

/// Calls use(face, owner) for the faces of elements in [first, last).
template <class Use>
void MeshVerifier::forEachFace(std::size_t first, std::size_t last, Use use) const {
  mesh_.forEachNodes(std::min(first, tetrahedra_), std::min(last, tetrahedra_),
                     [&](TetId tet, const NodeQuad& nodes) {
                       for (const auto& [a, b, c] : kFaceCorners) {
                         use(sortedFace({nodes[a], nodes[b], nodes[c]}), tet.value);
                       }
                     });
  for (std::size_t e = std::max(first, tetrahedra_); e < last; ++e) {
    use(sortedFace(nodesOf(surface_, TriangleId(e - tetrahedra_))), static_cast<std::uint32_t>(e));
  }
}

/// Matches the faces with the same lowest node.
void MeshVerifier::matchFacesOf(std::span<Face> faces) {
  sortFew(faces, [](const Face& a, const Face& b) {
    if (a.middle != b.middle) return a.middle < b.middle;
    if (a.highest != b.highest) return a.highest < b.highest;
    return a.ownerAndOrientation < b.ownerAndOrientation;
  });
  const auto isSame = [](const Face& a, const Face& b) {
    return a.middle == b.middle && a.highest == b.highest;
  };
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t last = first + 1;
    while (last < faces.size() && isSame(faces[first], faces[last])) ++last;
    matchOwners(faces.subspan(first, last - first));
    first = last;
  }
}

bool MeshVerifier::isTetrahedron(const Face& face) const { return face.owner() < tetrahedra_; }

TriangleId MeshVerifier::triangleOf(const Face& face) const {
  return TriangleId(face.owner() - tetrahedra_);
}

/// Checks the owners of one face. Tetrahedra sort before triangles.
void MeshVerifier::matchOwners(std::span<const Face> owners) {
  const auto isTriangle = [this](const Face& face) { return !isTetrahedron(face); };
  const auto middle = std::ranges::find_if(owners, isTriangle) - owners.begin();
  const std::span<const Face> tetrahedra = owners.first(static_cast<std::size_t>(middle));
  const std::span<const Face> triangles = owners.subspan(static_cast<std::size_t>(middle));
  const bool isTwoSided =
      tetrahedra.size() == 2 && tetrahedra[0].isEven() != tetrahedra[1].isEven();
  if (isTwoSided && triangles.empty()) return matchInnerRegions(tetrahedra[0], tetrahedra[1]);
  const bool isInterface =
      triangles.size() == 1 && surface_.isInterface(triangleOf(triangles[0]).index());
  const bool isBoundary = tetrahedra.size() == 1 && triangles.size() == 1 &&
                          tetrahedra[0].isEven() == triangles[0].isEven();
  if (isInterface ? isTwoSided : isBoundary) {
    for (const Face& face : tetrahedra) matchRegion(face, triangles[0]);
    return;
  }
  for (const Face& face : tetrahedra) suspects_.emplace_back(face.owner());
  for (const Face& face : triangles) report(defects_.missingTriangles, triangleOf(face));
  if (tetrahedra.empty()) return;
  const TetId tet(tetrahedra[0].owner());
  if (tetrahedra.size() > 2) report(defects_.nonManifoldFaces, tet);
  if (tetrahedra.size() == 2 && !isTwoSided) report(defects_.overlappingFaces, tet);
  if (tetrahedra.size() == 1 && !isInterface) report(defects_.extraBoundaryFaces, tet);
}

/// Checks that regions end only at triangles of the surface.
void MeshVerifier::matchInnerRegions(const Face& one, const Face& other) {
  if (surface_.triangleRegions.empty()) return;
  if (mesh_.regionOf(TetId(one.owner())) == mesh_.regionOf(TetId(other.owner()))) return;
  report(defects_.wrongRegions, TetId(one.owner()));
}

void MeshVerifier::matchRegion(const Face& tetrahedron, const Face& triangle) {
  if (surface_.triangleRegions.empty()) return;
  const std::size_t front = tetrahedron.isEven() != triangle.isEven() ? 1 : 0;
  const std::uint32_t region = surface_.triangleRegions[2 * triangleOf(triangle).index() + front];
  if (mesh_.regionOf(TetId(tetrahedron.owner())) == region) return;
  report(defects_.wrongRegions, TetId(tetrahedron.owner()));
}

/// A duplicate tetrahedron leaves none of its faces matched, so both copies are among the suspects.
void MeshVerifier::findDuplicateTetrahedra() {
  struct Suspect {
    NodeQuad nodes;  ///< ascending
    TetId tet;
  };
  sortUnique(suspects_);
  std::vector<Suspect> suspects;
  for (const TetId tet : suspects_) suspects.push_back({sorted(nodesOf(mesh_, tet)), tet});
  stableSort(suspects, [](const Suspect& a, const Suspect& b) { return a.nodes < b.nodes; });
  for (std::size_t i = 1; i < suspects.size(); ++i) {
    if (suspects[i].nodes == suspects[i - 1].nodes) {
      report(defects_.duplicateTetrahedra, suspects[i].tet);
    }
  }
}

void MeshVerifier::compareVolumes() {
  defects_.meshVolume = volume_.value();
  CompensatedSum enclosed;
  for (const TriangleId triangle : IdRange<TriangleId>(countTriangles(surface_))) {
    if (surface_.isInterface(triangle.index())) continue;
    const Spanned spanned = spannedBy(surface_, originOf(surface_), triangle);
    enclosed.add(sixVolumes(spanned.toTriangle, spanned.first, spanned.second) / 6.0);
  }
  defects_.surfaceVolume = enclosed.value();
  const double difference = std::fabs(defects_.meshVolume - defects_.surfaceVolume);
  const double tolerance = kVolumeTolerance * std::fabs(defects_.surfaceVolume);
  if (difference <= tolerance) return;
  if (!(difference <= tolerance + volumeRounding())) defects_.wrongVolume = 1;
}

/// Returns how much the two volumes may differ through rounding.
double MeshVerifier::volumeRounding() const {
  double products = 0.0;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    products += std::sqrt(glm::dot(a, a) * glm::dot(b, b) * glm::dot(c, c));
  };
  mesh_.forEachElement(0, tetrahedra_, [&](TetId /*tet*/, const ElementSource::Element& element) {
    const auto& [a, b, c, d] = element.corners;
    add(b - a, c - a, d - a);
  });
  for (const TriangleId triangle : IdRange<TriangleId>(countTriangles(surface_))) {
    const Spanned spanned = spannedBy(surface_, originOf(surface_), triangle);
    add(spanned.toTriangle, spanned.first, spanned.second);
  }
  return kRoundingPerTerm * products / 6.0;
}

MeshDefects verifyMesh(const MeshView& mesh, const SurfaceMesh& surface) {
  MeshVerifier verifier(mesh, surface);
  finish(verifier);
  return verifier.defects();
}

}  // namespace tetrafront
