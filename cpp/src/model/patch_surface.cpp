#include "model/patch_surface.h"

#include <algorithm>
#include <utility>

namespace tetrafront {

namespace {

/// Distance between two strips of a tube, in the parameter of its first rim.
constexpr double kStripGap = 1.0 / 16.0;

/// Samples per curved line for the plane of a loop. The normal of a plane curve is exact with any
/// number; this many give its area to about 1 %.
constexpr std::uint32_t kSurfaceLoopSamples = 16;

}  // namespace

// ---- curved ------------------------------------------------------------------------------------

MappedSurface::MappedSurface(PatchType type, std::span<const OrientedCurve> loop,
                             std::span<const OrientedCurve> sections)
    : surface_(type, loop, sections) {
  if (surface_.shape() == UnitShape::kTriangle) {
    plane_ = StretchedPlane::ofTriangle(loop[0].length(), loop[2].length(), loop[1].length());
    return;
  }
  const SurfacePoint corner = surface_.evaluate({0.0, 0.0});
  plane_ = StretchedPlane(loop[0].length(), loop[3].length(), loop[2].length(), corner.alongXi,
                          corner.alongEta);
}

MappedSurface::MappedSurface(TubeSurface tube) : surface_(std::move(tube)) {
  const TubeSurface& rims = *surface_.tube();
  const SurfacePoint corner = rims.evaluate({0.0, 0.0});
  plane_ = StretchedPlane(rims.first().length(), rims.meanRuling(), rims.second().length(),
                          corner.alongXi, corner.alongEta);
}

Vec2 MappedSurface::stripToPlane(const Vec2& unit, std::size_t strip) const {
  return plane_.toPlane({unit.x + kStripGap * static_cast<double>(strip), unit.y});
}

Vec2 MappedSurface::toUnit(const Vec2& plane) const {
  Vec2 unit = plane_.toUnit(plane);
  if (surface_.tube() == nullptr || surface_.tube()->creases().size() < 2) return unit;
  // Half of the gap belongs to either strip.
  const std::span<const double> creases = surface_.tube()->creases();
  std::size_t strip = 0;
  while (strip + 1 < creases.size() &&
         unit.x > creases[strip + 1] + kStripGap * (static_cast<double>(strip) + 0.5))
    ++strip;
  unit.x -= kStripGap * static_cast<double>(strip);
  return unit;
}

SurfacePoint MappedSurface::evaluate(const Vec2& plane) const {
  const Vec2 unit = toUnit(plane);
  SurfacePoint result = surface_.evaluate(unit);
  const StretchedPlane::Derivatives chain = plane_.derivatives(unit);
  result.alongEta = chain.xiByEta * result.alongXi + chain.etaByEta * result.alongEta;
  result.alongXi = chain.xiByXi * result.alongXi;
  return result;
}

Vec2 MappedSurface::clamped(const Vec2& plane) const {
  // Eta first: xi is undefined at a height outside the domain.
  const Vec2 inside(plane.x, std::clamp(plane.y, 0.0, plane_.toPlane({0.0, 1.0}).y));
  if (surface_.tube() != nullptr) return inside;
  const Vec2 unit = plane_.toUnit(inside);
  const Vec2 nearest = clampedToUnit(surface_.shape(), unit);
  return nearest == unit ? inside : plane_.toPlane(nearest);
}

// ---- any patch ---------------------------------------------------------------------------------

PatchSurface::PatchSurface(const ResolvedModel& model, const Patch& patch)
    : model_(&model), patch_(&patch), surface_(makeSurface(model, patch)) {
  findFlatAxes();
}

PatchSurface::PatchSurface(const ResolvedModel& model, const Patch& patch,
                           const PlanarSurface& plane)
    : model_(&model), patch_(&patch), surface_(plane) {
  findFlatAxes();
}

void PatchSurface::findFlatAxes() {
  flat_ = model_->curve(patch_->loops.front().front()).flatAxes();
  for (const Loop& loop : spanningLoops(*patch_))
    for (const OrientedLine& line : loop) flat_.restrictTo(model_->curve(line).flatAxes());
  for (const OrientedLine& line : patch_->sections)
    flat_.restrictTo(model_->curve(line).flatAxes());
}

PatchSurface::Surface PatchSurface::makeSurface(const ResolvedModel& model, const Patch& patch) {
  const Loop& outer = patch.loops.front();
  if (patch.type == PatchType::kTube) return MappedSurface(tubeSurface(model, patch));
  if (patch.type != PatchType::kPlanar)
    return MappedSurface(patch.type, curvesOf(model, outer), curvesOf(model, patch.sections));
  const LoopPlane plane = loopPlane(model, outer);
  return PlanarSurface(plane.origin, plane.areaVector, plane.firstDirection);
}

SurfacePoint PatchSurface::evaluate(const Vec2& plane) const {
  SurfacePoint point =
      std::visit([&](const auto& surface) { return surface.evaluate(plane); }, surface_);
  flat_.settle(point.position);
  flat_.settleDirection(point.alongXi);
  flat_.settleDirection(point.alongEta);
  return point;
}

Vec2 PatchSurface::boundaryToPlane(std::size_t index, double t, const Vec3& position) const {
  if (const PlanarSurface* flat = planar()) return flat->project(position);
  const MappedSurface& curved = *mapped();
  return curved.stretchedPlane().toPlane(unitBorder(curved.unitSurface().shape(), index, t));
}

bool PatchSurface::straightInPlane(std::size_t loop, std::size_t index) const {
  // The border of a curved patch's domain is straight; lines of its holes are not.
  if (mapped() != nullptr) return loop == 0;
  return model_->curve(patch_->loops[loop][index]).isStraight();
}

Vec2 PatchSurface::clamped(const Vec2& plane) const {
  if (const auto* face = std::get_if<FacePlane>(&surface_)) return face->clamped(plane);
  return mapped() != nullptr ? mapped()->clamped(plane) : plane;
}

// ---- loops -------------------------------------------------------------------------------------

TubeSurface tubeSurface(const ResolvedModel& model, const Patch& patch) {
  return {Rim(curvesOf(model, patch.loops[0])), Rim(curvesOf(model, patch.loops[1]))};
}

UnitSurface unitSurface(const ResolvedModel& model, const Patch& patch) {
  return {patch.type, curvesOf(model, patch.loops.front()), curvesOf(model, patch.sections)};
}

std::vector<OrientedCurve> curvesOf(const ResolvedModel& model, const Loop& loop) {
  std::vector<OrientedCurve> curves;
  curves.reserve(loop.size());
  for (const OrientedLine& line : loop) curves.push_back(model.curve(line));
  return curves;
}

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

double loopExtent(const ResolvedModel& model, std::span<const Loop> loops,
                  std::uint32_t samplesPerLine) {
  Vec3 low = model.curve(loops.front().front()).start();
  Vec3 high = low;
  for (const Loop& loop : loops) {
    for (const Vec3& sample : sampleLoop(model, loop, samplesPerLine)) {
      low = glm::min(low, sample);
      high = glm::max(high, sample);
    }
  }
  return glm::length(high - low);
}

LoopPlane loopPlane(const ResolvedModel& model, const Loop& loop) {
  const std::vector<Vec3> samples = sampleLoop(model, loop, kSurfaceLoopSamples);
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
