// Lawson's flips by shape instead of by circumcircle: on a curved patch the shape in space is
// what counts, and each flip raises the worse of two shapes, so they come to an end. Smoothing
// moves each node towards the mean of the places at which its triangles would be equilateral and
// of the wanted size, and keeps the move only where the worst shape around the node does not
// suffer.

#include "surface/planar_optimizer.h"

#include <algorithm>
#include <cmath>

namespace tetrafront {

namespace {

/// Rounds of smoothing, each followed by flips; beyond, shapes change by less than a percent.
constexpr int kSweeps = 5;
/// A flip must raise the worse shape by this, or rounding could flip for ever.
constexpr double kLeastGain = 1e-6;
/// Cosine of the angle between two triangles' normals below which a flip must not fold them more
/// than they were: on coarsely divided bends the better shapes may cut across the bend.
constexpr double kSharpFold = 0.5;
/// Shares of the wanted move that are tried.
constexpr std::array<double, 2> kMoves{1.0, 0.4};
/// Height of the equilateral triangle over its side.
constexpr double kEquilateralHeight = 0.86602540378443865;

/// Cosine of the angle between the normals of the triangles a b c and b a d.
double foldCosine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 first = glm::cross(b - a, c - a);
  const Vec3 second = glm::cross(d - a, b - a);
  const double product = glm::length(first) * glm::length(second);
  return product > 0.0 ? glm::dot(first, second) / product : 1.0;
}

}  // namespace

PlanarOptimizer::PlanarOptimizer(const PatchMetric& metric, PlanarMesh& mesh)
    : metric_(&metric), mesh_(&mesh) {}

bool PlanarOptimizer::advance(std::uint32_t budget) {
  std::uint32_t work = 0;
  while (stage_ != Stage::kDone && work < budget) {
    if (stage_ == Stage::kLink) {
      link();
      stage_ = Stage::kFlip;
      cursor_ = 0;
      work += static_cast<std::uint32_t>(neighbours_.size() / 8);
    } else if (stage_ == Stage::kFlip) {
      if (cursor_ == neighbours_.size()) {
        stage_ = sweep_ == kSweeps ? Stage::kDone : Stage::kSmooth;
        cursor_ = mesh_->boundaryCount;
        continue;
      }
      flipFrom(cursor_++);
      ++work;
    } else {
      if (cursor_ >= mesh_->plane.size()) {
        stage_ = Stage::kFlip;
        cursor_ = 0;
        ++sweep_;
        continue;
      }
      smooth(cursor_++);
      ++work;
    }
  }
  return stage_ == Stage::kDone;
}

// ---- neighbours --------------------------------------------------------------------------------

void PlanarOptimizer::link() {
  const auto triangleCount = static_cast<std::uint32_t>(mesh_->triangles.size() / 3);
  neighbours_.assign(triangleCount, {PlanarMesh::kNone, PlanarMesh::kNone, PlanarMesh::kNone});
  triangleOf_.assign(mesh_->plane.size(), PlanarMesh::kNone);
  // Each node's triangles, by counting; then each side looks for its twin around one end.
  std::vector<std::uint32_t> starts(mesh_->plane.size() + 1, 0);
  for (const std::uint32_t corner : mesh_->triangles) ++starts[corner + 1];
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  std::vector<std::uint32_t> fill(starts.begin(), starts.end() - 1);
  std::vector<std::uint32_t> around(mesh_->triangles.size());
  for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i)
    around[fill[mesh_->triangles[i]]++] = i / 3;

  for (std::uint32_t t = 0; t < triangleCount; ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = node(t, (k + 1) % 3);
      const std::uint32_t to = node(t, (k + 2) % 3);
      triangleOf_[from] = t;
      for (std::uint32_t i = starts[from]; i < starts[from + 1]; ++i) {
        const std::uint32_t other = around[i];
        const std::uint32_t at = corner(other, from);
        if (node(other, (at + 2) % 3) == to) neighbours_[t][k] = other;
      }
    }
  }
}

std::uint32_t PlanarOptimizer::corner(std::uint32_t triangle, std::uint32_t wanted) const {
  for (std::uint32_t k = 0; k < 2; ++k)
    if (node(triangle, k) == wanted) return k;
  return 2;
}

void PlanarOptimizer::replaceNeighbour(std::uint32_t triangle, std::uint32_t old,
                                       std::uint32_t now) {
  if (triangle == PlanarMesh::kNone) return;
  for (std::uint32_t& neighbour : neighbours_[triangle])
    if (neighbour == old) {
      neighbour = now;
      return;
    }
}

// ---- flips -------------------------------------------------------------------------------------

void PlanarOptimizer::flipFrom(std::uint32_t triangle) {
  // Where the metric changes, each pair of triangles is judged in its own, and a chain of flips
  // might come back to where it began. No other chain is nearly as long.
  constexpr std::size_t kMaxChain = 1000;
  pending_.assign(1, triangle);
  for (std::size_t flips = 0; !pending_.empty() && flips < kMaxChain; ++flips) {
    const std::uint32_t t = pending_.back();
    pending_.pop_back();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t other = neighbours_[t][k];
      if (other == PlanarMesh::kNone || !flip(t, k)) continue;
      pending_.push_back(other);
      pending_.push_back(t);
      break;
    }
  }
}

/// Replaces the side a b between t = (a b c) and its neighbour (b a d) by c d, if that is better:
///
///        c                c
///       /t\              /|\         t     = (c a d)
///      a---b     ->     a | b        other = (c d b)
///       \ /              \|/
///        d                d
bool PlanarOptimizer::flip(std::uint32_t t, std::uint32_t k) {
  const std::uint32_t other = neighbours_[t][k];
  const std::uint32_t c = node(t, k);
  const std::uint32_t a = node(t, (k + 1) % 3);
  const std::uint32_t b = node(t, (k + 2) % 3);
  const std::uint32_t otherA = corner(other, a);
  const std::uint32_t d = node(other, (otherA + 1) % 3);
  if (mesh_->sameNode(c, d)) return false;
  // Summed so that the other diagonal is judged in the very same space.
  const Vec3 middle =
      0.25 * ((mesh_->places[a] + mesh_->places[b]) + (mesh_->places[c] + mesh_->places[d]));
  const LocalSpace local = metric_->spaceAt(middle, mesh_->sizes[a], hint_);
  const Vec3 placeA = local.unit(mesh_->places[a]);
  const Vec3 placeB = local.unit(mesh_->places[b]);
  const Vec3 placeC = local.unit(mesh_->places[c]);
  const Vec3 placeD = local.unit(mesh_->places[d]);
  const double before =
      std::min(triangleShape(placeA, placeB, placeC), triangleShape(placeB, placeA, placeD));
  const double after =
      std::min(triangleShape(placeC, placeA, placeD), triangleShape(placeC, placeD, placeB));
  if (after <= before + kLeastGain || mesh_->turn(c, a, d) <= 0 || mesh_->turn(c, d, b) <= 0)
    return false;
  const double fold = foldCosine(placeC, placeD, placeB, placeA);
  if (fold < kSharpFold && fold < foldCosine(placeA, placeB, placeC, placeD)) return false;

  // Neighbours across b c, c a (of t) and a d, d b (of the other).
  const std::uint32_t overBC = neighbours_[t][(k + 1) % 3];
  const std::uint32_t overCA = neighbours_[t][(k + 2) % 3];
  const std::uint32_t overDB = neighbours_[other][otherA];
  const std::uint32_t overAD = neighbours_[other][corner(other, b)];
  const auto put = [&](std::uint32_t at, std::array<std::uint32_t, 3> nodes, Neighbours around) {
    std::ranges::copy(nodes, mesh_->triangles.begin() + 3 * static_cast<std::ptrdiff_t>(at));
    neighbours_[at] = around;
  };
  put(t, {c, a, d}, {overAD, other, overCA});
  put(other, {c, d, b}, {overDB, overBC, t});
  replaceNeighbour(overAD, other, t);
  replaceNeighbour(overBC, t, other);
  triangleOf_[a] = t;
  triangleOf_[b] = other;
  triangleOf_[c] = t;
  triangleOf_[d] = t;
  return true;
}

// ---- smoothing ---------------------------------------------------------------------------------

bool PlanarOptimizer::collectStar(std::uint32_t centre) {
  ring_.clear();
  const std::uint32_t first = triangleOf_[centre];
  if (first == PlanarMesh::kNone) return false;
  std::uint32_t t = first;
  do {
    const std::uint32_t at = corner(t, centre);
    ring_.push_back(node(t, (at + 1) % 3));
    // The next triangle counter-clockwise lies across the side from the centre to the last node.
    t = neighbours_[t][(at + 1) % 3];
    if (t == PlanarMesh::kNone) return false;
  } while (t != first);
  return true;
}

Vec3 PlanarOptimizer::wantedPlace(std::uint32_t centre, const LocalSpace& local) const {
  const Vec3 here = local.unit(mesh_->places[centre]);
  Vec3 sum(0.0);
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const Vec3 p = local.unit(mesh_->places[ring_[i]]);
    const Vec3 q = local.unit(mesh_->places[ring_[(i + 1) % ring_.size()]]);
    const Vec3 middle = 0.5 * (p + q);
    const Vec3 along = q - p;
    const double squared = glm::dot(along, along);
    // From the side towards the node, square to the side.
    Vec3 across = here - middle;
    across -= (glm::dot(across, along) / squared) * along;
    const double height = glm::length(across);
    if (!(height > 0.0)) {
      sum += here;
      continue;
    }
    const double wanted = 0.5 * (std::sqrt(squared) + local.wantedSide);
    sum += middle + (kEquilateralHeight * wanted / height) * across;
  }
  return local.space(sum / static_cast<double>(ring_.size()));
}

double PlanarOptimizer::worstShape(const Vec3& place, const LocalSpace& local) const {
  double worst = 1.0;
  const Vec3 centre = local.unit(place);
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const Vec3 p = local.unit(mesh_->places[ring_[i]]);
    const Vec3 q = local.unit(mesh_->places[ring_[(i + 1) % ring_.size()]]);
    worst = std::min(worst, triangleShape(centre, p, q));
  }
  return worst;
}

void PlanarOptimizer::smooth(std::uint32_t centre) {
  if (!collectStar(centre)) return;
  const SurfacePoint here = metric_->surface().evaluate(mesh_->plane[centre]);
  const LocalSpace local = metric_->spaceAt(here.position, mesh_->sizes[centre], hint_);
  const Vec3 move = wantedPlace(centre, local) - here.position;
  // The step of the plane whose image is nearest to the move: (J^T J) step = J^T move.
  const Metric2 metric = planeMetric(here, 1.0);
  const Vec2 right(glm::dot(here.alongXi, move), glm::dot(here.alongEta, move));
  const double determinant = metric.determinant();
  const Vec2 step((metric.yy * right.x - metric.xy * right.y) / determinant,
                  (metric.xx * right.y - metric.xy * right.x) / determinant);
  const double worst = worstShape(mesh_->places[centre], local);
  for (const double share : kMoves)
    if (moveIfBetter(centre, mesh_->plane[centre] + share * step, worst, local)) return;
}

bool PlanarOptimizer::moveIfBetter(std::uint32_t centre, const Vec2& to, double worst,
                                   const LocalSpace& local) {
  const Vec2 from = mesh_->plane[centre];
  mesh_->plane[centre] = to;
  bool valid = true;
  for (std::size_t i = 0; i < ring_.size() && valid; ++i)
    valid = mesh_->turn(centre, ring_[i], ring_[(i + 1) % ring_.size()]) > 0;
  if (valid) {
    const PlaneSample sample = metric_->sample(to, hint_);
    if (worstShape(sample.position, local) >= worst) {
      mesh_->places[centre] = sample.position;
      mesh_->sizes[centre] = sample.size;
      return true;
    }
  }
  mesh_->plane[centre] = from;
  return false;
}

}  // namespace tetrafront
