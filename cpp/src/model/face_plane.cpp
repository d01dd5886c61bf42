#include "model/face_plane.h"

#include <algorithm>
#include <cmath>

namespace tetrafront {

namespace {

/// Samples per direction for the mean lengths.
constexpr int kLengthSamples = 8;
/// Distance from a pole / height of the box, at which tangents are taken: those at the pole have no length. Large beside the
/// rounding of parameters, small beside a side.
constexpr double kBesidePole = 1e-6;
/// Parameters beyond the box are limited to this part of its width: chords of its loops leave it by less.
constexpr double kBeyondBox = 0.5;

}  // namespace

FacePlane::FacePlane(const FaceSurface& surface, const ParameterBox& box, const PoleSides& poles)
    : surface_(&surface), isExchanged_(poles.uLow || poles.uHigh) {
  // (u, v) -> (v, -u) is a rotation and keeps the orientation.
  low_ = isExchanged_ ? Vec2(box.low.y, -box.high.x) : box.low;
  high_ = isExchanged_ ? Vec2(box.high.y, -box.low.x) : box.high;
  isPoleLow_ = isExchanged_ ? poles.uHigh : poles.vLow;
  isPoleHigh_ = isExchanged_ ? poles.uLow : poles.vHigh;
  middle_ = 0.5 * (low_.x + high_.x);
  double along = 0.0;
  double across = 0.0;
  double mean = 0.0;
  for (int i = 0; i < kLengthSamples; ++i) {
    for (int j = 0; j < kLengthSamples; ++j) {
      const Vec2 part((i + 0.5) / kLengthSamples, (j + 0.5) / kLengthSamples);
      const Vec2 at = low_ + part * (high_ - low_);
      const SurfaceJet jet = tetrafront::evaluate(surface, restored(at));
      along += glm::length(isExchanged_ ? jet.v : jet.u);
      across += glm::length(isExchanged_ ? jet.u : jet.v);
      mean += widthAt(at.y).value;
    }
  }
  constexpr double kCount = kLengthSamples * kLengthSamples;
  if (along > 0.0) width_ = along / mean;
  if (across > 0.0) scale_ = across / kCount;
}

Vec2 FacePlane::exchanged(const Vec2& uv) const { return isExchanged_ ? Vec2(uv.y, -uv.x) : uv; }

Vec2 FacePlane::restored(const Vec2& alongAcross) const {
  return isExchanged_ ? Vec2(-alongAcross.y, alongAcross.x) : alongAcross;
}

FacePlane::Width FacePlane::widthAt(double across) const {
  const double height = high_.y - low_.y;
  const double part = (across - low_.y) / height;
  if (isPoleLow_ && isPoleHigh_)
    return {4.0 * width_ * part * (1.0 - part), 4.0 * width_ * (1.0 - 2.0 * part) / height};
  if (isPoleLow_) return {width_ * part, width_ / height};
  if (isPoleHigh_) return {width_ * (1.0 - part), -width_ / height};
  return {width_, 0.0};
}

double FacePlane::awayFromPoles(double across) const {
  const double beside = kBesidePole * (high_.y - low_.y);
  const double beyond = kBeyondBox * (high_.y - low_.y);
  return std::clamp(across, isPoleLow_ ? low_.y + beside : low_.y - beyond,
                    isPoleHigh_ ? high_.y - beside : high_.y + beyond);
}

Vec2 FacePlane::toPlane(const Vec2& uv) const {
  const Vec2 at = exchanged(uv);
  return {(at.x - middle_) * widthAt(at.y).value, (at.y - low_.y) * scale_};
}

Vec2 FacePlane::toParameters(const Vec2& plane) const {
  const double across = awayFromPoles(low_.y + plane.y / scale_);
  const double beyond = kBeyondBox * (high_.x - low_.x);
  const double along =
      std::clamp(middle_ + plane.x / widthAt(across).value, low_.x - beyond, high_.x + beyond);
  return clampedToDomain(*surface_, restored({along, across}));
}

SurfacePoint FacePlane::evaluate(const Vec2& plane) const {
  const Vec2 uv = toParameters(plane);
  const SurfaceJet jet = tetrafront::evaluate(*surface_, uv);
  const Vec2 at = exchanged(uv);
  const Width width = widthAt(at.y);
  const Vec3 along = isExchanged_ ? jet.v : jet.u;
  const Vec3 across = isExchanged_ ? -jet.u : jet.v;
  // du = dx / w - (u - u0) w' / w dv, dv = dy / L.
  const Vec3 alongX = along / width.value;
  return {jet.position, alongX, (across - ((at.x - middle_) * width.slope) * alongX) / scale_};
}

Vec2 FacePlane::clamped(const Vec2& plane) const {
  const Vec2 at = exchanged(toParameters(plane));
  return toPlane(restored({std::clamp(at.x, low_.x, high_.x), std::clamp(at.y, low_.y, high_.y)}));
}

}  // namespace tetrafront
