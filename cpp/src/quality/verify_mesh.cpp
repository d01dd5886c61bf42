#include "quality/verify_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "base/sort.h"
#include "geom/tetrahedron.h"
#include "geom/predicates.h"
#include "tetrafront/vec3.h"

namespace tetrafront {
namespace {

/// The two volumes are sums of rounded terms. A difference is a defect if it exceeds this fraction
/// of them and also exceeds what rounding can cause, which is a much larger fraction for long and
/// thin bodies.
constexpr double kVolumeTolerance = 1e-10;
/// Bound on the rounding error of the differences, products and sums of one term, with room for the
/// sum of all terms.
constexpr double kRoundingPerTerm = 16.0 * std::numeric_limits<double>::epsilon();

/// Faces of tetrahedron a b c d as seen from outside (mesh.h).
Vec3 pointOf(const std::vector<double>& points, std::uint32_t node) {
  const std::size_t i = 3 * std::size_t{node};
  return {points[i], points[i + 1], points[i + 2]};
}

double sixVolumes(const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

/// Equal for equal positions, although 0 and -0 differ in their bits.
std::uint64_t hashOf(const Vec3& place) {
  // Any odd constant with well-mixed bits works: here 2^64 divided by the golden ratio.
  constexpr std::uint64_t kMultiplier = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = 0;
  for (const double x : {place.x, place.y, place.z}) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * kMultiplier;
    hash ^= hash >> 32U;
  }
  return hash;
}

/// Nodes in ascending order, and whether the permutation is even.
struct SortedFace {
  std::array<std::uint32_t, 3> nodes;
  bool isEven;
};

SortedFace sorted(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  SortedFace face{{a, b, c}, true};
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

/// Vector from `origin` to the triangle, and two of its edges. With a far origin, the volume of a
/// small triangle is then a small product with a small rounding error; most triangles are small.
std::array<Vec3, 3> spannedBy(const SurfaceMesh& surface, const Vec3& origin,
                              std::size_t firstCorner) {
  const Vec3 a = pointOf(surface.points, surface.triangles[firstCorner]);
  return {a - origin, pointOf(surface.points, surface.triangles[firstCorner + 1]) - a,
          pointOf(surface.points, surface.triangles[firstCorner + 2]) - a};
}

}  // namespace

std::uint64_t MeshDefects::count() const {
  return badNumbers + movedNodes + coincidentNodes + invertedTetrahedra + duplicateTetrahedra +
         nonManifoldFaces + overlappingFaces + extraBoundaryFaces + missingTriangles +
         wrongRegions + wrongVolume;
}

MeshVerifier::MeshVerifier(const VolumeMesh& mesh, const SurfaceMesh& surface)
    : mesh_(mesh), surface_(surface) {}

/// Owners are tetrahedra, then triangles of the surface.
std::size_t MeshVerifier::elementCount() const {
  return mesh_.tetrahedra.size() / 4 + surface_.triangles.size() / 3;
}

bool MeshVerifier::advance(std::uint32_t budget) {
  const std::size_t tetrahedra = mesh_.tetrahedra.size() / 4;
  const std::size_t nodes = mesh_.points.size() / 3;
  const auto slice = [&](std::size_t end, Stage following, auto work) {
    const std::size_t first = next_;
    next_ += std::min<std::size_t>(end - next_, budget);
    work(first, next_);
    if (next_ < end) return;
    next_ = 0;
    stage_ = following;
  };
  switch (stage_) {
    case Stage::kNumbers:
      slice(std::max({nodes, surface_.points.size() / 3, elementCount()}), Stage::kMarkNodes,
            [this](std::size_t a, std::size_t b) { checkNumbers(a, b); });
      if (stage_ != Stage::kMarkNodes) break;
      if (defects_.badNumbers > 0) stage_ = Stage::kDone;
      isUsed_.assign(nodes, 0);
      break;
    case Stage::kMarkNodes:
      slice(tetrahedra, Stage::kCountPlaces,
            [this](std::size_t a, std::size_t b) { markNodes(a, b); });
      if (stage_ == Stage::kCountPlaces) emptyBuckets();
      break;
    case Stage::kCountPlaces:
      slice(nodes, Stage::kSortPlaces, [this](std::size_t a, std::size_t b) {
        forEachPlace(a, b, [this](std::uint32_t, std::size_t bucket) { ++buckets_[bucket + 1]; });
      });
      if (stage_ != Stage::kSortPlaces) break;
      layOutBuckets();
      places_.resize(buckets_[nodes]);
      break;
    case Stage::kSortPlaces:
      slice(nodes, Stage::kMatchPlaces, [this](std::size_t a, std::size_t b) {
        forEachPlace(a, b, [this](std::uint32_t node, std::size_t bucket) {
          places_[filled_[bucket]++] = node;
        });
      });
      break;
    case Stage::kMatchPlaces:
      slice(nodes, Stage::kTetrahedra, [this](std::size_t a, std::size_t b) { matchPlaces(a, b); });
      if (stage_ == Stage::kTetrahedra) emptyBuckets();
      break;
    case Stage::kTetrahedra:
      slice(tetrahedra, Stage::kCountFaces,
            [this](std::size_t a, std::size_t b) { checkTetrahedra(a, b); });
      break;
    case Stage::kCountFaces:
      slice(elementCount(), Stage::kSortFaces,
            [this](std::size_t a, std::size_t b) { countFaces(a, b); });
      if (stage_ != Stage::kSortFaces) break;
      layOutBuckets();
      // Leave the array uninitialized: zeroing it here would touch all its pages in one slice.
      faces_ = std::make_unique_for_overwrite<Face[]>(buckets_[nodes]);
      break;
    case Stage::kSortFaces:
      slice(elementCount(), Stage::kMatchFaces,
            [this](std::size_t a, std::size_t b) { sortFaces(a, b); });
      break;
    case Stage::kMatchFaces:
      slice(nodes, Stage::kDone, [this](std::size_t a, std::size_t b) { matchFaces(a, b); });
      if (stage_ == Stage::kDone) finish();
      break;
    case Stage::kDone:
      break;
  }
  return stage_ == Stage::kDone;
}

double MeshVerifier::fraction() const {
  return static_cast<double>(stage_) / static_cast<double>(Stage::kDone);
}

void MeshVerifier::emptyBuckets() { buckets_.assign(mesh_.points.size() / 3 + 1, 0); }

/// Turns counts (bucket i's at i + 1) into the begin of each bucket.
void MeshVerifier::layOutBuckets() {
  for (std::size_t i = 1; i < buckets_.size(); ++i) buckets_[i] += buckets_[i - 1];
  filled_.assign(buckets_.begin(), buckets_.end() - 1);
}

/// Checks the numbers of nodes, surface nodes, tetrahedra and triangles in [first, last).
void MeshVerifier::checkNumbers(std::size_t first, std::size_t last) {
  const std::size_t nodes = mesh_.points.size() / 3;
  const std::size_t surfaceNodes = std::min(nodes, surface_.points.size() / 3);
  const auto count = [&](const auto& numbers, std::size_t perItem, auto isBad) {
    const std::size_t end = std::min(perItem * last, numbers.size());
    for (std::size_t i = perItem * first; i < end; ++i)
      defects_.badNumbers += isBad(numbers[i]) ? 1U : 0U;
  };
  count(mesh_.points, 3, [](double x) { return !std::isfinite(x); });
  count(mesh_.tetrahedra, 4, [&](std::uint32_t node) { return node >= nodes; });
  count(surface_.triangles, 3, [&](std::uint32_t node) { return node >= surfaceNodes; });
  const std::size_t wanted = surface_.triangleRegions.empty() ? 0 : mesh_.tetrahedra.size() / 4;
  if (first == 0 && mesh_.regions.size() < wanted) ++defects_.badNumbers;
  checkKept(first, last);
}

void MeshVerifier::checkKept(std::size_t first, std::size_t last) {
  const std::size_t nodes = mesh_.points.size() / 3;
  for (std::size_t node = first; node < std::min(last, surface_.points.size() / 3); ++node) {
    const auto i = static_cast<std::uint32_t>(node);
    const bool isKept = node < nodes && pointOf(mesh_.points, i) == pointOf(surface_.points, i);
    defects_.movedNodes += isKept ? 0U : 1U;
  }
}

void MeshVerifier::markNodes(std::size_t first, std::size_t last) {
  for (std::size_t i = 4 * first; i < 4 * last; ++i) isUsed_[mesh_.tetrahedra[i]] = 1;
}

/// Calls use(node, bucket) for the used nodes in [first, last).
template <class Use>
void MeshVerifier::forEachPlace(std::size_t first, std::size_t last, Use use) const {
  for (std::size_t node = first; node < last; ++node) {
    if (isUsed_[node] == 0) continue;
    const auto i = static_cast<std::uint32_t>(node);
    use(i, hashOf(pointOf(mesh_.points, i)) % isUsed_.size());
  }
}

void MeshVerifier::matchPlaces(std::size_t firstBucket, std::size_t lastBucket) {
  std::vector<std::array<double, 3>> places;
  for (std::size_t bucket = firstBucket; bucket < lastBucket; ++bucket) {
    if (buckets_[bucket + 1] - buckets_[bucket] < 2) continue;
    places.clear();
    for (std::uint32_t i = buckets_[bucket]; i < buckets_[bucket + 1]; ++i) {
      const Vec3 p = pointOf(mesh_.points, places_[i]);
      places.push_back({p.x, p.y, p.z});
    }
    stableSort(places);
    for (std::size_t i = 1; i < places.size(); ++i)
      defects_.coincidentNodes += places[i] == places[i - 1] ? 1U : 0U;
  }
}

void MeshVerifier::checkTetrahedra(std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = pointOf(mesh_.points, mesh_.tetrahedra[4 * t + k]);
    if (orient3d(p[0], p[1], p[2], p[3]) <= 0) ++defects_.invertedTetrahedra;
    defects_.meshVolume += sixVolumes(p[1] - p[0], p[2] - p[0], p[3] - p[0]) / 6.0;
  }
}

/// Calls use(face, owner) for the faces of elements in [first, last).
template <class Use>
void MeshVerifier::forEachFace(std::size_t first, std::size_t last, Use use) const {
  const std::size_t tetrahedra = mesh_.tetrahedra.size() / 4;
  for (std::size_t e = first; e < std::min(last, tetrahedra); ++e) {
    const std::uint32_t* nodes = &mesh_.tetrahedra[4 * e];
    for (const auto& face : kFaceCorners) {
      use(sorted(nodes[face[0]], nodes[face[1]], nodes[face[2]]), static_cast<std::uint32_t>(e));
    }
  }
  for (std::size_t e = std::max(first, tetrahedra); e < last; ++e) {
    const std::uint32_t* nodes = &surface_.triangles[3 * (e - tetrahedra)];
    use(sorted(nodes[0], nodes[1], nodes[2]), static_cast<std::uint32_t>(e));
  }
}

void MeshVerifier::countFaces(std::size_t first, std::size_t last) {
  forEachFace(first, last,
              [this](const SortedFace& face, std::uint32_t) { ++buckets_[face.nodes[0] + 1]; });
}

void MeshVerifier::sortFaces(std::size_t first, std::size_t last) {
  forEachFace(first, last, [this](const SortedFace& face, std::uint32_t owner) {
    faces_[filled_[face.nodes[0]]++] = {face.nodes[1], face.nodes[2],
                                        owner << 1U | (face.isEven ? 1U : 0U)};
  });
}

void MeshVerifier::matchFaces(std::size_t firstNode, std::size_t lastNode) {
  for (std::size_t node = firstNode; node < lastNode; ++node) {
    Face* const begin = faces_.get() + buckets_[node];
    Face* const end = faces_.get() + buckets_[node + 1];
    sortFew(std::span(begin, end), [](const Face& a, const Face& b) {
      if (a.middle != b.middle) return a.middle < b.middle;
      if (a.highest != b.highest) return a.highest < b.highest;
      return a.ownerAndTurn < b.ownerAndTurn;
    });
    for (Face* first = begin; first != end;) {
      Face* last = first + 1;
      while (last != end && last->middle == first->middle && last->highest == first->highest)
        ++last;
      matchOne(first, last);
      first = last;
    }
  }
}

/// Returns the index of the owner among the surface's triangles.
std::size_t MeshVerifier::triangleOf(const Face& face) const {
  return (face.ownerAndTurn >> 1U) - mesh_.tetrahedra.size() / 4;
}

/// Checks the owners [first, last) of one face. Tetrahedra sort before triangles.
void MeshVerifier::matchOne(const Face* first, const Face* last) {
  const Face* triangles = first;
  while (triangles != last && triangles->ownerAndTurn >> 1U < mesh_.tetrahedra.size() / 4)
    ++triangles;
  const auto tetrahedra = static_cast<std::size_t>(triangles - first);
  const auto wanted = static_cast<std::size_t>(last - triangles);
  const auto turn = [](const Face& face) { return face.ownerAndTurn & 1U; };
  const bool isTwoSided = tetrahedra == 2 && turn(first[0]) != turn(first[1]);
  if (isTwoSided && wanted == 0) return matchInnerRegions(first[0], first[1]);
  const bool isInterface = wanted == 1 && surface_.isInterface(triangleOf(*triangles));
  if (isInterface ? isTwoSided
                  : tetrahedra == 1 && wanted == 1 && turn(first[0]) == turn(*triangles)) {
    for (const Face* face = first; face != triangles; ++face) matchRegion(*face, *triangles);
    return;
  }
  if (tetrahedra > 2) ++defects_.nonManifoldFaces;
  if (tetrahedra == 2 && !isTwoSided) ++defects_.overlappingFaces;
  if (tetrahedra == 1 && !isInterface) ++defects_.extraBoundaryFaces;
  defects_.missingTriangles += wanted;
  for (const Face* face = first; face != triangles; ++face) {
    suspects_.push_back(face->ownerAndTurn >> 1U);
  }
}

/// Checks that regions end only at triangles of the surface.
void MeshVerifier::matchInnerRegions(const Face& one, const Face& other) {
  if (surface_.triangleRegions.empty()) return;
  const bool agree =
      mesh_.regions[one.ownerAndTurn >> 1U] == mesh_.regions[other.ownerAndTurn >> 1U];
  defects_.wrongRegions += agree ? 0U : 1U;
}

void MeshVerifier::matchRegion(const Face& tetrahedron, const Face& triangle) {
  if (surface_.triangleRegions.empty()) return;
  const std::size_t front = (tetrahedron.ownerAndTurn ^ triangle.ownerAndTurn) & 1U;
  const std::uint32_t wanted = surface_.triangleRegions[2 * triangleOf(triangle) + front];
  defects_.wrongRegions += mesh_.regions[tetrahedron.ownerAndTurn >> 1U] == wanted ? 0U : 1U;
}

void MeshVerifier::finish() {
  // A duplicate tetrahedron leaves none of its faces matched, so both copies are among the
  // suspects.
  sortUnique(suspects_);
  std::vector<std::array<std::uint32_t, 4>> keys;
  for (const std::uint32_t t : suspects_) {
    std::array<std::uint32_t, 4> key;
    std::copy_n(mesh_.tetrahedra.begin() + std::ptrdiff_t{4} * t, 4, key.begin());
    keys.push_back(sorted(key));
  }
  stableSort(keys);
  for (std::size_t i = 1; i < keys.size(); ++i) {
    defects_.duplicateTetrahedra += keys[i] == keys[i - 1] ? 1U : 0U;
  }
  if (!surface_.triangles.empty()) {
    const Vec3 origin = pointOf(surface_.points, surface_.triangles[0]);
    for (std::size_t h = 0; h < surface_.triangles.size(); h += 3) {
      if (surface_.isInterface(h / 3)) continue;
      const std::array<Vec3, 3> spanned = spannedBy(surface_, origin, h);
      defects_.surfaceVolume += sixVolumes(spanned[0], spanned[1], spanned[2]) / 6.0;
    }
  }
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
  for (std::size_t i = 0; i < mesh_.tetrahedra.size(); i += 4) {
    const Vec3 origin = pointOf(mesh_.points, mesh_.tetrahedra[i]);
    add(pointOf(mesh_.points, mesh_.tetrahedra[i + 1]) - origin,
        pointOf(mesh_.points, mesh_.tetrahedra[i + 2]) - origin,
        pointOf(mesh_.points, mesh_.tetrahedra[i + 3]) - origin);
  }
  for (std::size_t i = 0; i < surface_.triangles.size(); i += 3) {
    const std::array<Vec3, 3> spanned =
        spannedBy(surface_, pointOf(surface_.points, surface_.triangles[0]), i);
    add(spanned[0], spanned[1], spanned[2]);
  }
  return kRoundingPerTerm * products / 6.0;
}

MeshDefects verifyMesh(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  constexpr std::uint32_t kSlice = 1U << 16U;
  MeshVerifier verifier(mesh, surface);
  while (!verifier.advance(kSlice)) {
  }
  return verifier.defects();
}

}  // namespace tetrafront
