#include "remesh/cusps.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "geom/box.h"
#include "remesh/feature_line.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Distance between the lines / distance from the corner below which two lines form a cusp: an angle of about 27 degrees.
constexpr double kCuspSlope = 0.47;
/// First distance from the corner / width of the cusp at which the lines are compared: below it no edge is wanted. Factor
/// from one to the next: the reach need not be more exact, because lengths of edges vary more.
constexpr double kFirstDistance = 0.5;
constexpr double kDistanceFactor = 1.1;
/// Two straight lines have the same angle at any distance. This is the least gain of the angle that justifies long edges.
constexpr double kMinOpening = 1.3;
/// Fall of the least size per distance, beyond the reach: steep, because sizes there follow the gap again.
constexpr double kFall = 1.5;

/// A feature line as seen from one of its ends.
struct LineEnd {
  NodeId corner{};
  const FeatureLine* line = nullptr;
  bool isFirst = false;

  [[nodiscard]] Vec3 at(double distance) const {
    return line->at(isFirst ? distance : line->length() - distance);
  }
  /// Square of the largest distance between the line, up to a distance from its end, and one straight edge.
  [[nodiscard]] double squaredDeviation(double distance) const {
    const double length = line->length();
    return isFirst ? line->squaredDeviation(0.0, distance, at(0.0), at(distance))
                   : line->squaredDeviation(length - distance, length, at(distance), at(0.0));
  }
};

/// Returns the largest distance from the corner at which one edge may represent each line, while the lines are within the
/// width of each other; 0 if they form no cusp.
double reachOf(const LineEnd& a, const LineEnd& b, const CuspRules& rules) {
  const double limit = rules.tolerance * rules.tolerance;
  const double last = std::min({a.line->length(), b.line->length(), rules.longest});
  double reach = 0.0;
  double firstSlope = 0.0;
  double slope = 0.0;
  for (double distance = kFirstDistance * rules.width; distance <= last;
       distance *= kDistanceFactor) {
    const double gap = glm::length(a.at(distance) - b.at(distance));
    if (gap > rules.width || gap > kCuspSlope * distance) break;
    if (a.squaredDeviation(distance) > limit || b.squaredDeviation(distance) > limit) break;
    slope = gap / distance;
    if (reach == 0.0) firstSlope = slope;
    reach = distance;
  }
  return slope > kMinOpening * firstSlope ? reach : 0.0;
}

}  // namespace

std::vector<Cusp> findCusps(const ReferenceSurface& reference, const CuspRules& rules) {
  std::vector<LineEnd> ends;
  for (const FeatureLine& line : reference.lines()) {
    if (line.isClosed()) continue;
    ends.push_back({line.nodes().front(), &line, true});
    ends.push_back({line.nodes().back(), &line, false});
  }
  std::ranges::stable_sort(ends,
                           [](const LineEnd& a, const LineEnd& b) { return a.corner < b.corner; });
  std::vector<Cusp> cusps;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size() && ends[j].corner == ends[i].corner; ++j) {
      if (!sharePatch(*ends[i].line, *ends[j].line)) continue;
      const double reach = reachOf(ends[i], ends[j], rules);
      if (reach > 0.0) cusps.push_back({pointOf(reference.mesh(), ends[i].corner), reach});
    }
  }
  return cusps;
}

CuspSizes::CuspSizes(std::vector<Cusp> cusps) : cusps_(std::move(cusps)) {
  std::vector<Box> boxes;
  for (const Cusp& cusp : cusps_) {
    Box box = Box::of(cusp.tip, cusp.tip, cusp.tip);
    box.include(cusp.tip, Vec3(cusp.reach * (1.0 + 1.0 / kFall)));
    boxes.push_back(box);
  }
  if (!boxes.empty()) tree_ = BoxTree(std::span<const Box>(boxes));
}

double CuspSizes::leastAt(const Vec3& position) const {
  double least = 0.0;
  if (cusps_.empty()) return least;
  tree_.visitOverlaps(Box::of(position, position, position), [&](std::uint32_t item) {
    const Cusp& cusp = cusps_[item];
    const double beyond = std::max(0.0, glm::length(position - cusp.tip) - cusp.reach);
    least = std::max(least, cusp.reach - kFall * beyond);
  });
  return least;
}

}  // namespace tetrafront
