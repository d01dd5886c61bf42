// Lawson's flips by shape instead of by circumcircle: on a curved patch the shape in space is
// what counts, and each flip lowers what the shapes cost in sum, so they come to an end. Moves lower
// that sum too; repairs better the worst of the triangles they change, or change no shape for the
// worse than fair. A fixed number of sweeps of each makes the schedule.

#include "surface/planar_optimizer.h"

#include <algorithm>

#include "base/ids.h"

namespace tetrafront {

namespace {

/// A flip must lower the cost by this share, or rounding could flip for ever.
constexpr double kMinRelativeGain = 1e-6;
/// Cosine of the angle between two triangles' normals below which a flip must not fold them more
/// than they were: on coarsely divided bends the better shapes may cut across the bend.
constexpr double kSharpFold = 0.5;

}  // namespace

PlanarOptimizer::PlanarOptimizer(const PatchMetric& metric, PlanarMesh& mesh)
    : metric_(&metric),
      mesh_(&mesh),
      links_(mesh),
      moves_(metric, mesh, links_),
      repair_(metric, mesh, links_, moves_) {}

/// Removal and division first, while nodes still move; repair last, and once more after its own
/// changes have been smoothed. More rounds of smoothing change shapes by less than a percent.
const std::vector<PlanarOptimizer::Sweep>& PlanarOptimizer::schedule() {
  using enum Sweep;
  static const std::vector<Sweep> sweeps{
      kPart, kFlip, kSmooth, kFlip, kThin,   kRefine, kFlip,   kSmooth, kFlip,   kSmooth, kFlip,
      kThin, kFlip, kSmooth, kFlip, kRepair, kFlip,   kPolish, kFlip,   kRepair, kPolish, kRepair};
  return sweeps;
}

bool PlanarOptimizer::advance(std::uint32_t budget) {
  std::uint32_t work = 0;
  if (!linked_) {
    linked_ = true;
    links_.build();
    if (mesh_->parted.empty()) sweep_ = 1;  // nothing for kPart to do
    work += links_.triangleCount() / 8;
  }
  while (!done_ && work < budget) {
    if (sweep_ == schedule().size()) {
      repair_.partLoneTriangle();
      links_.compact();
      done_ = true;
      break;
    }
    const Sweep sweep = schedule()[sweep_];
    const bool overNodes =
        sweep == Sweep::kSmooth || sweep == Sweep::kPolish || sweep == Sweep::kThin;
    if (overNodes) cursor_ = std::max(cursor_, mesh_->boundaryCount);
    if (cursor_ >= (overNodes ? mesh_->plane.size() : links_.triangleCount())) {
      ++sweep_;
      cursor_ = 0;
      continue;
    }
    visit(sweep, cursor_++);
    ++work;
  }
  return done_;
}

void PlanarOptimizer::visit(Sweep sweep, std::uint32_t index) {
  switch (sweep) {
    case Sweep::kPart:
      repair_.part(index);
      break;
    case Sweep::kFlip:
      flipFrom(index);
      break;
    case Sweep::kSmooth:
      moves_.smooth(index);
      break;
    case Sweep::kPolish:
      moves_.polish(index);
      break;
    case Sweep::kThin:
      repair_.thin(index);
      break;
    case Sweep::kRefine:
      repair_.refine(index);
      break;
    case Sweep::kRepair:
      repair_.repair(index);
      break;
  }
}

void PlanarOptimizer::flipFrom(std::uint32_t triangle) {
  if (!links_.isAlive(triangle)) return;
  // Where the metric changes, each pair of triangles is judged in its own, and a chain of flips
  // might come back to where it began. No other chain is nearly as long.
  constexpr std::size_t kMaxChain = 1000;
  pending_.assign(1, triangle);
  for (std::size_t flips = 0; !pending_.empty() && flips < kMaxChain; ++flips) {
    const std::uint32_t t = pending_.back();
    pending_.pop_back();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t other = links_.neighbour(t, k);
      if (other == kNoIndex || !flip(t, k)) continue;
      pending_.push_back(other);
      pending_.push_back(t);
      break;
    }
  }
}

/// Replaces a side by the other diagonal of its two triangles, if that is better.
bool PlanarOptimizer::flip(std::uint32_t t, std::uint32_t k) {
  const PlanarLinks::Diamond sides = links_.diamond(t, k);
  const auto [other, a, b, c, d] = sides;
  if (!mesh_->mayJoin(c, d)) return false;
  // Summed so that the other diagonal is judged in the very same space.
  const Vec3 middle =
      0.25 * ((mesh_->places[a] + mesh_->places[b]) + (mesh_->places[c] + mesh_->places[d]));
  const LocalSpace local = metric_->spaceAt(middle, mesh_->sizes[a], hint_);
  const Vec3 placeA = local.unit(mesh_->places[a]);
  const Vec3 placeB = local.unit(mesh_->places[b]);
  const Vec3 placeC = local.unit(mesh_->places[c]);
  const Vec3 placeD = local.unit(mesh_->places[d]);
  const double before = shapeCost(placeA, placeB, placeC) + shapeCost(placeB, placeA, placeD);
  const double after = shapeCost(placeC, placeA, placeD) + shapeCost(placeC, placeD, placeB);
  if (mesh_->turn(c, a, d) <= 0 || mesh_->turn(c, d, b) <= 0) return false;
  const double foldBefore = foldCosine(placeA, placeB, placeC, placeD);
  // The long triangles by which a front closes may face away from a bent patch, whatever their
  // shape. Where they do, facing it counts first.
  if (foldBefore < 0.0) {
    const int turned = countTurned(a, b, c) + countTurned(b, a, d);
    const int turnedAfter = countTurned(c, a, d) + countTurned(c, d, b);
    if (turnedAfter < turned) links_.flip(t, k);
    if (turnedAfter != turned) return turnedAfter < turned;
  }
  if (after >= (1.0 - kMinRelativeGain) * before) return false;
  const double fold = foldCosine(placeC, placeD, placeB, placeA);
  if (fold < kSharpFold && fold < foldBefore) return false;
  links_.flip(t, k);
  return true;
}

/// 1 if the triangle faces away from the patch at its centre, else 0.
int PlanarOptimizer::countTurned(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  constexpr double kThird = 1.0 / 3.0;
  const Vec2 centre = kThird * (mesh_->plane[a] + mesh_->plane[b] + mesh_->plane[c]);
  const SurfacePoint point = metric_->surface().evaluate(centre);
  const Vec3 normal =
      glm::cross(mesh_->places[b] - mesh_->places[a], mesh_->places[c] - mesh_->places[a]);
  return glm::dot(normal, glm::cross(point.alongXi, point.alongEta)) < 0.0 ? 1 : 0;
}

}  // namespace tetrafront
