// The plane goes through those three points with the most other points on it: a least-squares plane
// would follow the very point that was moved.

#include "model/check_plane.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "base/sort.h"
#include "model/planar_surface.h"

namespace tetrafront {

namespace {

/// Up to this number of points all triples are tried, about 500.
constexpr std::size_t kFewPoints = 16;
/// With more points, the number of triples is chosen for about this many distances, but at least
/// 64: if a majority lies in one plane, an eighth of the triples do.
constexpr std::size_t kDistances = 1'000'000;
constexpr std::size_t kFewestTriples = 64;
/// Three points span a plane if the area of their triangle exceeds this, relative to the squared
/// extent.
constexpr double kSpanningArea = 1e-6;

/// If this many planes are equally good, none of them is the intended one.
constexpr std::size_t kMaxRivals = 8;

struct CandidatePlane {
  std::size_t agreeing = 0;
  MovedPoints moved;
  bool alongAxes = false;
};

/// Returns the points of a patch's lines, each once; none if it refers to something missing.
std::vector<PointId> pointsOfPatch(const Model& model, const Patch& patch) {
  std::vector<PointId> points;
  for (const Loop& loop : patch.loops) {
    for (const OrientedLine& walked : loop) {
      if (walked.line >= model.lines.size()) return {};
      for (const std::uint32_t point : model.lines[walked.line].points) {
        if (point >= model.points.size()) return {};
        points.push_back(PointId(point));
      }
    }
  }
  sortUnique(points);
  return points;
}

class PlaneVote {
 public:
  PlaneVote(const Model& model, const std::vector<PointId>& points)
      : model_(&model), points_(points) {
    const Vec3& origin = position(0);
    for (std::size_t i = 1; i < points_.size(); ++i)
      extent_ = std::max(extent_, glm::length(position(i) - origin));
  }

  /// Returns the largest distance from the first point.
  [[nodiscard]] double extent() const { return extent_; }

  /// Returns the planes with the most points within the tolerance, one for each set of points off
  /// it; if there are more than kMaxRivals, only kMaxRivals + 1.
  std::vector<CandidatePlane> run(double tolerance) {
    tolerance_ = tolerance;
    const std::size_t count = points_.size();
    if (count <= kFewPoints) {
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j)
          for (std::size_t k = j + 1; k < count; ++k) consider(i, j, k);
    } else {
      const std::size_t triples = std::min(count, std::max(kFewestTriples, kDistances / count));
      for (std::size_t t = 0; t < triples; ++t) {
        const std::size_t i = t * count / triples;
        consider(i, (i + count / 3) % count, (i + 2 * count / 3) % count);
      }
    }
    return std::move(best_);
  }

 private:
  [[nodiscard]] const Vec3& position(std::size_t i) const {
    return model_->points[points_[i].index()];
  }

  void consider(std::size_t i, std::size_t j, std::size_t k) {
    if (mostAgreeing_ == points_.size()) return;
    const Vec3 side = position(j) - position(i);
    const Vec3 normal = glm::cross(side, position(k) - position(i));
    if (!(glm::length(normal) > kSpanningArea * extent_ * extent_)) return;
    CandidatePlane plane = rate(PlanarSurface(position(i), normal, side));
    if (plane.agreeing < mostAgreeing_) return;
    if (plane.agreeing > mostAgreeing_) best_.clear();
    mostAgreeing_ = plane.agreeing;
    if (best_.size() > kMaxRivals) return;
    const auto known = std::ranges::find_if(best_, [&](const CandidatePlane& other) {
      return other.moved.points == plane.moved.points;
    });
    if (known != best_.end()) return;
    for (int axis = 0; axis < 3; ++axis)
      plane.alongAxes = plane.alongAxes || (position(i)[axis] == position(j)[axis] &&
                                            position(i)[axis] == position(k)[axis]);
    best_.push_back(std::move(plane));
  }

  [[nodiscard]] CandidatePlane rate(const PlanarSurface& surface) const {
    CandidatePlane plane;
    std::vector<std::pair<double, PointId>> off;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double distance = std::fabs(surface.distance(position(i)));
      if (distance > tolerance_) off.emplace_back(-distance, points_[i]);
    }
    stableSort(off);
    plane.agreeing = points_.size() - off.size();
    for (const auto& [distance, point] : off) plane.moved.points.push_back(PointId(point));
    plane.moved.distance = off.empty() ? 0.0 : -off.front().first;
    return plane;
  }

  const Model* model_;
  std::span<const PointId> points_;
  double tolerance_ = 0.0;
  double extent_ = 0.0;
  std::size_t mostAgreeing_ = 0;
  std::vector<CandidatePlane> best_;
};

}  // namespace

MovedPoints MovedPointFinder::find(PatchId patch, double extent) {
  const std::vector<PointId> points = pointsOfPatch(*model_, model_->patches[patch.index()]);
  if (points.size() < 4) return {};
  std::vector<CandidatePlane> planes = PlaneVote(*model_, points).run(kPlaneTolerance * extent);
  if (planes.empty() || planes.size() > kMaxRivals) return {};
  const std::size_t agreeing = planes.front().agreeing;
  // Any three points share a plane; with four points, no more can be expected.
  const bool isMajority = 2 * agreeing > points.size() && (agreeing > 3 || points.size() == 4);
  if (!isMajority) return {};
  if (planes.size() == 1) return std::move(planes.front().moved);
  if (bentPatches_.empty()) countBentPatches();
  const auto rank = [&](const CandidatePlane& plane) {
    return std::tuple(bentPatches_[plane.moved.points.front().index()], plane.alongAxes);
  };
  const auto best = std::ranges::max_element(planes, {}, rank);
  return std::move(best->moved);
}

void MovedPointFinder::countBentPatches() {
  bentPatches_.assign(model_->points.size(), 0);
  for (const Patch& patch : model_->patches) {
    if (patch.type != PatchType::kPlanar) continue;
    const std::vector<PointId> points = pointsOfPatch(*model_, patch);
    if (points.size() < 4) continue;
    PlaneVote vote(*model_, points);
    const std::vector<CandidatePlane> planes = vote.run(kPlaneTolerance * vote.extent());
    if (planes.empty() || planes.front().agreeing == points.size()) continue;
    for (const PointId point : points) ++bentPatches_[point.index()];
  }
}

}  // namespace tetrafront
