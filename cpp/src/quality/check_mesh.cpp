#include "quality/check_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "geom/predicates.h"
#include "tetrafront/vec3.h"

namespace tetrafront {
namespace {

/// The two volumes are sums of rounded terms; more than this share of them is a defect.
constexpr double kVolumeTolerance = 1e-10;

/// Faces of tetrahedron a b c d seen from outside (mesh.h).
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

Vec3 pointOf(const std::vector<double>& points, std::uint32_t node) {
  const std::size_t i = 3 * std::size_t{node};
  return {points[i], points[i + 1], points[i + 2]};
}

double sixVolumes(const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

/// Nodes in ascending order, and whether an even number of exchanges led there.
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

}  // namespace

std::uint64_t MeshDefects::count() const {
  return badNumbers + movedNodes + coincidentNodes + invertedTetrahedra + repeatedTetrahedra +
         overfullFaces + onesidedFaces + extraBoundaryFaces + missingTriangles + wrongVolume;
}

MeshVerifier::MeshVerifier(const VolumeMesh& mesh, const SurfaceMesh& surface)
    : mesh_(mesh), surface_(surface) {}

/// Tetrahedra, then triangles of the surface.
std::size_t MeshVerifier::elementCount() const {
  return mesh_.tetrahedra.size() / 4 + surface_.triangles.size() / 3;
}

bool MeshVerifier::advance(std::uint32_t budget) {
  const std::size_t tetrahedra = mesh_.tetrahedra.size() / 4;
  const std::size_t nodes = mesh_.points.size() / 3;
  const auto slice = [&](std::size_t end, Stage following, auto work) {
    const std::size_t first = next_;
    next_ = std::min(end, next_ + budget);
    work(first, next_);
    if (next_ < end) return;
    next_ = 0;
    stage_ = following;
  };
  switch (stage_) {
    case Stage::kNodes:
      checkNodes();
      if (defects_.badNumbers > 0) {
        stage_ = Stage::kDone;
        break;
      }
      checkCoincident();
      buckets_.assign(nodes + 1, 0);
      stage_ = Stage::kTetrahedra;
      break;
    case Stage::kTetrahedra:
      slice(tetrahedra, Stage::kCountFaces,
            [this](std::size_t a, std::size_t b) { checkTetrahedra(a, b); });
      break;
    case Stage::kCountFaces:
      slice(elementCount(), Stage::kSortFaces,
            [this](std::size_t a, std::size_t b) { countFaces(a, b); });
      if (stage_ != Stage::kSortFaces) break;
      for (std::size_t i = 1; i <= nodes; ++i) buckets_[i] += buckets_[i - 1];
      filled_.assign(buckets_.begin(), buckets_.end() - 1);
      faces_.resize(buckets_[nodes]);
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

void MeshVerifier::checkNodes() {
  const std::size_t nodes = mesh_.points.size() / 3;
  const std::size_t surfaceNodes = std::min(nodes, surface_.points.size() / 3);
  for (const double x : mesh_.points) defects_.badNumbers += std::isfinite(x) ? 0U : 1U;
  for (const std::uint32_t node : mesh_.tetrahedra) defects_.badNumbers += node < nodes ? 0U : 1U;
  for (const std::uint32_t node : surface_.triangles) {
    defects_.badNumbers += node < surfaceNodes ? 0U : 1U;
  }
  for (std::size_t i = 0; i < surface_.points.size(); i += 3) {
    const bool isKept = i + 2 < mesh_.points.size() && mesh_.points[i] == surface_.points[i] &&
                        mesh_.points[i + 1] == surface_.points[i + 1] &&
                        mesh_.points[i + 2] == surface_.points[i + 2];
    defects_.movedNodes += isKept ? 0U : 1U;
  }
}

void MeshVerifier::checkCoincident() {
  std::vector<std::uint8_t> isUsed(mesh_.points.size() / 3, 0);
  for (const std::uint32_t node : mesh_.tetrahedra) isUsed[node] = 1;
  std::vector<std::array<double, 3>> places;
  places.reserve(isUsed.size());
  for (std::uint32_t i = 0; i < isUsed.size(); ++i) {
    if (isUsed[i] == 0) continue;
    const Vec3 p = pointOf(mesh_.points, i);
    places.push_back({p.x, p.y, p.z});
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 1; i < places.size(); ++i) {
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

/// Calls use(face, owner) for the faces of elements [first, last).
template <class Use>
void MeshVerifier::forEachFace(std::size_t first, std::size_t last, Use use) const {
  const std::size_t tetrahedra = mesh_.tetrahedra.size() / 4;
  for (std::size_t e = first; e < std::min(last, tetrahedra); ++e) {
    const std::uint32_t* nodes = &mesh_.tetrahedra[4 * e];
    for (const auto& face : kFaces) {
      use(sorted(nodes[face[0]], nodes[face[1]], nodes[face[2]]), static_cast<std::uint32_t>(e));
    }
  }
  for (std::size_t e = std::max(first, tetrahedra); e < last; ++e) {
    const std::uint32_t* nodes = &surface_.triangles[3 * (e - tetrahedra)];
    use(sorted(nodes[0], nodes[1], nodes[2]), kTriangle);
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
    Face* const begin = faces_.data() + buckets_[node];
    Face* const end = faces_.data() + buckets_[node + 1];
    std::sort(begin, end, [](const Face& a, const Face& b) {
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

/// [first, last): everything that has one face. Tetrahedra sort before triangles.
void MeshVerifier::matchOne(const Face* first, const Face* last) {
  const Face* triangles = first;
  while (triangles != last && triangles->ownerAndTurn >> 1U != kTriangle) ++triangles;
  const auto tetrahedra = static_cast<std::size_t>(triangles - first);
  const auto wanted = static_cast<std::size_t>(last - triangles);
  const auto turn = [](const Face& face) { return face.ownerAndTurn & 1U; };
  if (tetrahedra == 2 && wanted == 0 && turn(first[0]) != turn(first[1])) return;
  if (tetrahedra == 1 && wanted == 1 && turn(first[0]) == turn(*triangles)) return;
  if (tetrahedra > 2) ++defects_.overfullFaces;
  if (tetrahedra == 2 && turn(first[0]) == turn(first[1])) ++defects_.onesidedFaces;
  if (tetrahedra == 1) ++defects_.extraBoundaryFaces;
  defects_.missingTriangles += wanted;
  for (const Face* face = first; face != triangles; ++face) {
    suspects_.push_back(face->ownerAndTurn >> 1U);
  }
}

void MeshVerifier::finish() {
  // A repeated tetrahedron leaves no face in order, so both copies are among the suspects.
  std::sort(suspects_.begin(), suspects_.end());
  suspects_.erase(std::unique(suspects_.begin(), suspects_.end()), suspects_.end());
  std::vector<std::array<std::uint32_t, 4>> keys;
  for (const std::uint32_t t : suspects_) {
    std::array<std::uint32_t, 4> key;
    std::copy_n(mesh_.tetrahedra.begin() + std::ptrdiff_t{4} * t, 4, key.begin());
    std::sort(key.begin(), key.end());
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 1; i < keys.size(); ++i) {
    defects_.repeatedTetrahedra += keys[i] == keys[i - 1] ? 1U : 0U;
  }
  if (!surface_.triangles.empty()) {
    const Vec3 origin = pointOf(surface_.points, surface_.triangles[0]);
    for (std::size_t h = 0; h < surface_.triangles.size(); h += 3) {
      defects_.surfaceVolume +=
          sixVolumes(pointOf(surface_.points, surface_.triangles[h]) - origin,
                     pointOf(surface_.points, surface_.triangles[h + 1]) - origin,
                     pointOf(surface_.points, surface_.triangles[h + 2]) - origin) /
          6.0;
    }
  }
  const double difference = std::fabs(defects_.meshVolume - defects_.surfaceVolume);
  if (!(difference <= kVolumeTolerance * std::fabs(defects_.surfaceVolume)))
    defects_.wrongVolume = 1;
}

MeshDefects verifyMesh(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  constexpr std::uint32_t kSlice = 1U << 16U;
  MeshVerifier verifier(mesh, surface);
  while (!verifier.advance(kSlice)) {
  }
  return verifier.defects();
}

}  // namespace tetrafront
