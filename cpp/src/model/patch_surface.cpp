#include "model/patch_surface.h"

namespace tetrafront {

namespace {

/// Samples per curved line for the plane of a loop; the normal of a plane curve is exact with any
/// number, this many make its area good to about 1 %.
constexpr std::uint32_t kPlaneSamples = 16;

}  // namespace

// ---- planar ------------------------------------------------------------------------------------

PlanarSurface::PlanarSurface(const Vec3& origin, const Vec3& normal, const Vec3& firstDirection)
    : origin_(origin), normal_(glm::normalize(normal)) {
  first_ = glm::normalize(firstDirection - glm::dot(firstDirection, normal_) * normal_);
  second_ = glm::cross(normal_, first_);
}

SurfacePoint PlanarSurface::evaluate(const Vec2& plane) const {
  return {origin_ + (plane.x * first_ + plane.y * second_), first_, second_};
}

Vec2 PlanarSurface::project(const Vec3& place) const {
  const Vec3 offset = place - origin_;
  return {glm::dot(first_, offset), glm::dot(second_, offset)};
}

double PlanarSurface::distance(const Vec3& place) const {
  return glm::dot(normal_, place - origin_);
}

// ---- Coons -------------------------------------------------------------------------------------

CoonsSurface::CoonsSurface(const std::array<OrientedCurve, 4>& lines) : lines_(lines) {
  const SurfacePoint corner = evaluateUnit({0.0, 0.0});
  plane_ = StretchedPlane(lines_[0].length(), lines_[3].length(), lines_[2].length(),
                          corner.alongXi, corner.alongEta);
}

SurfacePoint CoonsSurface::evaluateUnit(const Vec2& unit) const {
  const double xi = unit.x;
  const double eta = unit.y;
  const Curve::Sample f1 = lines_[0].sample(xi);
  const Curve::Sample f2 = lines_[1].sample(eta);
  const Curve::Sample f3 = lines_[2].sample(xi);
  const Curve::Sample f4 = lines_[3].sample(eta);
  const Vec3& a = lines_[0].start();
  const Vec3& b = lines_[1].start();
  const Vec3& c = lines_[1].end();
  const Vec3& d = lines_[2].start();
  const double xi1 = 1.0 - xi;
  const double eta1 = 1.0 - eta;

  SurfacePoint result;
  result.position =
      ((eta1 * f1.position + eta * f3.position) + (xi * f2.position + xi1 * f4.position)) -
      ((xi1 * eta1) * a + (xi * eta1) * b + (xi * eta) * c + (eta * xi1) * d);
  result.alongXi = ((eta1 * f1.derivative + eta * f3.derivative) + (f2.position - f4.position)) -
                   (eta1 * (b - a) + eta * (c - d));
  result.alongEta = ((f3.position - f1.position) + (xi * f2.derivative + xi1 * f4.derivative)) -
                    (xi1 * (d - a) + xi * (c - b));
  return result;
}

SurfacePoint CoonsSurface::evaluate(const Vec2& plane) const {
  const Vec2 unit = plane_.toUnit(plane);
  SurfacePoint result = evaluateUnit(unit);
  const StretchedPlane::Derivatives chain = plane_.derivatives(unit);
  result.alongEta = chain.xiByEta * result.alongXi + chain.etaByEta * result.alongEta;
  result.alongXi = chain.xiByXi * result.alongXi;
  return result;
}

// ---- any patch ---------------------------------------------------------------------------------

PatchSurface::PatchSurface(const ResolvedModel& model, const Patch& patch)
    : model_(&model), patch_(&patch), surface_(makeSurface(model, patch)) {
  const Loop& outer = patch.loops.front();
  flat_ = FlatAxes(model.curve(outer.front()).points());
  for (const OrientedLine& line : outer)
    for (const Vec3& point : model.curve(line).points()) flat_.restrictTo(point);
}

PatchSurface::Surface PatchSurface::makeSurface(const ResolvedModel& model, const Patch& patch) {
  const Loop& outer = patch.loops.front();
  if (patch.type == PatchType::kCoons) {
    // The loop walks A B C D A; eq. (15) wants its third and fourth line the other way round.
    return CoonsSurface({model.curve(outer[0]), model.curve(outer[1]),
                         model.curve(outer[2]).reverse(), model.curve(outer[3]).reverse()});
  }
  const LoopPlane plane = loopPlane(model, outer);
  return PlanarSurface(plane.origin, plane.areaVector, plane.firstDirection);
}

SurfacePoint PatchSurface::evaluate(const Vec2& plane) const {
  const PlanarSurface* flat = planar();
  SurfacePoint point = flat != nullptr ? flat->evaluate(plane) : coons()->evaluate(plane);
  flat_.settle(point.position);
  flat_.settleDirection(point.alongXi);
  flat_.settleDirection(point.alongEta);
  return point;
}

Vec2 PatchSurface::boundaryToPlane(std::size_t position, double t, const Vec3& place) const {
  if (const PlanarSurface* flat = planar()) return flat->project(place);
  const std::array<Vec2, 4> unit{Vec2(t, 0.0), Vec2(1.0, t), Vec2(1.0 - t, 1.0),
                                 Vec2(0.0, 1.0 - t)};
  return coons()->stretchedPlane().toPlane(unit[position]);
}

bool PatchSurface::straightInPlane(std::size_t loop, std::size_t position) const {
  if (coons() != nullptr) return true;
  return model_->curve(patch_->loops[loop][position]).isStraight();
}

// ---- loops -------------------------------------------------------------------------------------

std::vector<Vec3> sampleLoop(const ResolvedModel& model, const Loop& loop,
                             std::uint32_t samplesPerLine) {
  std::vector<Vec3> samples;
  for (const OrientedLine& line : loop) {
    const OrientedCurve curve = model.curve(line);
    const std::uint32_t count = curve.isStraight() ? 1 : samplesPerLine;
    for (std::uint32_t i = 0; i < count; ++i)
      samples.push_back(curve.position(static_cast<double>(i) / count));
  }
  return samples;
}

LoopPlane loopPlane(const ResolvedModel& model, const Loop& loop) {
  const std::vector<Vec3> samples = sampleLoop(model, loop, kPlaneSamples);
  LoopPlane plane;
  for (const Vec3& sample : samples) plane.origin += sample;
  plane.origin /= static_cast<double>(samples.size());
  double farthest = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3& here = samples[i];
    const Vec3& next = samples[(i + 1) % samples.size()];
    plane.areaVector += 0.5 * glm::cross(here - plane.origin, next - plane.origin);
    const Vec3 chord = here - samples.front();
    const double distance = glm::dot(chord, chord);
    if (distance > farthest) {
      farthest = distance;
      plane.firstDirection = chord;
    }
  }
  return plane;
}

}  // namespace tetrafront
