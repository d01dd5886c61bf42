#include "support/branched_tube.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/models.h"

namespace tetrafront::testing {

namespace {

constexpr double kHalfLength = 2.0;
constexpr double kBranchEnd = 2.5;
/// Points of the spline along which the tubes meet.
constexpr int kMeetingPoints = 24;

}  // namespace

Model branchedTube(double branch) {
  ModelBuilder builder;
  // The seam is opposite the branch.
  const Vec3 u(-1, 0, 0);
  const Vec3 v(0, -1, 0);
  const Loop bottom = builder.circle({0, 0, -kHalfLength}, 1.0, 1, u, v);
  const Loop top = builder.circle({0, 0, kHalfLength}, 1.0, 1, u, v);
  const OrientedLine seam = builder.straight({-1, 0, -kHalfLength}, {-1, 0, kHalfLength});
  std::vector<Vec3> positions;
  for (int i = 0; i <= kMeetingPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % kMeetingPoints) / kMeetingPoints;
    const double y = branch * std::cos(angle);
    positions.emplace_back(std::sqrt(1.0 - y * y), y, branch * std::sin(angle));
  }
  const std::uint32_t meeting = builder.line(LineType::kSpline, positions);
  const Loop end = builder.circle({kBranchEnd, 0, 0}, branch, 1, {0, 1, 0}, {0, 0, 1});
  const OrientedLine rise =
      builder.straight(positions.front(), {kBranchEnd, positions.front().y, positions.front().z});
  builder.patch(PatchType::kPlanar, {bottom});
  builder.patch(PatchType::kPlanar, {top});
  builder.patch(PatchType::kCoons,
                {{bottom[0], seam, {top[0].line, true}, {seam.line, true}}, {{meeting, false}}});
  builder.patch(PatchType::kCoons,
                {{{meeting, false}, rise, {end[0].line, true}, {rise.line, true}}});
  builder.patch(PatchType::kPlanar, {end});
  return std::move(builder.model);
}

double branchedTubeVolume(double branch) {
  // Integrate over the section of the branch, from the surface of the first tube to the end of the
  // branch. At y, the chord of the section is 2 sqrt(branch^2 - y^2).
  constexpr int kSteps = 100'000;
  double extra = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double y = branch * ((2.0 * i + 1.0) / kSteps - 1.0);
    extra += 2.0 * std::sqrt(branch * branch - y * y) * (kBranchEnd - std::sqrt(1.0 - y * y)) *
             (2.0 * branch / kSteps);
  }
  return 2.0 * kHalfLength * std::numbers::pi + extra;
}

}  // namespace tetrafront::testing
