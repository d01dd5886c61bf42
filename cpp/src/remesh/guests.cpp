#include "remesh/guests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "base/sort.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Tolerance x curvature from which a bend is tight. A surface within a distance d of a bend by 90 degrees can cut off
/// 1.42 d - 0.42 / curvature.
constexpr double kTightBend = 0.5;
/// Cosine of the angle from which a single edge is a tight bend, 45 degrees, and of the one below which it is flat.
constexpr double kTightCosine = 0.70710678118654752;
constexpr double kFlatCosine = 0.999998;
/// Distance between points along a tight bend / tolerance, if there are no more of them on an edge than this.
constexpr double kGuestSpacing = 0.5;
constexpr double kMaxGuestsPerEdge = 1000.0;
/// The distance is larger if there would be more of these points than this on all edges.
constexpr double kMaxBendGuests = 2e6;

/// A bend: an edge between two triangles of a curved patch.
struct Bend {
  HalfEdgeId halfEdge;
  double cosine;  ///< between the normals of its triangles
};

/// Lists the bends that are not flat, each once.
std::vector<Bend> findBends(const ReferenceSurface& reference) {
  std::vector<Bend> bends;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(reference.mesh()))) {
    if (reference.patch(reference.patchOf(t)).isPlanar) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const TriangleId other = reference.smoothNeighbour(halfEdgeOf(t, k));
      if (other.isNone() || other < t) continue;
      const double cosine = glm::dot(reference.normalOf(t), reference.normalOf(other));
      if (cosine < kFlatCosine) bends.push_back({halfEdgeOf(t, k), cosine});
    }
  }
  return bends;
}

/// Places guests along the tight ones among the bends. Of points that are very near to each other, only one is kept.
class BendGuests {
 public:
  BendGuests(const ReferenceSurface& reference, double tolerance)
      : reference_(reference), spacing_(kGuestSpacing * tolerance), tolerance_(tolerance) {}

  void place(const std::vector<Bend>& bends);
  /// Adds the points that were placed.
  void moveTo(std::vector<Guest>& guests);

 private:
  struct Placed {
    std::uint32_t patch;
    std::array<double, 3> cell;
    Guest guest;
  };
  [[nodiscard]] std::array<Vec3, 2> endsOf(HalfEdgeId halfEdge) const {
    const HalfEdgeNodes nodes = nodesOf(reference_.mesh().triangles, halfEdge);
    return {pointOf(reference_.mesh(), nodes.from), pointOf(reference_.mesh(), nodes.to)};
  }
  void findCurvatures(const std::vector<Bend>& bends);
  [[nodiscard]] bool isTight(const Bend& bend) const;
  void placeAlong(HalfEdgeId halfEdge);

  const ReferenceSurface& reference_;
  double spacing_;
  double tolerance_;
  std::vector<double>
      curvature_;  ///< per given triangle: of the bends at its edges, regardless of their sign
  std::vector<Placed> placed_;
};

void BendGuests::findCurvatures(const std::vector<Bend>& bends) {
  curvature_.assign(countTriangles(reference_.mesh()), 0.0);
  for (const auto& [halfEdge, cosine] : bends) {
    const auto [from, to] = endsOf(halfEdge);
    const double turn = 0.5 * std::sqrt(2.0 - 2.0 * cosine) * glm::length(to - from);
    for (const TriangleId t : {triangleOf(halfEdge), reference_.smoothNeighbour(halfEdge)}) {
      curvature_[t.index()] += turn / areaOf(cornersOf(reference_.mesh(), t));
    }
  }
}

bool BendGuests::isTight(const Bend& bend) const {
  if (bend.cosine < kTightCosine) return true;
  const TriangleId other = reference_.smoothNeighbour(bend.halfEdge);
  const double curvature =
      std::max(curvature_[triangleOf(bend.halfEdge).index()], curvature_[other.index()]);
  return curvature * tolerance_ > kTightBend;
}

void BendGuests::placeAlong(HalfEdgeId halfEdge) {
  const auto [from, to] = endsOf(halfEdge);
  const double pieces = std::min(std::ceil(glm::length(to - from) / spacing_), kMaxGuestsPerEdge);
  const TriangleId triangle = triangleOf(halfEdge);
  for (double i = 1.0; i < pieces; i += 1.0) {
    const Vec3 position = from + (to - from) * (i / pieces);
    Placed placed{reference_.patchOf(triangle).value, {}, {position, triangle}};
    for (std::size_t k = 0; k < 3; ++k) {
      placed.cell[k] = std::floor(position[static_cast<int>(k)] / (0.5 * spacing_));
    }
    placed_.push_back(placed);
  }
}

void BendGuests::place(const std::vector<Bend>& bends) {
  findCurvatures(bends);
  std::vector<HalfEdgeId> tight;
  double length = 0.0;
  for (const Bend& bend : bends) {
    if (!isTight(bend)) continue;
    const auto [from, to] = endsOf(bend.halfEdge);
    length += glm::length(to - from);
    tight.push_back(bend.halfEdge);
  }
  spacing_ = std::max(spacing_, length / kMaxBendGuests);
  for (const HalfEdgeId halfEdge : tight) placeAlong(halfEdge);
}

void BendGuests::moveTo(std::vector<Guest>& guests) {
  stableSort(placed_, [](const Placed& a, const Placed& b) {
    return std::tie(a.patch, a.cell) < std::tie(b.patch, b.cell);
  });
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    if (i > 0 && placed_[i].patch == placed_[i - 1].patch && placed_[i].cell == placed_[i - 1].cell)
      continue;
    guests.push_back(placed_[i].guest);
  }
}

}  // namespace

std::vector<Guest> findGuests(const ReferenceSurface& reference, const SurfaceComplex& given,
                              double tolerance) {
  std::vector<Guest> guests;
  const SurfaceMesh& mesh = reference.mesh();
  std::vector<std::uint8_t> isFound(countNodes(mesh), 0);
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    if (reference.patch(reference.patchOf(t)).isPlanar) continue;
    for (const NodeId node : nodesOf(mesh, t)) {
      if (given.kindOf(node) != NodeKind::kSmooth || isFound[node.index()] != 0) continue;
      isFound[node.index()] = 1;
      guests.push_back({pointOf(mesh, node), t});
    }
  }
  BendGuests bends(reference, tolerance);
  bends.place(findBends(reference));
  bends.moveTo(guests);
  return guests;
}

}  // namespace tetrafront
