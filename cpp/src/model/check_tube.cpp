#include "model/check_tube.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/sort.h"
#include "model/check_fold.h"
#include "model/patch_surface.h"

namespace tetrafront {

namespace {

/// Samples around the whole tube; at least kFewestSamples between two joints of lines.
constexpr double kAround = 48.0;
constexpr double kFewestSamples = 4.0;
/// Samples along a ruling.
constexpr int kAlong = 5;

class TubeCheck {
 public:
  TubeCheck(UnitSurface surface, const Tolerance& tolerance)
      : surface_(std::move(surface)), tolerance_(tolerance) {
    findJoints();
  }

  std::optional<TubeDefect> run() {
    if (const std::optional<Vec3> contact = findContact()) return TubeDefect{true, *contact};
    for (const std::vector<double>& smooth : smoothParts_)
      for (const double xi : smooth)
        for (int row = 0; row < kAlong; ++row)
          longest_ = std::max(longest_, glm::length(normalOf(surface_, {xi, etaOf(row)})));
    if (!(longest_ > tolerance_.area()))
      return TubeDefect{false, surface_.evaluate({0.0, 0.5}).position};
    if (const std::optional<Vec2> fold = findFold())
      return TubeDefect{false, surface_.evaluate(*fold).position};
    return std::nullopt;
  }

 private:
  static double etaOf(int row) { return static_cast<double>(row) / (kAlong - 1); }

  /// Divides the parts between joints of lines; no sample lies on a joint, where normals differ.
  void findJoints() {
    const TubeSurface& tube = *surface_.tube();
    std::vector<double> joints(tube.first().starts().begin(), tube.first().starts().end());
    for (const double start : tube.second().starts()) joints.push_back(tube.xiOfSecond(start));
    sortUnique(joints);
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double from = joints[i];
      const double width = (i + 1 < joints.size() ? joints[i + 1] : 1.0 + joints.front()) - from;
      if (width <= Tolerance::kCoincidence) continue;
      const double count = std::max(kFewestSamples, std::ceil(kAround * width));
      std::vector<double>& samples = smoothParts_.emplace_back();
      for (double k = 0.5; k < count; k += 1.0) samples.push_back(from + (k / count) * width);
    }
  }

  [[nodiscard]] std::optional<Vec3> findContact() const {
    for (const std::vector<double>& smooth : smoothParts_) {
      for (const double xi : smooth) {
        const SurfacePoint point = surface_.evaluate({xi, 0.0});
        if (glm::length(point.alongEta) <= tolerance_.coincidence()) return point.position;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Vec2> findFold() const {
    for (const std::vector<double>& smooth : smoothParts_) {
      for (std::size_t i = 0; i < smooth.size(); ++i) {
        for (int row = 0; row < kAlong; ++row) {
          const Vec2 here(smooth[i], etaOf(row));
          std::optional<Vec2> fold;
          if (row > 0) fold = foldBetween({smooth[i], etaOf(row - 1)}, here);
          if (!fold && i > 0) fold = foldBetween({smooth[i - 1], etaOf(row)}, here);
          if (fold) return fold;
        }
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Vec2> foldBetween(const Vec2& from, const Vec2& to) const {
    return findFoldBetween(surface_, from, to, kMinNormal * longest_);
  }

  UnitSurface surface_;
  Tolerance tolerance_;
  std::vector<std::vector<double>> smoothParts_;  ///< xi of the samples between two joints
  double longest_ = 0.0;                          ///< length of a normal
};

}  // namespace

std::optional<TubeDefect> findTubeDefect(const ResolvedModel& model, const Patch& patch,
                                         const Tolerance& tolerance) {
  return TubeCheck(UnitSurface(tubeSurface(model, patch)), tolerance).run();
}

}  // namespace tetrafront
