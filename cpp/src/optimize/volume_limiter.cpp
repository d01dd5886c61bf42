#include "optimize/volume_limiter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/diagnostics.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "sizing/expected_count.h"

namespace tetrafront {
namespace {

/// Share of the time before the first split.
constexpr double kSetUpShare = 0.1;

}  // namespace

double neededElements(const TetMesh& mesh, double maxVolume) {
  double needed = 0.0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    const std::vector<Vec3>& p = mesh.points;
    const double sixVolumes =
        sixVolumesBelow(p[a.index()], p[d.index()], p[b.index()], p[c.index()]);
    needed += std::max(1.0, std::ceil(std::fabs(sixVolumes) / (6.0 * maxVolume)));
  }
  return needed;
}

VolumeLimiter::VolumeLimiter(TetMesh mesh, double maxVolume, std::size_t maxTetrahedra)
    : maxVolume_(maxVolume),
      maxTetrahedra_(maxTetrahedra),
      required_(neededElements(mesh, maxVolume)),
      complex_(std::move(mesh)) {}

Task<> VolumeLimiter::run(Work& work) {
  work.beginPart(kSetUpShare);
  co_await complex_.findNeighbours(work);
  given_ = complex_.elementCount();
  hasTooMany_ = required_ > static_cast<double>(maxTetrahedra_);
  work.beginPart(1.0);
  for (bool hasSplit = true; hasSplit && !hasTooMany_;) {
    hasSplit = false;
    for (std::size_t next = 0; next < complex_.slotCount() && !hasTooMany_;) {
      const std::size_t visited = splitSome(work.remaining(), next, hasSplit);
      work.setFraction(fraction());
      co_await work.spend(visited);
    }
  }
}

/// Visits at most `budget` slots from `next` on, and returns how many.
std::size_t VolumeLimiter::splitSome(std::uint32_t budget, std::size_t& next, bool& hasSplit) {
  std::uint32_t visited = 0;
  for (; visited < budget && next < complex_.slotCount(); ++visited) {
    const TetId tet(next);
    const bool isLarge = complex_.isLive(tet) && volumeRatio(tet) > 1.0;
    hasTooMany_ = isLarge && complex_.elementCount() >= maxTetrahedra_;
    if (hasTooMany_) break;
    // A split leaves another element in the slot.
    if (isLarge && split(tet)) {
      hasSplit = true;
    } else {
      ++next;
    }
  }
  return visited;
}

double VolumeLimiter::fraction() const {
  // Halving edges makes about twice as many parts as the volumes require.
  constexpr double kPartsPerRequired = 2.0;
  const double parts = kPartsPerRequired * required_ - static_cast<double>(given_);
  const auto made = static_cast<double>(complex_.elementCount()) - static_cast<double>(given_);
  return parts > 0.0 ? std::min(1.0, made / parts) : 0.0;
}

std::vector<Diagnostic> VolumeLimiter::diagnostics() const {
  double count = 0.0;
  double required = 0.0;
  double worst = 1.0;
  TetId largest;
  std::uint32_t index = 0;
  std::uint32_t largestIndex = 0;
  for (std::size_t t = 0; t < complex_.slotCount(); ++t) {
    const TetId tet(t);
    if (!complex_.isLive(tet)) continue;
    const double ratio = volumeRatio(tet);
    if (ratio > 1.0) ++count;
    required += std::max(1.0, std::ceil(ratio));
    if (ratio > worst) {
      worst = ratio;
      largest = tet;
      largestIndex = index;
    }
    ++index;
  }
  if (largest.isNone()) return {};
  Vec3 centroid(0.0);
  for (const NodeId node : complex_.element(largest).nodes) {
    centroid += 0.25 * complex_.position(node);
  }
  Diagnostic found = hasTooMany_ ? tooManyElements(required, maxTetrahedra_)
                                 : diagnose<DiagnosticCode::kLargeTetrahedra>(count, worst)
                                       .withSeverity(Severity::kWarning);
  return {std::move(found).about({{EntityKind::kTetrahedron, largestIndex}}).at(centroid)};
}

/// Returns the volume / the permitted volume.
double VolumeLimiter::volumeRatio(TetId tet) const {
  const Corners& n = complex_.element(tet).nodes;
  const Vec3& a = complex_.position(n[0]);
  const double sixVolumes =
      sixVolumesBelow(a, complex_.position(n[3]), complex_.position(n[1]), complex_.position(n[2]));
  return sixVolumes / (6.0 * maxVolume_);
}

/// Tries the edges from the longest on.
bool VolumeLimiter::split(TetId tet) {
  const Corners nodes = complex_.element(tet).nodes;
  std::array<std::pair<double, std::size_t>, 6> edges;
  for (std::size_t e = 0; e < 6; ++e) {
    const Vec3 along =
        complex_.position(nodes[kTetEdges[e].to]) - complex_.position(nodes[kTetEdges[e].from]);
    edges[e] = {-glm::dot(along, along), e};
  }
  std::ranges::sort(edges);
  for (const auto& [length, edge] : edges) {
    if (splitEdge(tet, edge)) return true;
  }
  return splitAtCentroid(tet);
}

bool VolumeLimiter::findRing(TetId tet, NodeId from, NodeId to) {
  const std::uint32_t stamp = complex_.freshStamp();
  ring_.assign(1, tet);
  complex_.stamp(tet, stamp);
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const Element& element = complex_.element(ring_[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      if (element.nodes[k] == from || element.nodes[k] == to) continue;
      if (element.across[k].isNone()) return false;
      const TetId next = element.across[k].tet();
      if (complex_.hasStamp(next, stamp)) continue;
      if (ring_.size() == kMaxCavity) return false;
      complex_.stamp(next, stamp);
      ring_.push_back(next);
    }
  }
  return true;
}

bool VolumeLimiter::splitEdge(TetId tet, std::size_t edge) {
  const Corners& nodes = complex_.element(tet).nodes;
  const NodeId from = nodes[kTetEdges[edge].from];
  const NodeId to = nodes[kTetEdges[edge].to];
  if (!findRing(tet, from, to)) return false;
  const NodeId middle = complex_.addNode<PlainSpace>(
      0.5 * complex_.position(from) + 0.5 * complex_.position(to), 0.0);
  std::vector<Corners> made;
  for (const TetId old : ring_) {
    for (const NodeId replaced : {from, to}) {
      Corners corners = complex_.element(old).nodes;
      std::ranges::replace(corners, replaced, middle);
      made.push_back(corners);
    }
  }
  return replaceIfValid(made);
}

bool VolumeLimiter::splitAtCentroid(TetId tet) {
  const Corners nodes = complex_.element(tet).nodes;
  Vec3 centroid(0.0);
  for (const NodeId node : nodes) centroid += 0.25 * complex_.position(node);
  const NodeId middle = complex_.addNode<PlainSpace>(centroid, 0.0);
  ring_.assign(1, tet);
  std::vector<Corners> made(4, nodes);
  for (std::size_t k = 0; k < 4; ++k) made[k][k] = middle;
  return replaceIfValid(made);
}

/// Replaces the elements of the ring if all new ones have positive volume, by exact signs. The new node is unused
/// otherwise.
bool VolumeLimiter::replaceIfValid(const std::vector<Corners>& made) {
  fresh_.clear();
  for (const Corners& n : made) {
    const int sign = orient3d(complex_.position(n[0]), complex_.position(n[1]),
                              complex_.position(n[2]), complex_.position(n[3]));
    if (sign <= 0) return false;
    fresh_.push_back({n, 0.0});
  }
  complex_.replace(ring_, fresh_);
  return true;
}

}  // namespace tetrafront
